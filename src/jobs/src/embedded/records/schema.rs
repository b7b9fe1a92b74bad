//! The database's statements.

/// `user_version` of a database that these statements fit.
pub(super) const VERSION: i64 = 2;

pub(super) const CREATE: &str = "
CREATE TABLE jobs (
    life INTEGER PRIMARY KEY,
    id BLOB NOT NULL UNIQUE,
    client TEXT NOT NULL,
    clients TEXT NOT NULL, -- who has submitted it: an array of JSON
    cost REAL NOT NULL,
    payload BLOB NOT NULL,
    deadline INTEGER, -- milliseconds
    state TEXT NOT NULL,
    progress REAL NOT NULL,
    created INTEGER NOT NULL, -- this and the other times: microseconds of Unix time
    started INTEGER,
    finished INTEGER,
    attempts INTEGER NOT NULL,
    crashes INTEGER NOT NULL DEFAULT 0,
    hidden INTEGER NOT NULL, -- only asked for as a part
    split INTEGER NOT NULL DEFAULT 0, -- waits for its parts
    failure TEXT,
    detail BLOB
) STRICT;
CREATE INDEX finished ON jobs (finished) WHERE finished IS NOT NULL;
CREATE INDEX live ON jobs (life) WHERE finished IS NULL;
";

/// For [`PROBE`]: one row, whose bytes mean nothing.
pub(super) const CREATE_PROBE: &str =
    "CREATE TABLE IF NOT EXISTS probe (row INTEGER PRIMARY KEY, bytes BLOB) STRICT";

/// Written anew each time.
pub(super) const PROBE: &str = "INSERT OR REPLACE INTO probe VALUES (1, zeroblob(?1))";

pub(super) const SUBMIT: &str = "
INSERT OR REPLACE INTO jobs (life, id, client, clients, cost, payload, deadline, state, progress, created, attempts, hidden)
VALUES (:life, :id, :client, :clients, :cost, :payload, :deadline, 'queued', 0.0, :created, 0,
    :hidden AND coalesce((SELECT hidden FROM jobs WHERE id = :id), 1))";

pub(super) const SHOW: &str = "UPDATE jobs SET hidden = 0 WHERE life = ?1";

pub(super) const CLIENTS: &str = "UPDATE jobs SET clients = :clients WHERE life = :life";

pub(super) const SPLIT: &str = "UPDATE jobs SET split = 1 WHERE life = ?1";

pub(super) const POSTPONE: &str = "UPDATE jobs SET deadline = :deadline WHERE life = :life";

pub(super) const START: &str = "
UPDATE jobs SET state = 'running', split = 0, attempts = :attempts, started = :started WHERE life = :life";

pub(super) const FINISH: &str = "
UPDATE jobs SET state = :state, progress = :progress, finished = :finished, failure = :failure, detail = :detail
WHERE life = :life";

pub(super) const REQUEUE: &str = "UPDATE jobs SET state = 'queued' WHERE life = ?1 AND state = 'running'";

pub(super) const GET: &str = "SELECT * FROM jobs WHERE id = ?1";

pub(super) const LIST: &str = "
SELECT * FROM jobs
WHERE life < :before AND NOT hidden AND (:state IS NULL OR state = :state)
    AND (:client IS NULL OR EXISTS (SELECT 1 FROM json_each(clients) WHERE value = :client))
ORDER BY life DESC LIMIT :limit";

pub(super) const LIVE: &str = "SELECT * FROM jobs WHERE finished IS NULL ORDER BY life";

pub(super) const LAST_LIFE: &str = "SELECT coalesce(max(life), 0) FROM jobs";

/// What runs when the database is opened ran when a process died; what waited for its parts did not.
pub(super) const COUNT_CRASHES: &str =
    "UPDATE jobs SET crashes = crashes + 1 - split, split = 0, state = 'queued' WHERE state = 'running'";

pub(super) const FAIL_CRASHED: &str = "
UPDATE jobs SET state = 'failed', finished = :finished, failure = :failure
WHERE finished IS NULL AND crashes >= :limit";

pub(super) const GIVEN_UP: &str = "SELECT id FROM jobs WHERE failure = ?1";

pub(super) const FORGET_OLD: &str = "DELETE FROM jobs WHERE finished < ?1";

pub(super) const FORGET_MANY: &str = "
DELETE FROM jobs WHERE life IN
(SELECT life FROM jobs WHERE finished IS NOT NULL AND hidden = ?2 ORDER BY finished DESC LIMIT -1 OFFSET ?1)";

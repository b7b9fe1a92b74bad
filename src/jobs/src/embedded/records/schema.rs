//! SQL statements of the database of jobs. The column `life` is a job's generation; `hidden` marks jobs that are only
//! subtasks.

/// `user_version` of a database with this schema.
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

/// The table of [`PROBE`]: one row, whose bytes mean nothing.
pub(super) const CREATE_PROBE: &str =
    "CREATE TABLE IF NOT EXISTS probe (row INTEGER PRIMARY KEY, bytes BLOB) STRICT";

/// Replaces the row.
pub(super) const PROBE: &str = "INSERT OR REPLACE INTO probe VALUES (1, zeroblob(?1))";

pub(super) const SUBMIT: &str = "
INSERT OR REPLACE INTO jobs
    (life, id, client, clients, cost, payload, deadline, state, progress, created, attempts, hidden)
VALUES (:life, :id, :client, :clients, :cost, :payload, :deadline, 'queued', 0.0, :created, 0,
    :hidden AND coalesce((SELECT hidden FROM jobs WHERE id = :id), 1))";

pub(super) const LIST_SUBTASK: &str = "UPDATE jobs SET hidden = 0 WHERE life = :life";

pub(super) const SET_CLIENTS: &str = "UPDATE jobs SET clients = :clients WHERE life = :life";

pub(super) const WAIT: &str = "UPDATE jobs SET split = 1 WHERE life = :life";

pub(super) const SET_DEADLINE: &str = "UPDATE jobs SET deadline = :deadline WHERE life = :life";

pub(super) const START: &str = "
UPDATE jobs SET state = 'running', split = 0, attempts = :attempts, started = :started WHERE life = :life";

pub(super) const FINISH: &str = "
UPDATE jobs SET state = :state, progress = :progress, finished = :finished, failure = :failure, detail = :detail
WHERE life = :life";

pub(super) const REQUEUE: &str = "UPDATE jobs SET state = 'queued' WHERE life = :life AND state = 'running'";

pub(super) const GET: &str = "SELECT * FROM jobs WHERE id = ?1";

pub(super) const LIST: &str = "
SELECT * FROM jobs
WHERE life < :before AND NOT hidden AND (:state IS NULL OR state = :state)
    AND (:client IS NULL OR EXISTS (SELECT 1 FROM json_each(clients) WHERE value = :client))
ORDER BY life DESC LIMIT :limit";

pub(super) const UNFINISHED: &str = "SELECT * FROM jobs WHERE finished IS NULL ORDER BY life";

pub(super) const LAST_GENERATION: &str = "SELECT coalesce(max(life), 0) FROM jobs";

/// A job that is running when the database is opened was running when the process died, unless it waited for its
/// subtasks.
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

//! Jobs that are merged from others.

use std::sync::Arc;
use std::time::Instant;

use super::{Keeper, Portion};
use crate::embedded::board::Board;
use crate::embedded::parts::{Next, Parts, Split};
use crate::embedded::queue::{Taken, Waiting};
use crate::embedded::records::Write;
use crate::job::told_apart;
use crate::threads::run::{MERGE, Outcome, Told};
use crate::{Failure, Job, JobId, State, Submission};

impl Keeper {
    /// The job leaves its seat until its parts have ended.
    pub(super) fn split(self: &Arc<Self>, board: &mut Board, taken: &Taken, mut parts: Vec<Submission>) {
        let (id, life) = (taken.job.id, taken.life);
        let failure = if parts.iter().any(|part| part.id == id) {
            Some(Failure::Panicked("the job is a part of itself".to_owned()))
        } else if parts.iter().any(|part| board.given_up.remove(&part.id)) {
            // Begun anew with each life of the whole it would bring down process after process.
            Some(Failure::TooManyAttempts)
        } else {
            None
        };
        if let Some(failure) = failure {
            return self.end(board, id, life, Outcome::Failed(failure));
        }
        let Some(entry) = board.entry(id, life).filter(|entry| !entry.feeder.state().is_final()) else {
            return;
        };
        entry.run = None;
        for part in &mut parts {
            part.cost = told_apart(part.cost);
        }
        let split = Split::new(parts, taken);
        let bytes = split.bytes;
        entry.parts = Parts::Waiting(split);
        (board.split.0, board.split.1) = (board.split.0 + 1, board.split.1 + bytes);
        board.submitting.insert(life, id);
        self.recorder.write(Write::Split { life }, Box::new(drop));
    }

    /// Submits parts while there is room, those of the oldest job first.
    pub(super) fn submit_parts(self: &Arc<Self>, board: &mut Board) {
        while self.has_room_for_part(board)
            && let Some((life, id)) = board.submitting.first_key_value().map(|(life, id)| (*life, *id))
        {
            match waiting(board, id, life).and_then(Split::next) {
                Some(part) => self.submit_part(board, (id, life), part),
                None => drop(board.submitting.remove(&life)),
            }
        }
    }

    fn submit_part(self: &Arc<Self>, board: &mut Board, parent: (JobId, u64), mut part: Submission) {
        let (id, cost) = (part.id, part.cost);
        let Some(split) = waiting(board, parent.0, parent.1) else {
            return;
        };
        split.opened(id, cost);
        part.client.clone_from(&split.client);
        let portion = Portion { begins: split.after, of_small: split.is_small };
        split.after = split.after.plus(cost);
        match board.live.get(&id) {
            Some(entry) if entry.goes_on() => {
                let life = entry.life;
                self.join(board, life, &part, Some(portion));
            }
            _ => self.begin(board, part, Some(portion)),
        }
        if let Some(entry) = board.live.get_mut(&id) {
            entry.parents.push(parent);
            let life = entry.life;
            progressed(board, id, life);
        }
    }

    /// Tells those that waited for a part how it ended.
    pub(super) fn part_ended(self: &Arc<Self>, board: &mut Board, parents: Vec<(JobId, u64)>, part: &Job) {
        for (parent, life) in parents {
            match (part.state, &part.failure) {
                (State::Succeeded, _) => self.part_succeeded(board, (parent, life), part.id),
                (State::Failed, Some(failure)) => {
                    self.end(board, parent, life, Outcome::Failed(failure.clone()));
                }
                _ => self.end(board, parent, life, Outcome::Cancelled),
            }
        }
    }

    fn part_succeeded(&self, board: &mut Board, (id, life): (JobId, u64), part: JobId) {
        let Some(split) = waiting(board, id, life) else {
            return;
        };
        let whole = split.progressed(part, 1.0);
        let next = split.closed(part);
        if board.live.get(&id).is_some_and(|entry| entry.feeder.progress(whole)) {
            progressed(board, id, life);
        }
        match next {
            Next::Submit => drop(board.submitting.insert(life, id)),
            Next::Wait => {}
            Next::Merge => self.queue_merge(board, id, life),
        }
    }

    fn queue_merge(&self, board: &mut Board, id: JobId, life: u64) {
        let Some(split) = unsplit(board, id, life) else {
            return;
        };
        if let Some(entry) = board.entry(id, life) {
            entry.parts = Parts::Done;
            let cost = MERGE * entry.feeder.job().cost;
            let Split { client, bytes, .. } = split;
            let (is_small, since) = (self.is_small(cost, None), Instant::now());
            board.queue.push_first(life, Waiting { id, client, cost, bytes, is_small, since });
        }
    }

    /// The job has ended: its parts are wanted by others, or stop.
    pub(super) fn release_parts(self: &Arc<Self>, board: &mut Board, id: JobId, life: u64) {
        let Some(split) = unsplit(board, id, life) else {
            return;
        };
        for part in split.into_open() {
            let Some(entry) = board.live.get_mut(&part) else {
                continue;
            };
            entry.parents.retain(|parent| *parent != (id, life));
            let (life, wanted) = (entry.life, entry.is_wanted());
            if !wanted {
                self.stop(board, part, life, Told::Cancelled);
            }
        }
    }
}

fn waiting(board: &mut Board, id: JobId, life: u64) -> Option<&mut Split> {
    match &mut board.entry(id, life)?.parts {
        Parts::Waiting(split) => Some(split),
        Parts::Unknown | Parts::Done => None,
    }
}

/// Tells those that wait for a part how far it is.
pub(super) fn progressed(board: &mut Board, id: JobId, life: u64) {
    let Some(entry) = board.entry(id, life).filter(|entry| !entry.parents.is_empty()) else {
        return;
    };
    let (parents, progress) = (entry.parents.clone(), entry.feeder.job().progress);
    for (parent, life) in parents {
        if let Some(split) = waiting(board, parent, life) {
            let whole = split.progressed(id, progress);
            if board.live.get(&parent).is_some_and(|entry| entry.feeder.progress(whole)) {
                progressed(board, parent, life);
            }
        }
    }
}

/// The job waits no longer: what it waited for.
fn unsplit(board: &mut Board, id: JobId, life: u64) -> Option<Split> {
    let entry = board.entry(id, life)?;
    let Parts::Waiting(split) = std::mem::replace(&mut entry.parts, Parts::Unknown) else {
        return None;
    };
    board.submitting.remove(&life);
    (board.split.0, board.split.1) = (board.split.0 - 1, board.split.1 - split.bytes);
    Some(split)
}

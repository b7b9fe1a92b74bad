//! Records of jobs, and the changes of records.

use std::time::{Duration, SystemTime};

use crate::clients::Clients;
use crate::job::Job;
use crate::job_id::JobKey;

/// A job with the values that only the queue needs.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    pub(crate) generation: u64,
    pub(crate) job: Job,
    pub(crate) deadline: Option<Duration>,
    /// No client has submitted the job.
    pub(crate) is_only_subtask: bool,
}

impl Record {
    pub(crate) fn key(&self) -> JobKey {
        JobKey { id: self.job.id, generation: self.generation }
    }
}

/// A change of one record.
#[derive(Debug)]
pub(crate) enum Write {
    /// Replaces the record of an earlier generation.
    Submit(Record),
    SetDeadline {
        generation: u64,
        deadline: Option<Duration>,
    },
    /// A client has submitted a subtask: lists show it.
    List {
        generation: u64,
    },
    SetClients {
        generation: u64,
        clients: Clients,
    },
    /// The job waits for its subtasks.
    Wait {
        generation: u64,
    },
    Start {
        generation: u64,
        attempts: u32,
        started: SystemTime,
    },
    Finish {
        generation: u64,
        job: Job,
    },
    /// The job's run was stopped without a crash.
    Requeue {
        generation: u64,
    },
}

impl Write {
    /// Length of the payload that it writes.
    pub(crate) fn bytes(&self) -> usize {
        match self {
            Self::Submit(record) => record.job.payload.len(),
            _ => 0,
        }
    }
}

//! Schedules jobs. Every change of a job is made, and its record requested, under one lock. So records are written in
//! the order of the changes.

mod claims;
mod completion;
mod deadlines;
mod dispatch;
mod submission;
mod subtasks;

use std::sync::Arc;

use parking_lot::{Condvar, Mutex};
use tokio::sync::Notify;

use super::config::Config;
use super::job_table::JobTable;
use super::writer::Writer;
use crate::execution::preemption::Preemption;
use crate::work::Work;

pub(super) struct Scheduler {
    pub(super) table: Mutex<JobTable>,
    pub(super) writer: Writer,
    config: Config,
    work: Arc<dyn Work>,
    preemption: Arc<Preemption>,
    /// Notified when no run is left.
    idle: Notify,
    /// Notified when the earliest deadline may have changed.
    deadlines: Condvar,
}

impl Scheduler {
    pub(super) fn new(table: JobTable, writer: Writer, config: Config, work: Arc<dyn Work>) -> Self {
        Self {
            table: Mutex::new(table),
            writer,
            config,
            work,
            preemption: Arc::default(),
            idle: Notify::new(),
            deadlines: Condvar::new(),
        }
    }
}

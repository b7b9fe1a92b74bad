//! Stops jobs whose deadlines have passed.

use std::sync::Arc;
use std::time::Instant;

use super::Scheduler;
use crate::embedded::job_table::JobTable;
use crate::execution::stop::StopSignal;
use crate::job_id::JobKey;

impl Scheduler {
    pub(super) fn set_deadline(&self, table: &mut JobTable, key: JobKey, deadline: Option<Instant>) {
        table.set_deadline(key, deadline);
        if deadline.is_some() {
            self.deadlines.notify_one();
        }
    }

    /// Stops late jobs until the back end is closed. Needs a thread of its own.
    pub(crate) fn watch_deadlines(self: &Arc<Self>) {
        let mut table = self.table.lock();
        while !table.closed {
            match table.deadlines.first().copied() {
                Some((deadline, key)) if deadline <= Instant::now() => {
                    self.set_deadline(&mut table, key, None);
                    self.stop(&mut table, key, StopSignal::DeadlinePassed);
                }
                Some((deadline, _)) => drop(self.deadlines.wait_until(&mut table, deadline)),
                None => self.deadlines.wait(&mut table),
            }
        }
    }
}

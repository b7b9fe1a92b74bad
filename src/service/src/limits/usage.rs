//! The use of the limits, for the metrics.

use crate::limits::admission::{Admission, PAGE_BYTES};
use crate::limits::client_quota::Quota;

/// The use of a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Usage {
    /// What the limit applies to.
    pub of: &'static str,
    /// How many are in use, or how many bytes.
    pub taken: u64,
    /// How many there are.
    pub limit: u64,
}

impl Admission {
    /// The use of permits.
    pub(crate) fn permits(&self) -> [Usage; 7] {
        [
            ("requests", &self.requests),
            ("work", &self.slow_requests),
            ("batches", &self.batches),
            ("row_streams", &self.row_streams),
            ("meshes", &self.meshes),
            ("waiting", &self.waiting),
            ("streams", &self.streams),
        ]
        .map(|(of, quota)| usage(of, quota, 1))
    }

    /// The use of memory, in bytes.
    pub(crate) fn memory(&self) -> [Usage; 3] {
        [("bodies", &self.bodies), ("programs", &self.programs), ("answers", &self.responses)]
            .map(|(of, quota)| usage(of, quota, PAGE_BYTES))
    }
}

fn usage(of: &'static str, quota: &Quota, unit: u64) -> Usage {
    let (count, left) = (quota.count(), quota.left());
    Usage { of, taken: count.saturating_sub(left) as u64 * unit, limit: count as u64 * unit }
}

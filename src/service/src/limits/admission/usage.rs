//! How much is taken of what is bounded.

use crate::limits::admission::{Admission, PAGE};
use crate::limits::client_quota::Shares;

/// What is taken of a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Usage {
    /// What is bounded.
    pub of: &'static str,
    /// So many, or so many bytes, are taken.
    pub taken: u64,
    /// At most so many are.
    pub limit: u64,
}

impl Admission {
    /// Places for requests and what else is counted.
    pub(crate) fn places(&self) -> [Usage; 6] {
        [
            ("requests", &self.all),
            ("work", &self.work),
            ("batches", &self.batches),
            ("meshes", &self.meshes),
            ("waiting", &self.waiting),
            ("streams", &self.streams),
        ]
        .map(|(of, shares)| usage(of, shares, 1))
    }

    /// Memory, in bytes, as far as it is counted.
    pub(crate) fn memory(&self) -> [Usage; 2] {
        [("bodies", &self.bodies), ("answers", &self.outgoing)].map(|(of, shares)| usage(of, shares, PAGE))
    }
}

fn usage(of: &'static str, shares: &Shares, unit: u64) -> Usage {
    let (count, left) = (shares.count(), shares.left());
    Usage { of, taken: count.saturating_sub(left) as u64 * unit, limit: count as u64 * unit }
}

//! The number of windings of theta2.

use serde::Serialize;

/// How many values of theta2, by whole turns apart, a machine admits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub(crate) enum Windings {
    /// This many.
    Count(u32),
    /// Every one; null as JSON.
    Unlimited,
}

impl From<Option<u32>> for Windings {
    fn from(count: Option<u32>) -> Self {
        count.map_or(Self::Unlimited, Self::Count)
    }
}

//! The cost of a sequence of states.

use std::cmp::Ordering;

/// Turning that counts as equal, rad.
const EQUAL: f64 = 1e-9;

/// The cost of a sequence of states.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cost {
    pub(super) failing: f64,
    /// Number of times that the tool leaves the part.
    pub(super) retracts: u32,
    pub(super) turning: f64,
    pub(super) rotary_margin: f64,
    pub(super) start: f64,
    pub(super) is_turned: bool,
}

impl Cost {
    /// Before the first place.
    pub(super) const START: Self = Self {
        failing: 0.0,
        retracts: 0,
        turning: 0.0,
        rotary_margin: f64::INFINITY,
        start: 0.0,
        is_turned: false,
    };

    /// The cost of a sequence with one more place, which is `turning` away.
    pub(super) fn and(&self, place: &Self, turning: f64) -> Self {
        Self {
            failing: self.failing + place.failing,
            turning: self.turning + turning,
            rotary_margin: self.rotary_margin.min(place.rotary_margin),
            ..*self
        }
    }

    pub(super) fn compare(&self, other: &Self) -> Ordering {
        let by_turning = if (self.turning - other.turning).abs() <= EQUAL {
            Ordering::Equal
        } else {
            self.turning.total_cmp(&other.turning)
        };
        self.failing
            .total_cmp(&other.failing)
            .then(self.retracts.cmp(&other.retracts))
            .then(by_turning)
            .then(other.rotary_margin.total_cmp(&self.rotary_margin))
            .then(self.start.total_cmp(&other.start))
            .then(self.is_turned.cmp(&other.is_turned))
    }
}

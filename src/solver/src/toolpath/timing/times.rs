//! What is found out about the time of a program.

use super::super::rows::Row;

/// What determines how long something takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Governor {
    /// The programmed feed.
    Feed,
    /// The drive of a joint, by its velocity or its acceleration: 0 to 2 for rho1 to rho3, 3 for theta1, 4 for theta2.
    Joint(usize),
}

/// A row with its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedRow {
    /// The row.
    pub row: Row,
    /// Time from the row before to this one, s. `None`: the machine arrives from anywhere, or neither a feed nor drives
    /// determine it.
    pub duration: Option<f64>,
    /// What determines most of it; `None` if nothing moves, too.
    pub governor: Option<Governor>,
}

/// The time of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    /// Sum of the durations that are known, s.
    pub time: f64,
    /// The part of it that the feed governs, s.
    pub by_feed: f64,
    /// The parts of it that the drives of rho1-3, theta1 and theta2 govern, s.
    pub by_joint: [f64; 5],
    /// Number of rows to which the machine moves in an unknown time. Arrivals from anywhere do not count.
    pub unknown: u64,
}

impl Times {
    pub(super) fn add(&mut self, duration: f64, governor: Governor) {
        self.time += duration;
        match governor {
            Governor::Feed => self.by_feed += duration,
            Governor::Joint(joint) => self.by_joint[joint] += duration,
        }
    }
}

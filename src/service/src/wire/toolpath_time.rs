//! The time of a tool path.

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::toolpath::Times;

/// How long the program takes, and what determines it.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathTime)]
pub(crate) struct TimeObject {
    /// Seconds: the sum of the durations of the rows that have one, and of the program's waits. Tool changes, and ways
    /// to places that the machine reaches from anywhere, are not in it.
    pub seconds: f64,
    /// Number of rows to which the machine moves in an unknown time: neither a feed nor drives of the machine determine
    /// it.
    pub unknown_rows: u64,
    /// Shares of the time that the feed, the drives and the waits determine; null if it is zero.
    pub governed: Option<GovernedObject>,
}

/// The fractions of the time that the feed, the drive of each joint, and the program's waits determine. A drive does so
/// by its velocity or by its acceleration. The sum is 1.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = GovernedTime)]
pub(crate) struct GovernedObject {
    /// The programmed feed.
    pub feed: f64,
    /// The drive of the first slider.
    pub rho1: f64,
    /// The drive of the second slider.
    pub rho2: f64,
    /// The drive of the third slider.
    pub rho3: f64,
    /// The drive of the tilting axis.
    pub theta1: f64,
    /// The drive of the rotary axis.
    pub theta2: f64,
    /// The program's waits.
    pub wait: f64,
}

impl TimeObject {
    /// The time of rows, and the seconds that the program waits.
    pub(crate) fn new(times: &Times, waits: f64) -> Self {
        let seconds = times.time + waits;
        let [rho1, rho2, rho3, theta1, theta2] = times.by_joint.map(|time| time / seconds);
        let (feed, wait) = (times.by_feed / seconds, waits / seconds);
        let governed = GovernedObject { feed, rho1, rho2, rho3, theta1, theta2, wait };
        Self { seconds, unknown_rows: times.unknown, governed: (seconds > 0.0).then_some(governed) }
    }
}

//! How fast a motion is asked to be.

use super::super::rows::{Row, RowKind, Way};

/// The feed of a motion, as the program states it.
///
/// Lengths are millimetres, angles radians, times seconds; every value is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// Speed of the tool's end in the part frame, mm/s. The drives decide where it does not move.
    Tip(f64),
    /// Duration of the whole motion, s (inverse time). Its rows share it in proportion to the path parameter.
    Duration(f64),
    /// Speed of the axis, rad/s: of the angle along the great circle, or of the hypotenuse of the changes of phi1 and
    /// phi2 where these are linear. For motions of the axis alone, and for turns of the table at the pole.
    Axis(f64),
    /// As fast as the drives can.
    Drives,
}

/// What a program states about the time of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// The feed.
    pub feed: Feed,
    /// Whether the machine stands still before the motion, for instance because it waits there.
    pub from_rest: bool,
}

/// The time that the feed of its motion gives a row, s. `None`: the drives decide.
///
/// Rapids and other ways outside the part have no feed.
pub(super) fn feed_duration(feed: Feed, row: &Row, way: &Way) -> Option<f64> {
    match (row.kind, feed) {
        (RowKind::Feed | RowKind::Inserted, Feed::Tip(speed)) if way.length > 0.0 => Some(way.length / speed),
        (RowKind::Feed | RowKind::Inserted, Feed::Duration(all)) => Some(all * way.fraction),
        (RowKind::Feed | RowKind::Inserted | RowKind::Turn, Feed::Axis(speed)) if way.angle > 0.0 => {
            Some(way.angle / speed)
        }
        _ => None,
    }
}

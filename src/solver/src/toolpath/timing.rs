//! Times of rows, from feeds and drives.
//!
//! Without accelerations a row takes the longest of the way over the feed and of each joint's way over the velocity of
//! its drive. With accelerations the speed along the path is the greatest that slows down in time for all that follows:
//! a pass against the direction of motion finds where the machine must brake, a pass along it where it can speed up.
//! Inside a smooth track the accelerations hold on the track (see `segment`); where two tracks meet, the velocity of
//! each drive changes by at most what its acceleration changes in a cycle of the controller (see `corner`).
//!
//! Rows are timed as they come. Those that wait for what follows are bounded in number: the pass against the motion is
//! made from a standstill and from full speed at the last row, and where both agree, which is one stopping distance
//! before it, nothing later changes the speed. If the stopping distance has too many rows, the first half of them is
//! timed as if the machine had to stop at the last one. The limits then hold as well, only the time is longer.

mod corner;
mod pace;
mod passes;
mod phases;
mod segment;
mod times;
mod window;

pub use pace::{Feed, Pace};
pub use times::{Governor, TimedRow, Times};

use super::rows::{Row, RowKind, Way};
use crate::machine::{Drive, Drives};
use pace::feed_duration;
use segment::{Segment, least_duration};
use window::Window;

/// A motion that every drive makes in less than this time is none, s.
const STANDSTILL: f64 = 1e-9;

/// Times the rows of [`plan`](super::plan).
///
/// `pace` states the feed of a motion by its index; `emit` receives the rows with their times, in order.
///
/// # Units
///
/// Millimetres, radians and seconds.
///
/// # Examples
///
/// A straight line at 50 mm/s, which the drives slow down:
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::machine::{Drive, Drives};
/// use verne_solver::toolpath::{
///     Curve, Feed, Motion, MotionKind, Pace, PlanError, PlanOptions, Timer, ToolPosition, Turning, plan,
/// };
///
/// let to = |kind, x| Motion {
///     kind,
///     end: ToolPosition { tip: [x, 0.0, 300.0], axis: [0.0, 0.0, 1.0] },
///     curve: Curve::Line,
///     turning: Turning::GreatCircle,
///     tool_length: 100.0,
/// };
/// let program = [to(MotionKind::Arrive, -150.0), to(MotionKind::Feed, 150.0)];
/// let drive = Drive { velocity: 500.0, acceleration: Some(3000.0) };
/// let drives = Drives { slider: drive, tilt: drive, rotary: drive };
/// let pace = |_| Pace { feed: Feed::Tip(50.0), from_rest: false };
/// let mut durations = Vec::new();
/// let mut timer = Timer::new(Some(drives), 0.004, pace, |row| durations.push(row.duration));
/// plan(&Machine::verne(), &program[..], &PlanOptions::default(), |_| true, |row| timer.push(row))?;
/// let times = timer.finish();
/// assert!(times.time > 300.0 / 50.0, "the machine starts and ends at a standstill");
/// assert!(times.time < 6.1);
/// assert_eq!(durations[0], None, "the program does not say where the machine comes from");
/// # Ok::<(), PlanError>(())
/// ```
pub struct Timer<P, F> {
    drives: Option<[Drive; 5]>,
    pace: P,
    /// The motion of the last row, and its pace.
    now: Option<(usize, Pace)>,
    joints: Option<[f64; 5]>,
    window: Window<F>,
}

impl<P: FnMut(usize) -> Pace, F: FnMut(&TimedRow)> Timer<P, F> {
    /// A timer for a machine with these drives. In `cycle` seconds the drives' velocities may change at corners.
    ///
    /// # Units
    ///
    /// Millimetres, radians and seconds.
    ///
    /// # Examples
    ///
    /// See [`Timer`].
    pub fn new(drives: Option<Drives>, cycle: f64, pace: P, emit: F) -> Self {
        let drives = drives.map(|drives| drives.of_joints());
        let accelerating = drives.filter(|drives| drives.iter().any(|drive| drive.acceleration.is_some()));
        Self { drives, pace, now: None, joints: None, window: Window::new(accelerating, cycle, emit) }
    }

    /// Takes the next row.
    ///
    /// # Examples
    ///
    /// See [`Timer`].
    pub fn push(&mut self, row: &Row) {
        let [rho1, rho2, rho3] = row.rho;
        let joints = [rho1, rho2, rho3, row.table.theta1, row.table.theta2];
        let before = self.joints.replace(joints);
        let pace = self.pace_of(row.motion);
        let (Some(way), Some(before)) = (row.way, before) else {
            self.window.rest();
            self.window.push_timed(row, None);
            return;
        };
        let change = std::array::from_fn(|i| joints[i] - before[i]);
        self.advance(row, &way, &change, pace.feed);
    }

    /// The pace of a motion; the machine stands still before it if that says so.
    fn pace_of(&mut self, motion: usize) -> Pace {
        if let Some((now, pace)) = self.now
            && now == motion
        {
            return pace;
        }
        let pace = (self.pace)(motion);
        self.now = Some((motion, pace));
        if pace.from_rest {
            self.window.rest();
        }
        pace
    }

    fn advance(&mut self, row: &Row, way: &Way, change: &[f64; 5], feed: Feed) {
        let feed = feed_duration(feed, row, way);
        if is_point(row, way) || change.iter().all(|change| *change == 0.0) {
            // It takes no time, whatever its inverse time says.
            self.window.push_timed(row, Some((0.0, None)));
            return;
        }
        let Some(drives) = self.drives else {
            self.window.push_timed(row, feed.map(|feed| (feed, Some(Governor::Feed))));
            return;
        };
        let (by_drives, _) = least_duration(change, None, &drives);
        if by_drives < STANDSTILL || !self.window.is_accelerating() {
            let (duration, governor) = least_duration(change, feed, &drives);
            self.window.push_timed(row, Some((duration, Some(governor))));
            return;
        }
        let width = if way.fraction > 0.0 { way.fraction } else { 1.0 };
        self.window.push(row, Segment::new(width, change, feed, &drives));
    }

    /// Times the rows that still wait, up to a standstill at the end.
    ///
    /// # Examples
    ///
    /// See [`Timer`].
    pub fn finish(self) -> Times {
        self.window.finish()
    }
}

/// Whether neither the tool's end nor its axis moves in a cut. The joints then differ by their rounding only.
fn is_point(row: &Row, way: &Way) -> bool {
    matches!(row.kind, RowKind::Feed | RowKind::Inserted) && way.length == 0.0 && way.angle == 0.0
}

//! The motion to one row, and what limits the speed along it.
//!
//! The parameter along a motion is its path parameter s; the speed is ds/dt, and x its square. With a smooth track q(s)
//! of the joints, a drive's velocity is q' ds/dt and its acceleration q' u + q'' x with u = d²s/dt² = (dx/ds)/2.
//!
//! The track is known at the rows. Through each three consecutive rows of it leads a parabola; both segments between
//! these rows keep to the accelerations on this parabola. So the second divided difference of the joints by time, which
//! is a mean of the accelerations on the parabola, keeps to them exactly.

use arrayvec::ArrayVec;

use super::times::Governor;
use crate::machine::Drive;

/// Number of joints.
const JOINTS: usize = 5;
/// Two parabolas, two ends of the segment, five joints.
const MOST_BOUNDS: usize = 4 * JOINTS;

/// An upper bound of the acceleration u: `constant` - `slope` x while the speed grows, `constant` + `slope` x while it
/// falls (then of -u).
#[derive(Clone, Copy, Debug)]
struct Bound {
    joint: usize,
    constant: f64,
    slope: f64,
}

/// The motion from one row to the next.
#[derive(Clone, Debug)]
pub(super) struct Segment {
    /// Change of s.
    pub(super) width: f64,
    /// Change of the joints by s: of the chord, and at both ends of the track.
    chord: [f64; JOINTS],
    pub(super) begin: [f64; JOINTS],
    pub(super) end: [f64; JOINTS],
    /// Greatest x, and what determines it.
    pub(super) greatest: f64,
    pub(super) governor: Governor,
    bounds: ArrayVec<Bound, MOST_BOUNDS>,
    /// Whether it is on a parabola; otherwise it is straight.
    is_joined: bool,
}

impl Segment {
    /// The motion by `change` of the joints in which s changes by `width`. The feed takes it at least `feed`, s.
    pub(super) fn new(
        width: f64,
        change: &[f64; JOINTS],
        feed: Option<f64>,
        drives: &[Drive; JOINTS],
    ) -> Self {
        let (duration, governor) = least_duration(change, feed, drives);
        let speed = width / duration;
        let chord = change.map(|change| change / width);
        let mut segment = Self {
            width,
            chord,
            begin: chord,
            end: chord,
            greatest: speed * speed,
            governor,
            bounds: ArrayVec::new(),
            is_joined: false,
        };
        segment.bound(drives, &chord, &[0.0; JOINTS]);
        segment
    }

    /// Adds the bounds where the joints change by `slope` and their second derivative is `second`.
    fn bound(&mut self, drives: &[Drive; JOINTS], slope: &[f64; JOINTS], second: &[f64; JOINTS]) {
        for (joint, drive) in drives.iter().enumerate() {
            let Some(most) = drive.acceleration else { continue };
            let (steep, second) = (slope[joint].abs(), second[joint] * slope[joint].signum());
            if most < second.abs() * self.greatest {
                (self.greatest, self.governor) = (most / second.abs(), Governor::Joint(joint));
            }
            // There is room: a segment belongs to two parabolas.
            if steep > 0.0 && !self.bounds.is_full() {
                self.bounds.push(Bound { joint, constant: most / steep, slope: second / steep });
            }
        }
    }

    /// Lets two segments of one track keep to the accelerations on the parabola through their three rows.
    pub(super) fn join(before: &mut Self, after: &mut Self, drives: &[Drive; JOINTS]) {
        let width = before.width + after.width;
        let second = std::array::from_fn(|i| 2.0 * (after.chord[i] - before.chord[i]) / width);
        if !before.is_joined {
            before.bounds.clear();
            before.begin = before.at(&second, -0.5);
        }
        after.bounds.clear();
        after.end = after.at(&second, 0.5);
        for segment in [before, after] {
            segment.is_joined = true;
            segment.follow(drives, &second);
        }
    }

    fn follow(&mut self, drives: &[Drive; JOINTS], second: &[f64; JOINTS]) {
        for part in [-0.5, 0.5] {
            let slope = self.at(second, part);
            self.bound(drives, &slope, second);
        }
    }

    /// The change of the joints by s on a parabola, at a place from -1/2 to 1/2.
    fn at(&self, second: &[f64; JOINTS], part: f64) -> [f64; JOINTS] {
        std::array::from_fn(|i| self.chord[i] + part * self.width * second[i])
    }

    /// The greatest constant growth of the speed with which x may grow from `low` along the whole segment, or, if not
    /// `is_growing`, with which x may fall to `low`. Infinite if no drive that has to move has an acceleration.
    pub(super) fn acceleration(&self, low: f64, is_growing: bool) -> (f64, Governor) {
        let mut least = (f64::INFINITY, self.governor);
        for bound in &self.bounds {
            let slope = if is_growing { bound.slope } else { -bound.slope };
            let most = if slope > 0.0 {
                // x grows to the end of the segment, or to its greatest value.
                let at_end = (bound.constant - slope * low) / (1.0 + 2.0 * slope * self.width);
                at_end.max(bound.constant - slope * self.greatest)
            } else {
                bound.constant - slope * low
            };
            if most < least.0 {
                least = (most.max(0.0), Governor::Joint(bound.joint));
            }
        }
        least
    }
}

/// The longest of the feed's time and the times of the drives at their velocities, s.
pub(super) fn least_duration(
    change: &[f64; JOINTS],
    feed: Option<f64>,
    drives: &[Drive; JOINTS],
) -> (f64, Governor) {
    let by_drives = change.iter().zip(drives).map(|(change, drive)| change.abs() / drive.velocity);
    let by_feed = (feed.unwrap_or(0.0), Governor::Feed);
    by_drives.enumerate().fold(by_feed, |longest, (joint, time)| {
        if time > longest.0 { (time, Governor::Joint(joint)) } else { longest }
    })
}

//! How fast the machine may be where two segments meet.

use super::segment::Segment;
use crate::machine::Drive;

/// What joins the speeds at the end of a segment and at the beginning of the next. Speeds are squares of ds/dt, each by
/// the path parameter of its own segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    /// Greatest speed before and after.
    pub(super) greatest: [f64; 2],
    /// Speed after the corner over that before it; `None`: they are independent.
    pub(super) ratio: Option<f64>,
}

impl Corner {
    /// Inside a smooth track.
    pub(super) const SMOOTH: Self = Self { greatest: [f64::INFINITY; 2], ratio: Some(1.0) };
    /// The machine stands still.
    pub(super) const REST: Self = Self { greatest: [0.0; 2], ratio: None };

    /// Between two tracks. The joints' speed, weighted by their accelerations, is the same before and after the corner:
    /// the rule is the same in both directions, and no drive's velocity changes on a straight track. The velocity of
    /// each drive changes by at most what its acceleration changes in `cycle` seconds.
    pub(super) fn between(before: &Segment, after: &Segment, drives: &[Drive; 5], cycle: f64) -> Self {
        let [weight_before, weight_after] = [&before.end, &after.begin].map(|slope| weight(slope, drives));
        if weight_before > 0.0 && weight_after > 0.0 {
            let ratio = weight_before / weight_after;
            let step = |i: usize| ratio * after.begin[i] - before.end[i];
            let speed = slowest(step, drives, cycle);
            return Self { greatest: [speed * speed, f64::INFINITY], ratio: Some(ratio * ratio) };
        }
        let speeds = [slowest(|i| before.end[i], drives, cycle), slowest(|i| after.begin[i], drives, cycle)];
        Self { greatest: speeds.map(|speed| speed * speed), ratio: None }
    }
}

/// The greatest speed at which the velocity of each drive, `step` times the speed, changes within a cycle.
fn slowest(step: impl Fn(usize) -> f64, drives: &[Drive; 5], cycle: f64) -> f64 {
    let speeds = drives.iter().enumerate().filter_map(|(i, drive)| {
        let step = step(i).abs();
        drive.acceleration.filter(|_| step > 0.0).map(|most| most * cycle / step)
    });
    speeds.fold(f64::INFINITY, f64::min)
}

fn weight(slope: &[f64; 5], drives: &[Drive; 5]) -> f64 {
    let parts = slope.iter().zip(drives).filter_map(|(slope, drive)| Some(slope / drive.acceleration?));
    parts.map(|part| part * part).sum::<f64>().sqrt()
}

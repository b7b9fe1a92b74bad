//! The postures of a pose at which leg I closes.

use super::infeasibility;
use super::leg_one_pose::{ClosedLeg, LegOnePose};
use super::parallelogram_leg::{LegHeight, ParallelogramLeg};
use crate::error::KinematicsError;
use crate::fast_math::greater;
use crate::limit::Margin;
use crate::machine::Machine;
use crate::mechanism::Mechanism;
use crate::pose::PlatformPose;
use crate::posture::{Mode, Posture, Postures, Side};

/// The heights of legs II and III; `None` if one does not reach.
#[inline]
fn heights(legs: &[ParallelogramLeg<'_>; 2]) -> Option<[LegHeight; 2]> {
    Some([legs[0].height()?, legs[1].height()?])
}

/// Adds all postures of a pose.
#[inline]
pub(super) fn add_postures(mechanism: &Mechanism, pose: &LegOnePose, found: &mut Postures) {
    let legs = ParallelogramLeg::both(mechanism, pose);
    if let Some(heights) = heights(&legs) {
        add_both_sides(mechanism, pose, &legs, heights, found);
    }
}

/// Adds all postures of a pose and of its mirror image: the heights depend on c alone.
#[inline]
pub(super) fn add_mirrored_postures(mechanism: &Mechanism, above: &LegOnePose, found: &mut Postures) {
    let legs = ParallelogramLeg::both(mechanism, above);
    if let Some(heights) = heights(&legs) {
        add_both_sides(mechanism, above, &legs, heights, found);
        // A level leg I with a level platform equals its own mirror image.
        if above.s != 0.0 || above.w1 != 0.0 {
            let below = above.mirrored(mechanism);
            add_both_sides(mechanism, &below, &ParallelogramLeg::both(mechanism, &below), heights, found);
        }
    }
}

/// Adds the postures with the sliders of legs II and III above and below.
#[inline]
fn add_both_sides(
    mechanism: &Mechanism,
    pose: &LegOnePose,
    [second, third]: &[ParallelogramLeg<'_>; 2],
    heights: [LegHeight; 2],
    found: &mut Postures,
) {
    let (seconds, thirds) = (second.sides(heights[0].value), third.sides(heights[1].value));
    let merged = heights[0].merged || heights[1].merged;
    let accepted = |leg: &ClosedLeg| pose.accepts(leg);
    let all_accepted = accepted(&pose.leg_one) && seconds.iter().chain(&thirds).all(accepted);
    // Nearly always all four exist, and none needs a special case.
    if !merged && all_accepted && found.remaining_capacity() >= 4 {
        for leg2 in &seconds {
            for leg3 in &thirds {
                found.push(posture(mechanism, pose, [leg2, leg3], false));
            }
        }
        return;
    }
    let distinct = [&seconds[usize::from(heights[0].merged)..], &thirds[usize::from(heights[1].merged)..]];
    add_accepted(mechanism, pose, distinct, merged, found);
}

/// Like [`add_both_sides`], for the case that two sides have merged (and count once) or that a posture does not satisfy
/// Eqs (3)-(6).
#[cold]
fn add_accepted(
    mechanism: &Mechanism,
    pose: &LegOnePose,
    [seconds, thirds]: [&[ClosedLeg]; 2],
    merged: bool,
    found: &mut Postures,
) {
    for leg2 in seconds {
        for leg3 in thirds {
            let accepted = [&pose.leg_one, leg2, leg3].iter().all(|leg| pose.accepts(leg));
            // Leg I has at most six angles, and each has at most four postures: the capacity suffices.
            if accepted && !found.is_full() {
                found.push(posture(mechanism, pose, [leg2, leg3], merged));
            }
        }
    }
}

/// The posture of a closed leg I and these two.
#[inline(always)]
fn posture(mechanism: &Mechanism, pose: &LegOnePose, [leg2, leg3]: [&ClosedLeg; 2], merged: bool) -> Posture {
    let g = &mechanism.geometry;
    let (crossed, v) = (mechanism.crosses(pose.alpha), g.R1 * pose.s);
    let above = (leg2.side == Side::Above) & (leg3.side == Side::Above);
    let [x, y, z] = pose.p;
    Posture {
        pose: PlatformPose { x, y, z, alpha: pose.alpha },
        rho: [pose.leg_one.rho, leg2.rho, leg3.rho],
        mode: Mode { legs: [pose.leg_one.side, leg2.side, leg3.side], crossed },
        working: above & !merged & !crossed & (pose.w1 > v.abs()),
        merged: merged || pose.merged,
        residual: greater(pose.leg_one.error, greater(leg2.error, leg3.error)),
    }
}

/// The posture with all sliders above, if it is in the working mode; otherwise the constraint that prevents it.
#[inline]
pub(super) fn working_posture(machine: &Machine, pose: &LegOnePose) -> Result<Posture, KinematicsError> {
    let (posture, is_solution) = posture_above(&machine.mechanism, pose);
    if is_solution { Ok(posture) } else { Err(KinematicsError::Unreachable(not_working(machine, pose))) }
}

/// The posture with all sliders above, and whether it is a solution in the working mode.
#[inline(always)]
pub(super) fn posture_above(mechanism: &Mechanism, pose: &LegOnePose) -> (Posture, bool) {
    let [second, third] = ParallelogramLeg::both(mechanism, pose);
    let (square2, square3) = (second.height_square(), third.height_square());
    // A leg whose two sides have merged belongs to no mode.
    let apart = (square2 > second.rounding()) & (square3 > third.rounding());
    let (leg2, leg3) = (second.close(Side::Above, square2.sqrt()), third.close(Side::Above, square3.sqrt()));
    let accepted = pose.accepts(&pose.leg_one) & pose.accepts(&leg2) & pose.accepts(&leg3);
    let posture = posture(mechanism, pose, [&leg2, &leg3], false);
    (posture, apart & accepted & posture.working)
}

/// The constraint that keeps the posture with all sliders above out of the working mode.
#[cold]
fn not_working(machine: &Machine, pose: &LegOnePose) -> Margin {
    let legs = ParallelogramLeg::both(&machine.mechanism, pose);
    let [excess2, excess3] = legs.map(|leg| leg.height_square() - leg.rounding());
    if excess2 <= 0.0 || excess3 <= 0.0 {
        return infeasibility::leg_length(excess2, excess3);
    }
    // A posture in the working mode whose legs close with too large an error is at the limit of their lengths.
    infeasibility::out_of_mode(machine, pose).unwrap_or_else(|| infeasibility::leg_length(-0.0, -0.0))
}

//! The constraint that prevents an inverse solution.

use std::f64::consts::{PI, TAU};

use super::leg_one_closure::LegOneClosure;
use super::leg_one_height::signed_root;
use super::leg_one_pose::LegOnePose;
use super::parallelogram_leg::ParallelogramLeg;
use super::platform_locus::PlatformLocus;
use crate::fast_math::sin_cos;
use crate::limit::{Constraint, Element, Margin};
use crate::loop_closure::{Roots, find_roots};
use crate::machine::Machine;
use crate::mechanism::Mechanism;

/// Number of angles at which leg I is evaluated.
const SAMPLES: u32 = 32;
/// Golden-section steps around the best sample: the margin to about a micrometre.
const STEPS: usize = 20;

/// The margin if no mode has a posture: leg I does not close, or another leg is too short where it closes.
#[cold]
pub(super) fn of_every_mode(machine: &Machine, locus: &PlatformLocus) -> Margin {
    let mut roots = Roots::new();
    find_roots(&LegOneClosure::new(&machine.mechanism, locus), PI, None, &mut roots);
    roots
        .iter()
        .filter_map(|root| unreachable_leg(&machine.mechanism, &locus.pose(&machine.mechanism, root)))
        .max_by(|a, b| a.value.total_cmp(&b.value))
        .unwrap_or_else(|| of_leg_one(machine, locus))
}

/// The margin if leg I closes at no angle in the working mode: its rods cross or a slider end is too low where it
/// closes, or it does not close, and the margin is its distance from closing at the best angle.
#[cold]
pub(super) fn of_leg_one(machine: &Machine, locus: &PlatformLocus) -> Margin {
    let closure = LegOneClosure::new(&machine.mechanism, locus);
    let mut roots = Roots::new();
    find_roots(&closure, PI, None, &mut roots);
    roots
        .iter()
        .filter_map(|root| out_of_mode(machine, &locus.pose(&machine.mechanism, root)))
        .max_by(|a, b| a.value.total_cmp(&b.value))
        .unwrap_or_else(|| {
            // The margin is negative where there is no root, but for the rounding at the limit itself.
            let value = best_margin(&closure).min(-f64::EPSILON * machine.mechanism.longest);
            Margin { constraint: Constraint::LegLength, element: Element::Leg(1), value }
        })
}

/// The greatest closing margin of leg I over the platform's angles.
fn best_margin(closure: &LegOneClosure) -> f64 {
    let margin = |a: f64| {
        let (s, c) = sin_cos(a);
        closure.closing_margin(c, s)
    };
    let step = TAU / f64::from(SAMPLES);
    let best = (0..SAMPLES)
        .map(|i| f64::from(i) * step - PI)
        .max_by(|a, b| margin(*a).total_cmp(&margin(*b)))
        .unwrap_or(0.0);
    let (mut low, mut high) = (best - step, best + step);
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        if margin(low + third) < margin(high - third) { low += third } else { high -= third }
    }
    margin(0.5 * (low + high))
}

/// The length margin of leg II or III, from the squares of their heights: the shorter leg's.
#[cold]
pub(super) fn leg_length(second: f64, third: f64) -> Margin {
    let (leg, square) = if second <= third { (2, second) } else { (3, third) };
    Margin { constraint: Constraint::LegLength, element: Element::Leg(leg), value: signed_root(square) }
}

/// The length margin of the leg II or III that does not reach a pose, if there is one.
#[cold]
fn unreachable_leg(mechanism: &Mechanism, pose: &LegOnePose) -> Option<Margin> {
    let [second, third] = ParallelogramLeg::both(mechanism, pose).map(|leg| leg.height_square());
    (second < 0.0 || third < 0.0).then(|| leg_length(second, third))
}

/// The margin of the constraint that keeps leg I out of the working mode: its rods cross, or a slider end lies lower
/// than its platform end. `None` if there is none.
#[cold]
pub(super) fn out_of_mode(machine: &Machine, pose: &LegOnePose) -> Option<Margin> {
    let g = machine.geometry();
    let (u, v) = (g.R1 * pose.c - g.r1, g.R1 * pose.s);
    if machine.mechanism.crosses(pose.alpha) {
        return Some(Margin { constraint: Constraint::RodCrossing, element: Element::Leg(1), value: u });
    }
    let (rod, height) = if v > 0.0 { (12, pose.w1 - v) } else { (11, pose.w1 + v) };
    let value = height / g.L1 - machine.limits().serial_margin;
    let margin = Margin { constraint: Constraint::SerialSingularity, element: Element::Rod(rod), value };
    (height <= 0.0).then_some(margin)
}

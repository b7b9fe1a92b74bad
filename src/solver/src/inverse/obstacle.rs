//! The reason why a position has no inverse solution.

use std::f64::consts::{PI, TAU};

use super::legs;
use super::track::{LegOne, Track};
use crate::angle::sin_cos;
use crate::closure::{Roots, find_roots};
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;

/// Number of angles at which leg I is evaluated.
const TRIALS: u32 = 32;
/// Golden-section steps around the best trial: the margin to about a micrometre.
const STEPS: usize = 20;

/// The margin if no mode has a posture: leg I does not close, or another leg is too short where it closes.
#[cold]
pub(super) fn of_all(machine: &Machine, track: &Track) -> Margin {
    let mut roots = Roots::new();
    find_roots(&LegOne::new(machine, track), PI, None, &mut roots);
    roots
        .iter()
        .filter_map(|root| legs::reach_of_others(machine, &track.closed(machine, root)))
        .max_by(|a, b| a.value.total_cmp(&b.value))
        .unwrap_or_else(|| of_leg_one(machine, track))
}

/// The margin if leg I closes at no angle in the working mode: its rods cross or a slider end is too low where it
/// closes, or it does not close and misses by this much at the best angle.
#[cold]
pub(super) fn of_leg_one(machine: &Machine, track: &Track) -> Margin {
    let leg = LegOne::new(machine, track);
    let mut roots = Roots::new();
    find_roots(&leg, PI, None, &mut roots);
    roots
        .iter()
        .filter_map(|root| legs::out_of_mode(machine, &track.closed(machine, root)))
        .max_by(|a, b| a.value.total_cmp(&b.value))
        .unwrap_or_else(|| {
            // The slack is negative where there is no root, but for the rounding at the limit itself.
            let value = best_slack(&leg).min(-f64::EPSILON * machine.derived.scale);
            Margin { constraint: Constraint::LegLength, element: Element::Leg(1), value }
        })
}

/// The greatest slack of leg I over the platform's angles.
fn best_slack(leg: &LegOne) -> f64 {
    let slack = |a: f64| {
        let (s, c) = sin_cos(a);
        leg.slack(c, s)
    };
    let step = TAU / f64::from(TRIALS);
    let best = (0..TRIALS)
        .map(|i| f64::from(i) * step - PI)
        .max_by(|a, b| slack(*a).total_cmp(&slack(*b)))
        .unwrap_or(0.0);
    let (mut low, mut high) = (best - step, best + step);
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        if slack(low + third) < slack(high - third) { low += third } else { high -= third }
    }
    slack(0.5 * (low + high))
}

//! The values of places in a set-up, and the worst of them.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::criteria::{Criteria, VALUES, Values};
use crate::machine::Machine;
use crate::toolpath::planned_places::PlannedPlaces;
use crate::toolpath::set_up::SetUp;

/// Number of parameters of a set-up.
pub(super) const PARAMETERS: usize = SetUp::PARAMETERS;

/// What the excess over a limit costs in units of reserve: so much that a set-up within all limits is better than any
/// other.
pub(super) const PENALTY: f64 = 1e3;
/// Number of sectors of cuts by the middle of their theta2. The widest cut of each represents it.
const SECTORS: usize = 64;
/// Places that one task examines.
const PLACES_PER_TASK: usize = 4096;

/// A placement with frozen tracks.
pub(in crate::toolpath) struct Problem<'a> {
    pub(in crate::toolpath) machine: &'a Machine,
    pub(in crate::toolpath) places: &'a PlannedPlaces,
    pub(in crate::toolpath) criteria: &'a Criteria,
    /// Bounds of each parameter; equal ones fix it.
    pub(in crate::toolpath) bounds: [[f64; 2]; PARAMETERS],
    /// What counts as a millimetre of each parameter.
    pub(in crate::toolpath) units: [f64; PARAMETERS],
    /// Whether all places are on the other preimage than planned.
    pub(in crate::toolpath) other: bool,
    /// Least value, as a fraction of the range, of margins without a reserve.
    pub(in crate::toolpath) guard: f64,
    /// Middle and half of the range of theta2 of cuts in the set-up of the plan, and whether it turns with the set-up.
    pub(in crate::toolpath) cuts: Vec<([f64; 2], bool)>,
}

/// The values of places, and the margins of the rotary axis in each cut.
pub(super) struct Sampled {
    pub(super) places: Vec<Values>,
    pub(super) cuts: Vec<f64>,
}

/// The worst values of a set-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Score {
    /// The least value of margins without a reserve, at most zero.
    pub(super) limit: f64,
    /// The least value of margins with a reserve.
    pub(super) reserve: f64,
}

impl Score {
    /// By what set-ups compare. Where no place is reached there is no reserve.
    pub(super) fn merit(&self) -> f64 {
        let reserve = if self.reserve.is_finite() { self.reserve } else { 0.0 };
        reserve + PENALTY * self.limit
    }
}

impl Problem<'_> {
    /// The values of some places.
    pub(super) fn sample(&self, set: &[u32], set_up: &SetUp) -> Sampled {
        let mut places = Vec::with_capacity(set.len());
        self.places.margins(self.machine, set, (set_up, self.other), |_, margins| {
            places.push(self.criteria.values(self.machine, margins));
        });
        Sampled { places, cuts: self.rotary(set_up) }
    }

    /// The margins of the rotary axis on the best winding of each cut, as values.
    fn rotary(&self, set_up: &SetUp) -> Vec<f64> {
        let Some([low, high]) = self.machine.limits().rotary else { return Vec::new() };
        let turn = set_up.turn - self.places.set_up.turn;
        let of_cut = |([centre, half], is_turned): &([f64; 2], bool)| {
            let centre = centre - if *is_turned { turn } else { 0.0 };
            cut_margin([low, high], [centre, *half], self.other) * self.criteria.rotary
        };
        self.cuts.iter().map(of_cut).collect()
    }

    /// The worst values.
    pub(super) fn score(&self, sampled: &Sampled) -> Score {
        let mut score = Score { limit: 0.0, reserve: f64::INFINITY };
        let rotary = sampled.cuts.iter().map(|value| (*value, self.criteria.rotary_has_reserve));
        let places =
            sampled.places.iter().flat_map(|values| values.iter().copied().zip(self.criteria.has_reserve));
        for (value, has_reserve) in places.chain(rotary) {
            if has_reserve {
                score.reserve = score.reserve.min(value);
            } else {
                score.limit = score.limit.min(value - self.guard);
            }
        }
        score
    }

    /// The places with the least value of each kind in each part of the program, with these values less the limit, or
    /// the least reserve, that they compare with. Every place of the program takes part.
    pub(in crate::toolpath) fn worst_places(&self, set_up: &SetUp) -> Vec<(u32, bool, f64)> {
        let all: Vec<u32> = (0..self.places.places.len()).map(number).collect();
        let parts: Vec<Vec<(u32, bool, f64)>> = all
            .par_chunks(PLACES_PER_TASK)
            .map(|part| {
                let mut worst = [(f64::INFINITY, 0_u32); VALUES];
                self.places.margins(self.machine, part, (set_up, self.other), |i, margins| {
                    let values = self.criteria.values(self.machine, margins);
                    for (worst, value) in worst.iter_mut().zip(values) {
                        if value < worst.0 {
                            *worst = (value, part[i]);
                        }
                    }
                });
                let found = worst.into_iter().zip(self.criteria.has_reserve);
                let found = found.filter(|((value, _), _)| value.is_finite());
                found
                    .map(|((value, place), has_reserve)| {
                        (place, has_reserve, if has_reserve { value } else { value - self.guard })
                    })
                    .collect()
            })
            .collect();
        parts.into_iter().flatten().collect()
    }

    /// A set-up within the bounds.
    pub(super) fn clamped(&self, parameters: [f64; PARAMETERS]) -> [f64; PARAMETERS] {
        std::array::from_fn(|i| parameters[i].clamp(self.bounds[i][0], self.bounds[i][1]))
    }
}

/// The margin of the rotary axis, rad, on the best winding of a cut whose theta2 has this middle and this half width,
/// on the planned preimage or on the other.
fn cut_margin([low, high]: [f64; 2], [centre, half]: [f64; 2], other: bool) -> f64 {
    let centre = centre + if other { PI } else { 0.0 };
    let centre = centre - TAU * ((centre - 0.5 * (low + high)) / TAU).round();
    (centre - half - low).min(high - centre - half)
}

/// The ranges of theta2 of the cuts: the widest ones in sectors of their middles.
pub(in crate::toolpath) fn cut_ranges(places: &PlannedPlaces) -> Vec<([f64; 2], bool)> {
    let mut widest = [[None::<[f64; 2]>; SECTORS]; 2];
    let mut note = |range: Option<([f64; 2], bool)>| {
        let Some(([low, high], is_turned)) = range else { return };
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let sector = sector(centre);
        let known = &mut widest[usize::from(is_turned)][sector];
        if known.is_none_or(|[_, widest]| half > widest) {
            *known = Some([centre, half]);
        }
    };
    let (mut cut, mut range) = (usize::MAX, None);
    for place in &places.places {
        if place.cut != cut {
            note(range.take());
            cut = place.cut;
        }
        let theta2 = -place.phi2;
        let ([low, high], _) = range.unwrap_or(([theta2; 2], place.is_turned));
        range = Some(([low.min(theta2), high.max(theta2)], place.is_turned));
    }
    note(range);
    let of = |is_turned: bool| {
        widest[usize::from(is_turned)].iter().flatten().map(move |range| (*range, is_turned))
    };
    of(false).chain(of(true)).collect()
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a fraction of a turn, by a small number"
)]
fn sector(angle: f64) -> usize {
    let fraction = (angle / TAU).rem_euclid(1.0);
    ((fraction * SECTORS as f64) as usize).min(SECTORS - 1)
}

/// The number of a place. A program has fewer places than 32 bits can number.
pub(in crate::toolpath) fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

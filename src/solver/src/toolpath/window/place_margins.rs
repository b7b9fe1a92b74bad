//! The worst margin at the places of a long program's path, without a plan.

use super::sample::Sample;
use crate::error::KinematicsError;
use crate::machine::Machine;
use crate::margins::Margins;
use crate::toolpath::PlanOptions;
use crate::toolpath::planned_places::PlannedPlaces;
use crate::toolpath::set_up::{AdjustableProgram, SetUp};

/// Places of long parts of the path for each that the choice of tracks examines.
const DENSITY: f64 = 4.0;
/// Fraction that stands for a place whose margins are unknown.
const UNKNOWN: f64 = -1.0;

/// The places of a program whose set-up depends linearly on a parameter.
pub(super) struct PlaceMargins {
    places: PlannedPlaces,
    indices: Vec<u32>,
    /// The set-ups with the values 0 and 1.
    set_ups: [SetUp; 2],
}

impl PlaceMargins {
    /// The places on the tracks that the program has with a value.
    pub(super) fn of(
        machine: &Machine,
        (program, set_ups): (&dyn AdjustableProgram, [SetUp; 2]),
        value: f64,
        options: &PlanOptions,
    ) -> Self {
        let places = PlannedPlaces::of_program(machine, program, at(&set_ups, value), options, DENSITY);
        let count = u32::try_from(places.places.len()).unwrap_or(u32::MAX);
        Self { places, indices: (0..count).collect(), set_ups }
    }

    /// The worst margin with a value, where every cut is on the better of its preimages. The range of theta2, and the
    /// ways between the places, take no part.
    pub(super) fn sample(&self, machine: &Machine, value: f64) -> Sample {
        let set_up = at(&self.set_ups, value);
        let own = self.worst_of_cuts(machine, &set_up, false);
        let mut worst = own.iter().copied().fold(f64::INFINITY, f64::min);
        if worst < 0.0 {
            let other = self.worst_of_cuts(machine, &set_up, true);
            worst = own.iter().zip(other).fold(f64::INFINITY, |worst, (a, b)| worst.min(a.max(b)));
        }
        Sample { value, is_feasible: worst >= 0.0, fraction: worst, worst: None }
    }

    /// The worst margin of every cut as a fraction of its range, all of them on one preimage.
    fn worst_of_cuts(&self, machine: &Machine, set_up: &SetUp, other: bool) -> Vec<f64> {
        let places = &self.places.places;
        let mut worst = vec![f64::INFINITY; places.last().map_or(0, |last| last.cut + 1)];
        self.places.margins(machine, &self.indices, (set_up, other), |i, margins| {
            let fraction = match margins {
                Ok(margins) => Margins { rotary: None, ..*margins }.worst_with_fraction(machine).1,
                Err(KinematicsError::Unreachable(margin)) => margin.fraction(machine),
                Err(_) => UNKNOWN,
            };
            let cut = &mut worst[places[i].cut];
            *cut = cut.min(fraction);
        });
        worst
    }
}

fn at([zero, one]: &[SetUp; 2], value: f64) -> SetUp {
    let (zero, one) = (zero.parameters(), one.parameters());
    SetUp::of_parameters(std::array::from_fn(|i| zero[i] + (one[i] - zero[i]) * value))
}

//! Plans of a program with values of its parameter.

use rayon::prelude::*;

use super::program::ParametricProgram;
use super::sample::{Found, Sample};
use super::scan::{ScanSettings, scan};
use crate::machine::Machine;
use crate::toolpath::{PlanError, PlanOptions, plan};
use crate::workspace::Observer;

/// Fraction of the work after which the ends are refined.
pub(super) const SCANNED: f64 = 0.7;

/// What a search for windows keeps to.
pub(super) struct Search<'a> {
    pub(super) machine: &'a Machine,
    pub(super) program: &'a dyn ParametricProgram,
    pub(super) options: &'a PlanOptions,
    pub(super) observer: &'a dyn Observer,
}

impl Search<'_> {
    /// Plans the whole program.
    pub(super) fn plan(&self, value: f64) -> Result<Sample, PlanError> {
        let motions = self.program.motions(value);
        let mut calls = 0_u32;
        let go_on = |_| {
            calls = calls.wrapping_add(1);
            calls % 64 != 1 || !self.observer.cancelled()
        };
        let report = plan(self.machine, &*motions, self.options, go_on, |_| {})?;
        let worst = report.worst(self.machine);
        let fraction = worst.map_or(0.0, |worst| worst.margin.fraction(self.machine));
        let is_feasible = report.is_feasible();
        // A plan without a place keeps all limits.
        let fraction = if is_feasible { fraction.max(0.0) } else { fraction.min(-f64::MIN_POSITIVE) };
        Ok(Sample { value, is_feasible, fraction, worst })
    }

    pub(super) fn plan_all(&self, values: &[f64]) -> Result<Vec<Sample>, PlanError> {
        values.par_iter().map(|value| self.plan(*value)).collect()
    }

    pub(super) fn scanned(
        &self,
        range: [f64; 2],
        settings: &ScanSettings,
        observer: &dyn Observer,
    ) -> Result<Found, PlanError> {
        scan(range, settings, observer, |value| self.plan(value))
    }
}

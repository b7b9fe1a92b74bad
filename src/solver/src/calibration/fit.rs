//! The method of Levenberg and Marquardt with weights, prior knowledge and bounds.

use nalgebra::{DMatrix, DVector, Vector3};

use super::CalibrationError;
use super::information::Information;
use super::loss::{Loss, Weighting, robust_scale};
use super::model::{Model, State, TipRates};
use super::triangle::Triangle;
use crate::workspace::Observer;

/// Most steps of one minimisation.
const MOST_STEPS: usize = 200;
/// Part of a standard deviation that a further step could improve all unknowns by, together.
const ACCURACY: f64 = 1e-4;
/// Change of a residual that is rounding, relative to the machine.
const ROUNDING: f64 = 1e-13;
/// First damping, relative to the square of the greatest singular value.
const FIRST_DAMPING: f64 = 1e-9;
/// Damping, relative to the same, with which steps are too short to change anything.
const MOST_DAMPING: f64 = 1e12;
/// Scales of the robust loss that do not make the residuals smaller, after which it shrinks no more.
const STALE_SCALES: usize = 3;
/// Residuals that shrink by less have settled.
const SETTLED: f64 = 0.98;
/// Standard deviation of the parameters at the start, relative to the machine, while residuals are large.
const ROUGH: f64 = 0.01;

/// What is known about an unknown beside the measurements, mm.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Knowledge {
    /// Value and standard deviation.
    pub(super) prior: Option<[f64; 2]>,
    /// Least and greatest value.
    pub(super) bounds: Option<[f64; 2]>,
}

/// A minimisation.
#[derive(Clone, Copy)]
pub(super) struct Fit<'a> {
    pub(super) model: &'a Model<'a>,
    /// One for each unknown.
    pub(super) knowledge: &'a [Knowledge],
    pub(super) loss: Loss,
    /// The standard deviation of a component, mm.
    pub(super) sigma: Option<f64>,
    pub(super) observer: &'a dyn Observer,
}

/// The end of a minimisation.
pub(super) struct Fitted {
    pub(super) state: State,
    pub(super) weighting: Weighting,
    pub(super) steps: usize,
}

impl Fit<'_> {
    /// Finds the least cost from a start.
    pub(super) fn run(&self, start: State) -> Result<Fitted, CalibrationError> {
        let components = self.model.measurements.observed.components();
        let weighting = |scale| Weighting { loss: self.loss, scale, components };
        match self.loss {
            Loss::Squares => self.minimise(start, weighting(self.sigma.unwrap_or(1.0))),
            Loss::Huber => self.robust(start, weighting),
        }
    }

    /// Shrinks the scale from that of the residuals at the start to `sigma`, or until the residuals shrink no more. At
    /// each scale the errors that are gross at that scale count linearly. Before the last scale, the start counts as a
    /// rough prior: with residuals of millimetres the weakest combinations could leave every real machine.
    fn robust(&self, start: State, weighting: impl Fn(f64) -> Weighting) -> Result<Fitted, CalibrationError> {
        let least = self.sigma.unwrap_or(ROUNDING * self.model.length);
        let components = self.model.measurements.observed.components();
        let spread_of = |state: &State| {
            let residuals = self.model.residuals(state);
            robust_scale(residuals.iter().map(Vector3::norm), components).max(least)
        };
        let (mut scale, mut steps, mut stale) = (spread_of(&start), 0, 0);
        let knowledge = self.with_rough_priors(&start);
        let rough = Fit { knowledge: &knowledge, ..*self };
        let (mut best, mut least_spread) = (start, scale);
        while scale > least && stale < STALE_SCALES {
            let fitted = match rough.minimise(best.clone(), weighting(scale)) {
                Ok(fitted) => fitted,
                // At a scale below that of the errors the cost has corners.
                Err(CalibrationError::NotConverged { .. }) => break,
                Err(other) => return Err(other),
            };
            let spread = spread_of(&fitted.state);
            stale = if spread < SETTLED * least_spread { 0 } else { stale + 1 };
            if spread < least_spread {
                (best, least_spread) = (fitted.state, spread);
            }
            steps += fitted.steps;
            scale = spread.min(0.5 * scale).max(least);
        }
        let last = self.minimise(best, weighting(self.sigma.unwrap_or(least_spread)))?;
        Ok(Fitted { steps: steps + last.steps, ..last })
    }

    /// What is known, and where nothing is, that the start is roughly right.
    fn with_rough_priors(&self, start: &State) -> Vec<Knowledge> {
        let deviation = ROUGH * self.model.length;
        let prior = |(unknown, known): (usize, &Knowledge)| {
            let rough = self.value(start, unknown).map(|value| [value, deviation]);
            Knowledge { prior: known.prior.or(rough), ..*known }
        };
        self.knowledge.iter().enumerate().map(prior).collect()
    }

    /// Finds the least cost from a state near the end of an earlier minimisation.
    pub(super) fn finished(&self, from: State, earlier: &Fitted) -> Result<Fitted, CalibrationError> {
        let last = self.minimise(from, earlier.weighting)?;
        Ok(Fitted { steps: earlier.steps + last.steps, ..last })
    }

    fn minimise(&self, start: State, weighting: Weighting) -> Result<Fitted, CalibrationError> {
        let mut state = start;
        let mut cost = self.cost(&state, &weighting);
        let (mut damping, mut growth) = (None, 2.0);
        for steps in 0..MOST_STEPS {
            if self.observer.cancelled() {
                return Err(CalibrationError::Cancelled);
            }
            let triangle = self.triangle(&state, &self.rates(&state)?, &weighting);
            let information = Self::information(&triangle, self.free(&state, &triangle), steps)?;
            let unit = information.greatest().powi(2);
            if information.decrement() <= self.tolerance(cost, &weighting) {
                return Ok(Fitted { state, weighting, steps });
            }
            let mut trial = damping.unwrap_or(FIRST_DAMPING * unit);
            loop {
                let step = self.within_bounds(&state, information.step(trial, self.model.unknowns.len()));
                let predicted = decrease(&triangle, &step);
                let next = self.model.moved(&state, &step);
                let next = next.map(|next| (self.cost(&next, &weighting), next));
                if let Some((lower, next)) = next.filter(|(next, _)| *next < cost && predicted > 0.0) {
                    let gain = (cost - lower) / predicted;
                    trial *= (1.0 - (2.0 * gain - 1.0).powi(3)).max(1.0 / 3.0);
                    (state, cost, damping, growth) = (next, lower, Some(trial), 2.0);
                    break;
                }
                // Nielsen 1999: the damping grows faster and faster.
                trial *= growth;
                growth *= 2.0;
                if trial.is_nan() || trial >= MOST_DAMPING * unit {
                    return self.stopped(state, cost, weighting, &information, steps);
                }
            }
        }
        let triangle = self.triangle(&state, &self.rates(&state)?, &weighting);
        let information = Self::information(&triangle, self.free(&state, &triangle), MOST_STEPS)?;
        Err(self.not_converged(&information, MOST_STEPS))
    }

    /// The end where no step decreases the cost: it has converged if the best one would change rounding alone.
    fn stopped(
        &self,
        state: State,
        cost: f64,
        weighting: Weighting,
        information: &Information,
        steps: usize,
    ) -> Result<Fitted, CalibrationError> {
        let rounding = 1e-12 * cost + 100.0 * self.tolerance(cost, &weighting);
        if information.decrement() <= rounding {
            return Ok(Fitted { state, weighting, steps });
        }
        Err(self.not_converged(information, steps))
    }

    /// What a factor tells about some unknowns.
    pub(super) fn information(
        triangle: &Triangle,
        unknowns: Vec<usize>,
        steps: usize,
    ) -> Result<Information, CalibrationError> {
        let undecided = || CalibrationError::NotConverged { steps, weakest: Vec::new() };
        Information::of(triangle, unknowns).ok_or_else(undecided)
    }

    fn not_converged(&self, information: &Information, steps: usize) -> CalibrationError {
        CalibrationError::NotConverged { steps, weakest: self.model.named(information.weakest()) }
    }

    /// The sum of squares that further steps may leave.
    #[allow(clippy::cast_precision_loss, reason = "a number of measurements")]
    fn tolerance(&self, cost: f64, weighting: &Weighting) -> f64 {
        let numbers = self.model.measurements.count() * weighting.components;
        let spare = numbers.saturating_sub(self.model.unknowns.len()).max(1) as f64;
        let known = if self.sigma.is_some() { 1.0 } else { 0.0 };
        let noise = (cost / spare).max(known);
        let rounding = ROUNDING * self.model.length / weighting.scale;
        ACCURACY * ACCURACY * noise + rounding * rounding
    }

    pub(super) fn rates(&self, state: &State) -> Result<Vec<TipRates>, CalibrationError> {
        let singular = || CalibrationError::OutOfMode { pose: self.singular_pose(state) };
        self.model.rates(state).ok_or_else(singular)
    }

    fn singular_pose(&self, state: &State) -> usize {
        let rho = &self.model.measurements.rho;
        let mut poses = state.poses.iter().zip(rho);
        poses.position(|(pose, rho)| state.machine.platform_rates(pose, *rho).is_none()).unwrap_or(0)
    }

    /// The triangular factor of measurements and prior knowledge, each in units of its standard deviation.
    pub(super) fn triangle(&self, state: &State, rates: &[TipRates], weighting: &Weighting) -> Triangle {
        let of_measurements = self
            .model
            .triangle(state, rates, |_, residual| weighting.weight(residual.norm()).sqrt() / weighting.scale);
        let count = self.model.unknowns.len();
        let priors: Vec<_> = self.priors(state).collect();
        let mut rows = DMatrix::zeros(priors.len().max(1), count + 1);
        for (row, (unknown, difference, deviation)) in priors.into_iter().enumerate() {
            rows[(row, unknown)] = 1.0 / deviation;
            rows[(row, count)] = difference / deviation;
        }
        of_measurements.and(&Triangle::of(rows))
    }

    /// Of each unknown with prior knowledge: its index, the difference from it and the standard deviation, mm.
    fn priors<'s>(&'s self, state: &'s State) -> impl Iterator<Item = (usize, f64, f64)> + 's {
        self.knowledge.iter().enumerate().filter_map(|(unknown, knowledge)| {
            let [value, deviation] = knowledge.prior?;
            Some((unknown, self.value(state, unknown)? - value, deviation))
        })
    }

    /// The value of an unknown parameter of the machine, mm.
    fn value(&self, state: &State, unknown: usize) -> Option<f64> {
        let unknown = self.model.unknowns[unknown];
        unknown.parameter().map(|parameter| state.machine.value(parameter) * self.model.scale(unknown))
    }

    fn cost(&self, state: &State, weighting: &Weighting) -> f64 {
        let residuals = self.model.residuals(state).into_iter();
        let of_measurements: f64 = residuals.map(|residual| weighting.cost(residual.norm())).sum();
        let of_priors: f64 =
            self.priors(state).map(|(_, difference, deviation)| (difference / deviation).powi(2)).sum();
        of_measurements + of_priors
    }

    /// The unknowns that the next step may change: not those at a bound beyond which the cost would decrease.
    fn free(&self, state: &State, triangle: &Triangle) -> Vec<usize> {
        let slopes = triangle.matrix().tr_mul(&triangle.residual());
        let is_free = |unknown: &usize| {
            let value = self.value(state, *unknown);
            let Some((value, [low, high])) = value.zip(self.knowledge[*unknown].bounds) else { return true };
            let rounding = ROUNDING * self.model.length;
            let [is_least, is_most] = [value <= low + rounding, value >= high - rounding];
            !(is_least && slopes[*unknown] > 0.0 || is_most && slopes[*unknown] < 0.0)
        };
        (0..self.model.unknowns.len()).filter(is_free).collect()
    }

    /// The unknowns that are not at a bound which keeps them from a lower cost.
    pub(super) fn unbounded(&self, fitted: &Fitted, triangle: &Triangle) -> Vec<usize> {
        self.free(&fitted.state, triangle)
    }

    fn within_bounds(&self, state: &State, mut step: Vec<f64>) -> Vec<f64> {
        for (unknown, step) in step.iter_mut().enumerate() {
            let value = self.value(state, unknown);
            if let Some((value, [low, high])) = value.zip(self.knowledge[unknown].bounds) {
                *step = (value + *step).clamp(low, high) - value;
            }
        }
        step
    }

    /// Whether all bounds hold.
    pub(super) fn is_within_bounds(&self, state: &State) -> bool {
        let holds = |unknown: usize| {
            let value = self.value(state, unknown).zip(self.knowledge[unknown].bounds);
            value.is_none_or(|(value, [low, high])| (low..=high).contains(&value))
        };
        (0..self.knowledge.len()).all(holds)
    }
}

/// By how much a step decreases the sum of squares if the residuals are linear.
fn decrease(triangle: &Triangle, step: &[f64]) -> f64 {
    let moved = triangle.matrix() * DVector::from_column_slice(step) + triangle.residual();
    triangle.residual().norm_squared() - moved.norm_squared()
}

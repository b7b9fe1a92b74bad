//! The measurements as functions of the unknowns: residuals and their derivatives.

use nalgebra::{DMatrix, Vector3};
use rayon::prelude::*;

use super::frame::{MeasurementFrame, mean, unit};
use super::measurements::{Measurements, Observed};
use super::triangle::Triangle;
use super::unknown::{Combination, Unknown};
use crate::parameter::{ActualMachine, PARAMETERS, Parameter, ParameterUnit};
use crate::pose::PlatformPose;

/// Measurements whose rows are put into a triangular factor at once.
const BLOCK: usize = 64;

/// The tool's end at a pose, and its derivatives by the machine's parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct TipRates {
    pub(super) tip: Vector3<f64>,
    pub(super) rates: [Vector3<f64>; PARAMETERS],
}

/// Values of all unknowns, and the postures that follow from them.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) machine: ActualMachine,
    pub(super) frame: MeasurementFrame,
    pub(super) centre: Vector3<f64>,
    pub(super) poses: Vec<PlatformPose>,
    /// The tool's end at each pose, in the frame of [`Measurements::tool_frame`].
    pub(super) tips: Vec<Vector3<f64>>,
}

/// The measurements with their unknowns.
#[derive(Clone, Debug)]
pub(super) struct Model<'a> {
    pub(super) measurements: &'a Measurements,
    pub(super) unknowns: Vec<Unknown>,
    /// Length that makes an angle a length, mm.
    pub(super) length: f64,
    /// The point about which the measuring device's frame turns.
    middle: Vector3<f64>,
}

impl<'a> Model<'a> {
    /// The model with these parameters as unknowns, and those that the kind of measurement adds.
    pub(super) fn new(
        measurements: &'a Measurements,
        parameters: &[Parameter],
        start: &State,
        length: f64,
    ) -> Self {
        let parameters = parameters.iter().map(|parameter| Unknown::Parameter(*parameter));
        let unknowns = parameters.chain(measurements.observed.placement().iter().copied()).collect();
        Self { measurements, unknowns, length, middle: mean(&start.tips) }
    }

    /// How many mm a unit of the unknown counts.
    pub(super) fn scale(&self, unknown: Unknown) -> f64 {
        match unknown.unit() {
            ParameterUnit::Millimetre => 1.0,
            ParameterUnit::Radian => self.length,
        }
    }

    /// A combination of unknowns by their indices, mm, as the unknowns with amounts in their units.
    pub(super) fn named(&self, combination: Vec<(usize, f64)>) -> Combination {
        let named = |(unknown, amount): (usize, f64)| {
            let unknown = self.unknowns[unknown];
            (unknown, amount / self.scale(unknown))
        };
        combination.into_iter().map(named).collect()
    }

    /// The state after a step of all unknowns, mm. `None` if the machine cannot exist, or cannot stand at a pose.
    pub(super) fn moved(&self, from: &State, step: &[f64]) -> Option<State> {
        let (mut turn, mut shift, mut centre) = (Vector3::zeros(), Vector3::zeros(), from.centre);
        let mut changes = Vec::new();
        for (unknown, step) in self.unknowns.iter().zip(step) {
            let step = step / self.scale(*unknown);
            match unknown {
                Unknown::Parameter(parameter) => changes.push((*parameter, step)),
                Unknown::FrameShift(axis) => shift += step * unit(*axis),
                Unknown::FrameTurn(axis) => turn += step * unit(*axis),
                Unknown::Centre(axis) => centre += step * unit(*axis),
            }
        }
        let machine = from.machine.with(changes);
        machine.machine().ok()?;
        let frame = from.frame.moved(&self.middle, turn, shift);
        let rho = &self.measurements.rho;
        let poses = from.poses.par_iter().zip(rho).with_min_len(BLOCK);
        let poses = poses.map(|(pose, rho)| machine.platform_near(pose, *rho)).collect::<Option<_>>()?;
        Some(State::standing(self.measurements, machine, poses, frame, centre))
    }

    /// The residual of a measurement: model less measured value. A length is its first component.
    pub(super) fn residual(&self, state: &State, measurement: usize) -> Vector3<f64> {
        let tip = state.tips.get(measurement);
        let length = |length: f64| Vector3::new(length, 0.0, 0.0);
        match (&self.measurements.observed, tip) {
            (Observed::Tips(tips), Some(tip)) => tip - Vector3::from(tips[measurement]),
            (Observed::TrackerTips(tips), Some(tip)) => {
                state.frame.point(tip) - Vector3::from(tips[measurement])
            }
            (Observed::PartTips(tips), Some(tip)) => tip - Vector3::from(tips[measurement].tip),
            (Observed::BallBar { lengths, .. }, Some(tip)) => {
                length((tip - state.centre).norm() - lengths[measurement])
            }
            (Observed::Distances(distances), _) => {
                let [from, to] = distances[measurement].poses.map(|pose| state.tips[pose]);
                length((to - from).norm() - distances[measurement].length)
            }
            (_, None) => Vector3::zeros(),
        }
    }

    /// The residuals of all measurements.
    pub(super) fn residuals(&self, state: &State) -> Vec<Vector3<f64>> {
        (0..self.measurements.count()).map(|measurement| self.residual(state, measurement)).collect()
    }

    /// The tool's ends with their derivatives. `None` at a parallel singularity.
    pub(super) fn rates(&self, state: &State) -> Option<Vec<TipRates>> {
        let poses = state.poses.par_iter().enumerate().with_min_len(BLOCK);
        poses.map(|(i, pose)| self.rates_at(state, i, pose)).collect()
    }

    fn rates_at(&self, state: &State, i: usize, pose: &PlatformPose) -> Option<TipRates> {
        let frame = self.measurements.tool_frame(i);
        let rates = state.machine.tool_rates(pose, self.measurements.rho[i], frame)?;
        Some(TipRates { tip: state.tips[i], rates: rates.tip.map(Vector3::from) })
    }

    /// The derivatives of a measurement by the unknowns, per mm: a row for each component.
    pub(super) fn rows(&self, state: &State, rates: &[TipRates], measurement: usize) -> DMatrix<f64> {
        match &self.measurements.observed {
            Observed::Distances(distances) => {
                self.distance_row(distances[measurement].poses.map(|pose| &rates[pose]))
            }
            _ => self.rows_at(state, &rates[measurement]),
        }
    }

    /// The derivatives of a measurement at one pose.
    pub(super) fn rows_at(&self, state: &State, at: &TipRates) -> DMatrix<f64> {
        let rate = |unknown: Unknown| match unknown {
            Unknown::Parameter(parameter) => at.rates[parameter.index()],
            Unknown::FrameShift(axis) | Unknown::Centre(axis) => -unit(axis),
            Unknown::FrameTurn(axis) => -unit(axis).cross(&(at.tip - self.middle)),
        };
        match &self.measurements.observed {
            Observed::TrackerTips(_) => self.vector_rows(|unknown| state.frame.direction(&rate(unknown))),
            Observed::Tips(_) | Observed::PartTips(_) => self.vector_rows(rate),
            Observed::Distances(_) | Observed::BallBar { .. } => {
                let direction = (at.tip - state.centre).try_normalize(0.0).unwrap_or_default();
                self.length_row(|unknown| direction.dot(&rate(unknown)))
            }
        }
    }

    /// The derivatives of the distance between the tool's ends of two poses.
    pub(super) fn distance_row(&self, [from, to]: [&TipRates; 2]) -> DMatrix<f64> {
        let direction = (to.tip - from.tip).try_normalize(0.0).unwrap_or_default();
        let rate = |parameter: Parameter| to.rates[parameter.index()] - from.rates[parameter.index()];
        self.length_row(|unknown| {
            unknown.parameter().map_or(0.0, |parameter| direction.dot(&rate(parameter)))
        })
    }

    fn vector_rows(&self, rate: impl Fn(Unknown) -> Vector3<f64>) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3, self.unknowns.len());
        for (column, unknown) in self.unknowns.iter().enumerate() {
            rows.set_column(column, &(rate(*unknown) / self.scale(*unknown)));
        }
        rows
    }

    fn length_row(&self, rate: impl Fn(Unknown) -> f64) -> DMatrix<f64> {
        let rates = self.unknowns.iter().map(|unknown| rate(*unknown) / self.scale(*unknown));
        DMatrix::from_row_iterator(1, self.unknowns.len(), rates)
    }

    /// The triangular factor of all rows and residuals, those of measurement i times `factor(i)`. The same on any
    /// number of threads.
    pub(super) fn triangle(
        &self,
        state: &State,
        rates: &[TipRates],
        factor: impl Fn(usize, &Vector3<f64>) -> f64 + Sync,
    ) -> Triangle {
        let (count, components) = (self.measurements.count(), self.measurements.observed.components());
        let columns = self.unknowns.len();
        let block = |first: usize| {
            let block = first..count.min(first + BLOCK);
            let mut rows = DMatrix::zeros(components * block.len(), columns + 1);
            for (i, measurement) in block.enumerate() {
                let residual = self.residual(state, measurement);
                let factor = factor(measurement, &residual);
                let mut of_one = rows.rows_mut(components * i, components);
                of_one.columns_mut(0, columns).copy_from(&(self.rows(state, rates, measurement) * factor));
                of_one.column_mut(columns).copy_from(&(residual.rows(0, components) * factor));
            }
            Triangle::of(rows)
        };
        let starts: Vec<usize> = (0..count).step_by(BLOCK).collect();
        let blocks: Vec<Triangle> = starts.into_par_iter().map(block).collect();
        let none = Triangle::of(DMatrix::zeros(1, columns + 1));
        blocks.iter().fold(none, Triangle::and)
    }
}

impl State {
    /// The state of a machine at poses.
    pub(super) fn standing(
        measurements: &Measurements,
        machine: ActualMachine,
        poses: Vec<PlatformPose>,
        frame: MeasurementFrame,
        centre: Vector3<f64>,
    ) -> Self {
        let tip = |(i, pose)| Vector3::from(machine.tool(pose, measurements.tool_frame(i)).tip);
        let tips = poses.iter().enumerate().map(tip).collect();
        Self { machine, frame, centre, poses, tips }
    }
}

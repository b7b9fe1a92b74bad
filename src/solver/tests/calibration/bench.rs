//! Poses, noise, and machines that deviate from their description.

use std::f64::consts::TAU;
use std::fmt;

use verne_solver::calibration::{
    Calibration, CalibrationError, CalibrationOptions, Measurements, Observed, Plan, calibrated, simulated,
};
use verne_solver::parameter::{ActualMachine, PARAMETERS, Parameter, ParameterUnit};
use verne_solver::workspace::Unobserved;
use verne_solver::{Machine, Margins, TableAngles, forward_working, tool_point};

use crate::random::Random;

/// Length of the tool, as a fraction of the machine's longest dimension.
pub(crate) const TOOL: f64 = 0.1;

/// Poses in most tests.
pub(crate) const POSES: usize = 40;

/// The kinds of measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Tips,
    Tracker,
    Part,
    Distances,
    BallBar,
    BallBarAnywhere,
}

impl Kind {
    pub(crate) const ALL: [Self; 6] =
        [Self::Tips, Self::Tracker, Self::Part, Self::Distances, Self::BallBar, Self::BallBarAnywhere];
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tips => "tips",
            Self::Tracker => "tracker",
            Self::Part => "part",
            Self::Distances => "distances",
            Self::BallBar => "ballbar, centre known",
            Self::BallBarAnywhere => "ballbar, centre unknown",
        })
    }
}

/// How often each parameter was identifiable, and how often within three standard deviations of its value.
#[derive(Default)]
pub(crate) struct Shares([[u32; 2]; PARAMETERS]);

impl Shares {
    /// Counts the parameters of a calibration.
    pub(crate) fn add(&mut self, found: &Calibration, actual: &ActualMachine) {
        for estimate in found.estimates.iter().filter(|estimate| estimate.identifiable) {
            let error = estimate.value - actual.value(estimate.parameter);
            let counts = &mut self.0[estimate.parameter.index()];
            counts[0] += 1;
            counts[1] += u32::from(error.abs() <= 3.0 * estimate.sigma.unwrap());
        }
    }

    /// The share of all.
    pub(crate) fn of_all(&self) -> f64 {
        let sum = |which: usize| self.0.iter().map(|counts| f64::from(counts[which])).sum::<f64>();
        sum(1) / sum(0)
    }

    /// The share of the parameter that was found least often.
    pub(crate) fn least(&self) -> f64 {
        let identified = self.0.iter().filter(|counts| counts[0] > 0);
        identified.map(|counts| f64::from(counts[1]) / f64::from(counts[0])).fold(1.0, f64::min)
    }
}

/// A normal random number of standard deviation one.
pub(crate) fn normal(random: &mut Random) -> f64 {
    (-2.0 * (1.0 - random.fraction()).ln()).sqrt() * (TAU * random.fraction()).cos()
}

/// Feasible positions of the sliders; fewer if the machine has hardly any.
pub(crate) fn poses(random: &mut Random, machine: &Machine, count: usize) -> Vec<[f64; 3]> {
    let stroke = machine.data().limits.stroke;
    let mut found = Vec::new();
    for _ in 0..20 * count {
        if found.len() == count {
            break;
        }
        let rho = stroke.map(|[low, high]| random.between(low, high));
        let posture = forward_working(machine, rho);
        if posture.is_ok_and(|posture| Margins::of(machine, &posture, None).feasible()) {
            found.push(rho);
        }
    }
    found
}

/// What is measured of a kind at these poses.
pub(crate) fn plan(random: &mut Random, machine: &Machine, kind: Kind, rho: &[[f64; 3]]) -> Plan {
    let limits = machine.data().limits;
    let [low, high] = limits.rotary.unwrap_or([-3.0, 3.0]);
    let count = rho.len();
    match kind {
        Kind::Tips => Plan::Tips,
        Kind::Tracker => Plan::TrackerTips,
        Kind::Part => {
            let table = |random: &mut Random| TableAngles {
                theta1: random.between(limits.tilt[0], limits.tilt[1]),
                theta2: random.between(low, high),
            };
            Plan::PartTips((0..count).map(|_| table(random)).collect())
        }
        Kind::Distances => Plan::Distances(
            (0..count).flat_map(|a| (1..4).map(move |step| [a, (a + step) % count])).collect(),
        ),
        Kind::BallBar => {
            let tool_length = TOOL * machine.longest();
            let [x, y, z] = tool_point(&forward_working(machine, rho[0]).unwrap().pose, tool_length);
            Plan::BallBar(Some([0.5 * x, 0.5 * y, z + 0.4 * machine.longest()]))
        }
        Kind::BallBarAnywhere => Plan::BallBar(None),
    }
}

/// The machine with changes of up to `most` mm of all parameters; of angles by as much at the machine's size.
pub(crate) fn deviating(random: &mut Random, machine: &Machine, most: f64) -> ActualMachine {
    let tool_length = TOOL * machine.longest();
    loop {
        let changes = Parameter::ALL.map(|parameter| {
            let unit = match parameter.unit() {
                ParameterUnit::Millimetre => 1.0,
                ParameterUnit::Radian => 1.0 / machine.longest(),
            };
            (parameter, unit * random.between(-most, most))
        });
        let actual = ActualMachine::new(machine, tool_length).with(changes);
        if actual.machine().is_ok() {
            return actual;
        }
    }
}

/// Measurements of a kind by a machine, without errors, at feasible poses.
pub(crate) fn measured(
    random: &mut Random,
    (nominal, actual): (&Machine, &ActualMachine),
    kind: Kind,
    count: usize,
) -> Measurements {
    let rho = poses(random, nominal, count);
    let plan = plan(random, nominal, kind, &rho);
    simulated(actual, rho, &plan).unwrap()
}

/// Adds normal errors to every number.
pub(crate) fn with_noise(random: &mut Random, sigma: f64, measurements: Measurements) -> Measurements {
    let mut noise = |number: &mut f64| *number += sigma * normal(random);
    let mut observed = measurements.observed;
    match &mut observed {
        Observed::Tips(tips) | Observed::TrackerTips(tips) => tips.iter_mut().flatten().for_each(&mut noise),
        Observed::PartTips(tips) => tips.iter_mut().for_each(|at| at.tip.iter_mut().for_each(&mut noise)),
        Observed::Distances(distances) => distances.iter_mut().for_each(|at| noise(&mut at.length)),
        Observed::BallBar { lengths, .. } => lengths.iter_mut().for_each(&mut noise),
    }
    Measurements { observed, ..measurements }
}

/// The calibration of the nominal machine.
pub(crate) fn calibration(
    nominal: &Machine,
    measurements: &Measurements,
    options: &CalibrationOptions,
) -> Result<Calibration, CalibrationError> {
    calibrated(nominal, TOOL * nominal.longest(), measurements, options, &Unobserved)
}

/// Options with a standard deviation.
pub(crate) fn with_sigma(sigma: f64) -> CalibrationOptions {
    CalibrationOptions { sigma: Some(sigma), ..CalibrationOptions::default() }
}

//! Measurements as a machine without errors of measurement would give them.

use nalgebra::Vector3;

use super::CalibrationError;
use super::ball::centre;
use super::measurements::{Measurements, Observed, PartTip, TipDistance};
use crate::parameter::{ActualMachine, ActualPoseError, ToolFrame};
use crate::pose::{Point, TableAngles};

/// What is to be measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Plan {
    /// The tool's end in the base frame, at each pose.
    Tips,
    /// The tool's end in a frame of the measuring device, at each pose.
    TrackerTips,
    /// The tool's end in the part frame, with the table at these angles, one entry for each pose.
    PartTips(Vec<TableAngles>),
    /// Distances between the tool's ends of these pairs of poses.
    Distances(Vec<[usize; 2]>),
    /// The distance of the tool's end from a ball, at each pose. Without a centre, which then is an unknown, the ball
    /// is at the point with the most equal distances from the tool's ends.
    BallBar(Option<Point>),
}

/// Computes what a machine would measure without errors. The calibration of the nominal machine with such measurements
/// of its own shows, before anything is measured, what the poses identify.
///
/// # Units
///
/// `rho` is what the control indicates, mm.
///
/// # Errors
///
/// [`CalibrationError::NoPosture`], [`CalibrationError::Inconsistent`]
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::calibration::{CalibrationError, Observed, Plan, simulated};
/// use verne_solver::parameter::ActualMachine;
///
/// let machine = ActualMachine::new(&Machine::verne(), 100.0);
/// let rho = vec![[600.0, 500.0, 500.0], [650.0, 480.0, 520.0]];
/// let Observed::Tips(tips) = simulated(&machine, rho, &Plan::Tips)?.observed else { panic!("tips") };
/// assert!((tips[0][2] - 1517.392).abs() < 1e-3);
/// # Ok::<(), CalibrationError>(())
/// ```
pub fn simulated(
    machine: &ActualMachine,
    rho: Vec<[f64; 3]>,
    plan: &Plan,
) -> Result<Measurements, CalibrationError> {
    let tip = |(pose, rho): (usize, &[f64; 3])| {
        let posture = machine.platform(*rho).map_err(|error| no_posture(pose, error))?;
        let table = match plan {
            Plan::PartTips(table) => table.get(pose),
            _ => None,
        };
        let frame = table.map_or(ToolFrame::Machine, |table| ToolFrame::Part(*table));
        Ok(machine.tool(&posture, frame).tip)
    };
    let tips = rho.iter().enumerate().map(tip).collect::<Result<Vec<_>, _>>()?;
    let observed = match plan {
        Plan::Tips => Observed::Tips(tips),
        Plan::TrackerTips => Observed::TrackerTips(tips),
        Plan::PartTips(table) => {
            let tips = table.iter().zip(tips);
            Observed::PartTips(tips.map(|(table, tip)| PartTip { table: *table, tip }).collect())
        }
        Plan::Distances(pairs) => Observed::Distances(distances(&tips, pairs)?),
        Plan::BallBar(known) => {
            let tips: Vec<_> = tips.into_iter().map(Vector3::from).collect();
            let at = known.map_or_else(|| centre(&tips, None), Vector3::from);
            Observed::BallBar { centre: *known, lengths: tips.iter().map(|tip| (tip - at).norm()).collect() }
        }
    };
    let measurements = Measurements { rho, observed };
    measurements.check()?;
    Ok(measurements)
}

/// Why a machine does not stand at a pose. Without changes a machine stands where the nominal one does.
pub(super) fn no_posture(pose: usize, error: ActualPoseError) -> CalibrationError {
    match error {
        ActualPoseError::Nominal(reason) => CalibrationError::NoPosture { pose, reason },
        ActualPoseError::TooFar => CalibrationError::OutOfMode { pose },
    }
}

fn distances(tips: &[Point], pairs: &[[usize; 2]]) -> Result<Vec<TipDistance>, CalibrationError> {
    let distance = |poses: &[usize; 2]| {
        let [from, to] = poses.map(|pose| tips.get(pose).copied().map(Vector3::from));
        let length = from.zip(to).map(|(from, to)| (to - from).norm());
        length.map(|length| TipDistance { poses: *poses, length })
    };
    let all: Option<Vec<_>> = pairs.iter().map(distance).collect();
    all.ok_or(CalibrationError::Inconsistent("a distance is not between two of the poses"))
}

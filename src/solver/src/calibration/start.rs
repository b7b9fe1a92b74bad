//! The state at which a calibration starts.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::CalibrationError;
use super::ball::centre;
use super::frame::MeasurementFrame;
use super::measurements::{Measurements, Observed};
use super::model::State;
use super::simulation::no_posture;
use crate::machine::Machine;
use crate::parameter::ActualMachine;

/// The machine as it is described, with the measuring device where the measurements put it.
pub(super) fn start(
    machine: &Machine,
    tool_length: f64,
    measurements: &Measurements,
) -> Result<State, CalibrationError> {
    let machine = ActualMachine::new(machine, tool_length);
    let standing =
        |(pose, rho): (usize, &[f64; 3])| machine.platform(*rho).map_err(|error| no_posture(pose, error));
    let poses: Result<Vec<_>, _> = measurements.rho.par_iter().enumerate().map(standing).collect();
    let (base, origin) = (MeasurementFrame::base(), Vector3::zeros());
    let mut state = State::standing(measurements, machine, poses?, base, origin);
    match &measurements.observed {
        Observed::TrackerTips(tips) => {
            let tips: Vec<_> = tips.iter().map(|tip| Vector3::from(*tip)).collect();
            state.frame = MeasurementFrame::aligned(&tips, &state.tips);
        }
        Observed::BallBar { centre: Some(centre), .. } => state.centre = Vector3::from(*centre),
        Observed::BallBar { centre: None, lengths } => state.centre = centre(&state.tips, Some(lengths)),
        _ => {}
    }
    Ok(state)
}

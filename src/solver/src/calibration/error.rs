//! The reasons why a calibration has no answer.

use std::fmt;

use super::Combination;
use crate::error::KinematicsError;

/// The reason why a calibration has no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum CalibrationError {
    /// The lists of the measurements do not fit together.
    Inconsistent(&'static str),
    /// The machine at the start has no posture in the working mode at a pose.
    NoPosture {
        /// The pose, from 0.
        pose: usize,
        /// The reason.
        reason: KinematicsError,
    },
    /// The least squares end in a machine that is outside the working mode, or at a parallel singularity, at a pose.
    OutOfMode {
        /// The pose, from 0.
        pose: usize,
    },
    /// The least squares did not converge.
    NotConverged {
        /// The number of steps.
        steps: usize,
        /// The combination of unknowns that the measurements determine least.
        weakest: Combination,
    },
    /// The observer stopped the computation.
    Cancelled,
}

impl fmt::Display for CalibrationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Inconsistent(detail) => write!(f, "{detail}"),
            Self::NoPosture { pose, reason } => {
                write!(f, "the machine at the start cannot stand at pose {pose}: {reason}")
            }
            Self::OutOfMode { pose } => {
                write!(f, "the machine that fits best does not stand in the working mode at pose {pose}")
            }
            Self::NotConverged { steps, weakest } => {
                write!(f, "the least squares did not converge in {steps} steps; least determined are")?;
                weakest.iter().try_for_each(|(unknown, _)| write!(f, " {}", unknown.name()))
            }
            Self::Cancelled => write!(f, "the computation was cancelled"),
        }
    }
}

impl std::error::Error for CalibrationError {}

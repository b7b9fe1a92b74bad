//! The reasons why an actual machine has no posture at given joints.

use std::fmt;

use crate::error::KinematicsError;

/// The reason why no posture of an actual machine was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ActualPoseError {
    /// The nominal machine has no posture in the working mode at these joints.
    Nominal(KinematicsError),
    /// Newton's method from the nominal posture finds none on the same side of the parallel singularity: the changes
    /// are too large, or the posture is too near to the singularity.
    TooFar,
}

impl fmt::Display for ActualPoseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nominal(error) => error.fmt(f),
            Self::TooFar => write!(f, "with the changed parameters no posture is near the nominal one"),
        }
    }
}

impl std::error::Error for ActualPoseError {}

impl From<KinematicsError> for ActualPoseError {
    fn from(error: KinematicsError) -> Self {
        Self::Nominal(error)
    }
}

//! The reasons why a request has no solution.

use std::fmt;

use crate::limit::Margin;

/// The reason why a request has no posture as its solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KinematicsError {
    /// A number is not finite or beyond [`MAX_INPUT`](crate::MAX_INPUT).
    OutOfDomain,
    /// A length is more than [`MAX_LENGTH_RATIO`](crate::MAX_LENGTH_RATIO) times
    /// [`Machine::longest`](crate::Machine::longest).
    OutOfProportion,
    /// No posture exists. The margin names the constraint that prevents it; its value is negative.
    Unreachable(Margin),
    /// The platform can move with all sliders locked.
    SelfMotion,
}

impl fmt::Display for KinematicsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfDomain => write!(f, "a number is not finite or too large"),
            Self::OutOfProportion => write!(f, "a length is out of proportion to the machine"),
            Self::Unreachable(Margin { constraint, value, .. }) => {
                write!(f, "no posture exists: the margin of {constraint:?} is {value}")
            }
            Self::SelfMotion => write!(f, "the platform can move with all sliders locked"),
        }
    }
}

impl std::error::Error for KinematicsError {}

//! What a calibration determines: parameters of the machine, and the place of the measuring device.

use crate::parameter::{Parameter, ParameterUnit};

/// An axis of the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameAxis {
    /// x.
    X,
    /// y.
    Y,
    /// z.
    Z,
}

/// A number that a calibration determines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// A parameter of the machine.
    Parameter(Parameter),
    /// Shift of the measuring device's frame along an axis of the base frame.
    FrameShift(FrameAxis),
    /// Rotation of the measuring device's frame about the direction of an axis of the base frame, through the mean of
    /// the measured points.
    FrameTurn(FrameAxis),
    /// A coordinate of the ball's centre in the base frame.
    Centre(FrameAxis),
}

/// A combination of unknowns, each with an amount, mm or rad. If measurements do not determine it, they stay the same
/// to the first order when each of its unknowns changes by its amount, times any common factor.
pub type Combination = Vec<(Unknown, f64)>;

impl Unknown {
    /// The frame of a measuring device.
    pub(super) const FRAME: [Self; 6] = [
        Self::FrameShift(FrameAxis::X),
        Self::FrameShift(FrameAxis::Y),
        Self::FrameShift(FrameAxis::Z),
        Self::FrameTurn(FrameAxis::X),
        Self::FrameTurn(FrameAxis::Y),
        Self::FrameTurn(FrameAxis::Z),
    ];

    /// The ball's centre.
    pub(super) const CENTRE: [Self; 3] =
        [Self::Centre(FrameAxis::X), Self::Centre(FrameAxis::Y), Self::Centre(FrameAxis::Z)];

    /// The name, as answers use it.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::calibration::{FrameAxis, Unknown};
    /// use verne_solver::parameter::Parameter;
    ///
    /// assert_eq!(Unknown::Parameter(Parameter::L2).name(), "L2");
    /// assert_eq!(Unknown::FrameTurn(FrameAxis::Z).name(), "frame.c");
    /// ```
    pub const fn name(self) -> &'static str {
        use FrameAxis::{X, Y, Z};
        match self {
            Self::Parameter(parameter) => parameter.name(),
            Self::FrameShift(X) => "frame.x",
            Self::FrameShift(Y) => "frame.y",
            Self::FrameShift(Z) => "frame.z",
            Self::FrameTurn(X) => "frame.a",
            Self::FrameTurn(Y) => "frame.b",
            Self::FrameTurn(Z) => "frame.c",
            Self::Centre(X) => "centre.x",
            Self::Centre(Y) => "centre.y",
            Self::Centre(Z) => "centre.z",
        }
    }

    /// The unit.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::calibration::{FrameAxis, Unknown};
    /// use verne_solver::parameter::ParameterUnit;
    ///
    /// assert_eq!(Unknown::FrameTurn(FrameAxis::X).unit(), ParameterUnit::Radian);
    /// ```
    pub const fn unit(self) -> ParameterUnit {
        match self {
            Self::Parameter(parameter) => parameter.unit(),
            Self::FrameShift(_) | Self::Centre(_) => ParameterUnit::Millimetre,
            Self::FrameTurn(_) => ParameterUnit::Radian,
        }
    }

    /// The parameter, if it is one.
    pub(super) const fn parameter(self) -> Option<Parameter> {
        match self {
            Self::Parameter(parameter) => Some(parameter),
            _ => None,
        }
    }
}

//! The parameters of a machine that manufacture and set-up leave uncertain, and what they do to the tool.
//!
#![doc = include_str!("parameter/parameters.md")]

mod actual_machine;
mod error;
mod rates;
mod table_axes;
mod tool;

pub use actual_machine::ActualMachine;
pub use error::ActualPoseError;
pub use rates::{PlatformRates, ToolRates};
pub use tool::{Tool, ToolFrame};

/// The number of parameters.
pub const PARAMETERS: usize = 23;

/// The number of parameters that matter in the machine's frame. They stand first in [`Parameter::ALL`].
pub const MACHINE_FRAME_PARAMETERS: usize = 13;

/// A parameter of the machine's geometry, of its zero positions, or of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(non_camel_case_types, reason = "the paper's symbols: R1 and r1 are two dimensions")]
pub enum Parameter {
    /// e1 = D1 - d1: x from leg I's guideway to its joints on the platform, with P on the z axis.
    e1,
    /// e2 = D2 - d2: the same of legs II and III.
    e2,
    /// Half-distance of leg I's joints on the platform.
    R1,
    /// Half-distance of leg I's joints on the slider.
    r1,
    /// Half-distance of legs II and III on the platform.
    R2,
    /// Half-distance of legs II and III's guideways.
    r4,
    /// Length of both rods of leg I.
    L1,
    /// Length of both rods of leg II.
    L2,
    /// Length of both rods of leg III.
    L3,
    /// Zero offset of slider 1: its z less rho1, the position that the control indicates.
    o1,
    /// Zero offset of slider 2.
    o2,
    /// Zero offset of slider 3.
    o3,
    /// Length of the tool from P.
    ToolLength,
    /// z of the tilting axis in the base frame.
    da,
    /// z of the table's origin in the frame of the tilting axis.
    dt,
    /// y of the tilting axis in the base frame.
    TiltAxisY,
    /// Rotation of the tilting axis about y of the base frame.
    TiltAxisB,
    /// Rotation of the tilting axis about z of the base frame.
    TiltAxisC,
    /// Zero offset of the tilting axis: its angle less theta1.
    TiltZero,
    /// x of the rotary axis in the frame of the tilting axis.
    RotaryAxisX,
    /// y of the rotary axis in the frame of the tilting axis.
    RotaryAxisY,
    /// Rotation of the rotary axis about y of the frame of the tilting axis.
    RotaryAxisB,
    /// Zero offset of the rotary axis: its angle less theta2.
    RotaryZero,
}

/// The unit of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterUnit {
    /// A length, mm.
    Millimetre,
    /// An angle, rad.
    Radian,
}

impl Parameter {
    /// All parameters. The place of a parameter in this list is its index in rates and changes.
    pub const ALL: [Self; PARAMETERS] = [
        Self::e1,
        Self::e2,
        Self::R1,
        Self::r1,
        Self::R2,
        Self::r4,
        Self::L1,
        Self::L2,
        Self::L3,
        Self::o1,
        Self::o2,
        Self::o3,
        Self::ToolLength,
        Self::da,
        Self::dt,
        Self::TiltAxisY,
        Self::TiltAxisB,
        Self::TiltAxisC,
        Self::TiltZero,
        Self::RotaryAxisX,
        Self::RotaryAxisY,
        Self::RotaryAxisB,
        Self::RotaryZero,
    ];

    /// The place in [`ALL`](Self::ALL).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::Parameter;
    ///
    /// assert_eq!(Parameter::ALL[Parameter::L2.index()], Parameter::L2);
    /// ```
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The name, as requests use it.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::Parameter;
    ///
    /// assert_eq!(Parameter::ToolLength.name(), "tool_length");
    /// ```
    pub const fn name(self) -> &'static str {
        match self {
            Self::e1 => "e1",
            Self::e2 => "e2",
            Self::R1 => "R1",
            Self::r1 => "r1",
            Self::R2 => "R2",
            Self::r4 => "r4",
            Self::L1 => "L1",
            Self::L2 => "L2",
            Self::L3 => "L3",
            Self::o1 => "o1",
            Self::o2 => "o2",
            Self::o3 => "o3",
            Self::ToolLength => "tool_length",
            Self::da => "da",
            Self::dt => "dt",
            Self::TiltAxisY => "tilt_axis_y",
            Self::TiltAxisB => "tilt_axis_b",
            Self::TiltAxisC => "tilt_axis_c",
            Self::TiltZero => "tilt_zero",
            Self::RotaryAxisX => "rotary_axis_x",
            Self::RotaryAxisY => "rotary_axis_y",
            Self::RotaryAxisB => "rotary_axis_b",
            Self::RotaryZero => "rotary_zero",
        }
    }

    /// The parameter of a name.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::Parameter;
    ///
    /// assert_eq!(Parameter::named("r1"), Some(Parameter::r1));
    /// assert_eq!(Parameter::named("D1"), None, "D1 and d1 matter by their difference e1 alone");
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }

    /// The unit.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::{Parameter, ParameterUnit};
    ///
    /// assert_eq!(Parameter::RotaryZero.unit(), ParameterUnit::Radian);
    /// ```
    pub const fn unit(self) -> ParameterUnit {
        match self {
            Self::TiltAxisB | Self::TiltAxisC | Self::TiltZero | Self::RotaryAxisB | Self::RotaryZero => {
                ParameterUnit::Radian
            }
            _ => ParameterUnit::Millimetre,
        }
    }

    /// Whether the parameter matters in the machine's frame, where the table does not.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::{MACHINE_FRAME_PARAMETERS, Parameter};
    ///
    /// let matter = Parameter::ALL.into_iter().filter(|parameter| parameter.is_of_machine_frame());
    /// assert_eq!(matter.count(), MACHINE_FRAME_PARAMETERS);
    /// ```
    pub const fn is_of_machine_frame(self) -> bool {
        self.index() < MACHINE_FRAME_PARAMETERS
    }
}

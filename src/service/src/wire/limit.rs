//! Names of constraints, their units, and the parts of the machine they belong to.

use std::fmt;

use serde::{Serialize, Serializer};
use utoipa::ToSchema;
use verne_solver::workspace::Binding;
use verne_solver::{Constraint, Element, Margin};

use crate::wire::degrees::to_degrees;

/// A constraint of the workspace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Constraint)]
pub(crate) enum ConstraintName {
    /// A slider within its stroke, mm.
    Stroke,
    /// A leg long enough to reach, mm.
    LegLength,
    /// A rod inclined enough to its guideway, cosine.
    SerialSingularity,
    /// The parallel conditioning.
    ParallelSingularity,
    /// A rod within its cone at the slider, degrees.
    SliderJoint,
    /// A rod within its cone at the platform, degrees.
    PlatformJoint,
    /// The rods of leg I uncrossed, mm.
    RodCrossing,
    /// Distance between rods, mm.
    RodInterference,
    /// theta1 within its range, degrees.
    Tilt,
    /// theta2 within its range, degrees.
    Rotary,
    /// Height of the tool's end and of the platform's joints over the table, mm.
    TableClearance,
}

/// Unit of a margin: mm, degrees, or 1 for a dimensionless number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
pub(crate) enum Unit {
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Degrees.
    #[serde(rename = "deg")]
    Degree,
    /// A pure number.
    #[serde(rename = "1")]
    One,
}

/// A constraint's margin: positive inside, zero on the limit, negative outside.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Limit {
    /// The constraint.
    pub constraint: ConstraintName,
    /// Distance from the limit.
    pub value: f64,
    /// Unit of `value`.
    pub unit: Unit,
    /// The part of the machine: `slider1.min`, `slider1.max`, `leg1`, `rod11`, `rods11-31`, `theta1.min`, `theta2.max`,
    /// `platform`, `tool` (its end) or `joint11` (at the platform).
    #[schema(value_type = String, example = "slider2.max")]
    pub element: ElementName,
}

/// Condition that no margin covers: `table`, whether the tool and the platform stay above the table; `part`, collisions
/// with the part; `fixtures`, collisions with the fixtures of the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Unchecked {
    /// Whether tool and platform stay above the table.
    Table,
    /// Collisions with the part.
    Part,
    /// Collisions with the fixtures of the part.
    Fixtures,
}

impl Unchecked {
    /// What is not checked of an answer, by whether the table was.
    pub(crate) fn beside(table_checked: bool) -> &'static [Self] {
        if table_checked { &[Self::Part, Self::Fixtures] } else { &[Self::Table, Self::Part, Self::Fixtures] }
    }
}

impl From<Constraint> for ConstraintName {
    fn from(constraint: Constraint) -> Self {
        match constraint {
            Constraint::Stroke => Self::Stroke,
            Constraint::LegLength => Self::LegLength,
            Constraint::SerialSingularity => Self::SerialSingularity,
            Constraint::ParallelSingularity => Self::ParallelSingularity,
            Constraint::SliderJoint => Self::SliderJoint,
            Constraint::PlatformJoint => Self::PlatformJoint,
            Constraint::RodCrossing => Self::RodCrossing,
            Constraint::RodInterference => Self::RodInterference,
            Constraint::Tilt => Self::Tilt,
            Constraint::Rotary => Self::Rotary,
            Constraint::TableClearance => Self::TableClearance,
        }
    }
}

impl fmt::Display for ConstraintName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stroke => "stroke",
            Self::LegLength => "leg_length",
            Self::SerialSingularity => "serial_singularity",
            Self::ParallelSingularity => "parallel_singularity",
            Self::SliderJoint => "slider_joint",
            Self::PlatformJoint => "platform_joint",
            Self::RodCrossing => "rod_crossing",
            Self::RodInterference => "rod_interference",
            Self::Tilt => "tilt",
            Self::Rotary => "rotary",
            Self::TableClearance => "table_clearance",
        })
    }
}

impl ConstraintName {
    /// The unit of its margins.
    pub(crate) fn unit(self) -> Unit {
        match self {
            Self::Stroke
            | Self::LegLength
            | Self::RodCrossing
            | Self::RodInterference
            | Self::TableClearance => Unit::Millimetre,
            Self::SliderJoint | Self::PlatformJoint | Self::Tilt | Self::Rotary => Unit::Degree,
            Self::SerialSingularity | Self::ParallelSingularity => Unit::One,
        }
    }
}

impl From<Margin> for Limit {
    fn from(margin: Margin) -> Self {
        let constraint = ConstraintName::from(margin.constraint);
        let unit = constraint.unit();
        let value = if unit == Unit::Degree { to_degrees(margin.value) } else { margin.value + 0.0 };
        Self { constraint, value, unit, element: margin.into() }
    }
}

/// The part of the machine that a margin belongs to; written as its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementName {
    constraint: Constraint,
    element: Element,
}

impl From<Margin> for ElementName {
    fn from(margin: Margin) -> Self {
        Self { constraint: margin.constraint, element: margin.element }
    }
}

impl From<Binding> for ElementName {
    fn from(binding: Binding) -> Self {
        Self { constraint: binding.constraint, element: binding.element }
    }
}

impl Serialize for ElementName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl fmt::Display for ElementName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = |high| if high { "max" } else { "min" };
        match self.element {
            Element::Stroke { slider, high } => write!(f, "slider{slider}.{}", end(high)),
            Element::Leg(leg) => write!(f, "leg{leg}"),
            Element::Rod(rod) => write!(f, "rod{rod}"),
            Element::Rods(one, other) => write!(f, "rods{one}-{other}"),
            Element::Range { high } => {
                let angle = if self.constraint == Constraint::Rotary { "theta2" } else { "theta1" };
                write!(f, "{angle}.{}", end(high))
            }
            Element::Platform => f.write_str("platform"),
            Element::Tool => f.write_str("tool"),
            Element::Joint(rod) => write!(f, "joint{rod}"),
        }
    }
}

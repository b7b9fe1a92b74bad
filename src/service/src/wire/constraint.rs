//! Names and units of the constraints, and names of the parts of the machine that they belong to.

use std::borrow::Cow;
use std::fmt;

use serde::{Serialize, Serializer};
use utoipa::openapi::schema::{ObjectBuilder, Type};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};
use verne_solver::workspace::Binding;
use verne_solver::{Constraint, Element, Margin};

/// The name of a constraint and the unit of its margins.
const fn name_and_unit(constraint: Constraint) -> (&'static str, Unit) {
    match constraint {
        Constraint::Stroke => ("stroke", Unit::Millimetre),
        Constraint::LegLength => ("leg_length", Unit::Millimetre),
        Constraint::SerialSingularity => ("serial_singularity", Unit::One),
        Constraint::ParallelSingularity => ("parallel_singularity", Unit::One),
        Constraint::SliderJoint => ("slider_joint", Unit::Degree),
        Constraint::PlatformJoint => ("platform_joint", Unit::Degree),
        Constraint::RodCrossing => ("rod_crossing", Unit::Millimetre),
        Constraint::RodInterference => ("rod_interference", Unit::Millimetre),
        Constraint::Tilt => ("tilt", Unit::Degree),
        Constraint::Rotary => ("rotary", Unit::Degree),
        Constraint::TableClearance => ("table_clearance", Unit::Millimetre),
    }
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

impl Unit {
    /// All of them, in the order of their values.
    pub(crate) const ALL: [Self; 3] = [Self::Millimetre, Self::Degree, Self::One];

    /// The name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Degree => "deg",
            Self::One => "1",
        }
    }
}

/// A constraint, written as its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ConstraintName(pub Constraint);

impl ConstraintName {
    /// The unit of its margins.
    pub(crate) fn unit(self) -> Unit {
        name_and_unit(self.0).1
    }
}

impl fmt::Display for ConstraintName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(name_and_unit(self.0).0)
    }
}

impl ConstraintName {
    /// The names of all constraints, in the order of [`code`](Self::code).
    pub(crate) fn all() -> Vec<String> {
        Constraint::ALL.iter().map(|constraint| Self(*constraint).to_string()).collect()
    }

    /// The position among all constraints.
    pub(crate) fn code(self) -> usize {
        self.0 as usize
    }
}

impl Serialize for ConstraintName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(name_and_unit(self.0).0)
    }
}

impl PartialSchema for ConstraintName {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new()
            .schema_type(Type::String)
            .description(Some("A constraint of the workspace."))
            .enum_values(Some(Constraint::ALL.map(|constraint| name_and_unit(constraint).0)))
            .into()
    }
}

impl ToSchema for ConstraintName {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("Constraint")
    }
}

/// The part of the machine that a margin belongs to, written as its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementName {
    pub(super) constraint: Constraint,
    pub(super) element: Element,
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

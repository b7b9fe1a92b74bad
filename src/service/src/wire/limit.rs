//! Margins with their constraints as JSON, and the conditions that no margin covers.

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::Margin;

use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::degrees::to_degrees;

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

impl From<Margin> for Limit {
    fn from(margin: Margin) -> Self {
        let constraint = ConstraintName(margin.constraint);
        let unit = constraint.unit();
        let value = if unit == Unit::Degree { to_degrees(margin.value) } else { margin.value + 0.0 };
        Self { constraint, value, unit, element: margin.into() }
    }
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
    /// The conditions that an answer does not cover, with or without a check of the table.
    pub(crate) fn beside(table_checked: bool) -> &'static [Self] {
        if table_checked { &[Self::Part, Self::Fixtures] } else { &[Self::Table, Self::Part, Self::Fixtures] }
    }
}

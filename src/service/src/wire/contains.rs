//! `/workspace/contains`: many points in, columns out.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

use super::answer::MachineId;
use super::batch::RowError;
use super::capped::Capped;
use super::limit::{ConstraintName, ElementName, Unchecked, Unit};
use super::machine_ref::MachineRef;
use super::workspace::KindName;

/// Which of these points belong to the workspace?
///
/// Points stay text here and are read one by one: a bad one then spoils no other.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContainsRequest<'a> {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Whose positions the points are.
    #[serde(default)]
    pub kind: KindName,
    /// Distance from P to the tool's tip, mm; without effect on `platform`.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm; only kind `part` has it. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Inclination of the tool in the table frame, degrees; only `part` depends on it.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi1: f64,
    /// Azimuth of the tool in the table frame, degrees; only `part` depends on it.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
    /// Points `[x, y, z]` in the kind's frame, mm. One that cannot be read is answered with null.
    #[serde(borrow)]
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub points: Capped<&'a RawValue>,
}

/// How each point stands to the workspace: columns in the order of the points.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct ContainsAnswer {
    /// The machine.
    pub machine: MachineId,
    /// Whether the working mode reaches the point and keeps every limit; null for a point that cannot be read.
    pub inside: Vec<Option<bool>>,
    /// The worst margin in its constraint's unit: at least zero inside; null where the solver has none to give.
    pub margin: Vec<Option<f64>>,
    /// Unit of the margin.
    pub unit: Vec<Option<Unit>>,
    /// The constraint that it belongs to.
    pub constraint: Vec<Option<ConstraintName>>,
    /// The part of the machine that it belongs to, such as `slider2.max`.
    #[schema(value_type = Vec<Option<String>>)]
    pub element: Vec<Option<ElementName>>,
    /// How many points there are of each sort.
    pub counts: ContainsCounts,
    /// What was not checked.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// What is wrong with the points that cannot be read: the first hundred.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<RowError>,
}

/// How many points there are of each sort.
#[derive(Clone, Copy, Debug, Default, Serialize, ToSchema)]
pub(crate) struct ContainsCounts {
    /// In the workspace.
    pub inside: usize,
    /// Not in it.
    pub outside: usize,
    /// Cannot be read.
    pub invalid: usize,
}

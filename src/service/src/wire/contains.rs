//! `/workspace/contains`: many points in, columns out.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::batch::RowError;
use crate::wire::bounded_list::BoundedList;
use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::sweep::Sweep;
use crate::wire::workspace::{KindName, WorkspaceRequest};

/// A tolerance that every machine accepts, mm. Membership does not depend on it.
pub(crate) const ANY_TOLERANCE: f64 = 1000.0;

/// Points to test against a workspace.
///
/// The service reads the points one by one, so a malformed point does not affect the others.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContainsRequest<'a> {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Point and frame of the positions.
    #[serde(default)]
    pub kind: KindName,
    /// Distance from P to the tool end, mm. Kind `platform` ignores it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only kind `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Inclination of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi1: f64,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
    /// Points `[x, y, z]` in the frame of the kind, mm. The answer has null for a malformed point.
    #[serde(borrow)]
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub points: BoundedList<&'a RawValue>,
}

impl ContainsRequest<'_> {
    /// The request for the workspace.
    pub(crate) fn workspace(&self) -> WorkspaceRequest {
        WorkspaceRequest {
            machine: self.machine.clone(),
            kind: self.kind,
            tool_length: Sweep::One(self.tool_length),
            table_clearance: self.table_clearance,
            tool_radius: self.tool_radius,
            phi1: Sweep::One(self.phi1),
            phi2: Sweep::One(self.phi2),
            tolerance: ANY_TOLERANCE,
        }
    }
}

/// Position of each point relative to the workspace, as columns in the order of the points.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct ContainsAnswer {
    /// The machine.
    pub machine: MachineId,
    /// Whether the working mode reaches the point and keeps every limit; null for a malformed point.
    pub inside: Vec<Option<bool>>,
    /// The worst margin in the unit of its constraint, at least zero inside; null if the solver finds no margin.
    pub margin: Vec<Option<f64>>,
    /// Unit of the margin.
    pub unit: Vec<Option<Unit>>,
    /// The constraint of this margin.
    pub constraint: Vec<Option<ConstraintName>>,
    /// The part of the machine with this margin, such as `slider2.max`.
    #[schema(value_type = Vec<Option<String>>)]
    pub element: Vec<Option<ElementName>>,
    /// Number of points of each kind.
    pub counts: ContainsCounts,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Errors of the malformed points, for the first hundred of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<RowError>,
}

/// Number of points of each kind.
#[derive(Clone, Copy, Debug, Default, Serialize, ToSchema)]
pub(crate) struct ContainsCounts {
    /// Inside the workspace.
    pub inside: usize,
    /// Outside the workspace.
    pub outside: usize,
    /// Malformed.
    pub invalid: usize,
}

//! The request for a workspace or a family of workspaces: as a client sends it, and with its default values.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::workspace::{Kind, Request};

use crate::wire::degrees::from_degrees_of_turn;
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::sweep::Sweep;

/// A request for a workspace. With lists it is a request for a family: one workspace for each combination of the
/// values.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WorkspaceRequest {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Point and frame of the positions.
    #[serde(default)]
    pub kind: KindName,
    /// Distance from P to the tool end, mm, from 0 to 1e7. Kind `platform` ignores it.
    #[serde(default)]
    pub tool_length: Sweep,
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
    pub phi1: Sweep,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    pub phi2: Sweep,
    /// Greatest distance between the mesh and the true surface, in both directions, mm. It must be at least a millionth
    /// of the machine's longest dimension.
    #[serde(default = "default_tolerance")]
    #[schema(minimum = 0.01, maximum = 1000, default = 1.0)]
    pub tolerance: f64,
}

impl WorkspaceRequest {
    /// Whether the request is for a family: a parameter has a list or steps.
    pub(crate) fn is_family(&self) -> bool {
        [&self.tool_length, &self.phi1, &self.phi2].iter().any(|sweep| !matches!(sweep, Sweep::One(_)))
    }
}

/// Tolerance of a request that has none, mm.
pub(crate) fn default_tolerance() -> f64 {
    1.0
}

/// Point and frame of a workspace's positions: `platform` (default), the platform's point P in the base frame; `tool`,
/// the tool end in the base frame; `part`, the tool end in the part frame, for a fixed orientation of the tool in that
/// frame (with phi1 = phi2 = 0 it is the manufacturing workspace of the paper).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = WorkspaceKind)]
pub(crate) enum KindName {
    /// The platform's point P in the base frame.
    #[default]
    Platform,
    /// The tool end in the base frame.
    Tool,
    /// The tool end in the part frame, for a fixed orientation.
    Part,
}

impl KindName {
    /// The name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Platform => "platform",
            Self::Tool => "tool",
            Self::Part => "part",
        }
    }

    /// The reason why theta1 is unknown, if it is.
    pub(crate) fn without_tilt(self) -> Option<&'static str> {
        (self != Self::Part).then_some("is allowed only for kind part")
    }

    /// The frame of its positions.
    pub(crate) fn frame(self) -> FrameName {
        match self {
            Self::Platform | Self::Tool => FrameName::Base,
            Self::Part => FrameName::Part,
        }
    }
}

/// Frame: `base`, the base frame with z down; `part`, the part frame with z up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = WorkspaceFrame)]
pub(crate) enum FrameName {
    /// z points down.
    Base,
    /// z points up from the table.
    Part,
}

/// The request with its default values, without the fields that have no effect.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalRequest)]
pub(crate) struct CanonicalWorkspace {
    /// Point and frame of the positions.
    pub kind: KindName,
    /// Distance from P to the tool end, mm. Only kinds `tool` and `part` have it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_length: Option<f64>,
    /// Table clearance, mm. Only kind `part` with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub table_clearance: Option<f64>,
    /// Tool radius, mm. Only kind `part` with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_radius: Option<f64>,
    /// Inclination of the tool, degrees. Only kind `part` has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub phi1: Option<f64>,
    /// Azimuth of the tool, degrees. Only kind `part` has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub phi2: Option<f64>,
    /// Tolerance, mm.
    pub tolerance: f64,
}

impl CanonicalWorkspace {
    /// The conditions that the answer does not cover.
    pub(crate) fn not_checked(&self) -> &'static [Unchecked] {
        Unchecked::beside(self.table_clearance.is_some())
    }
}

impl From<&CanonicalWorkspace> for Request {
    fn from(request: &CanonicalWorkspace) -> Self {
        Self {
            kind: match request.kind {
                KindName::Platform => Kind::Platform,
                KindName::Tool => Kind::Tool,
                KindName::Part => Kind::Part,
            },
            tool_length: request.tool_length.unwrap_or_default(),
            table_clearance: request.table_clearance,
            tool_radius: request.tool_radius.unwrap_or_default(),
            phi1: from_degrees_of_turn(request.phi1.unwrap_or_default()),
            phi2: from_degrees_of_turn(request.phi2.unwrap_or_default()),
            tolerance: request.tolerance,
        }
    }
}

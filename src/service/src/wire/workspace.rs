//! The question `/workspace`, as JSON and as it is kept.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::workspace::{Kind, Request};

use crate::wire::degrees::from_degrees_of_turn;
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;

/// A request for a workspace.
#[derive(Clone, Debug)]
pub(crate) struct WorkspaceRequest {
    /// The machine: the name of a published machine, or a machine object.
    pub machine: MachineRef,
    /// Point and frame of the positions.
    pub kind: KindName,
    /// Distance from P to the tool end, mm. Kind `platform` ignores it.
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's joints over the table, mm; only kind `part` has it.
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, mm; counts for `table_clearance` alone.
    pub tool_radius: f64,
    /// Inclination of the tool in the part frame, degrees. Only kind `part` uses it.
    pub phi1: f64,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    pub phi2: f64,
    /// Greatest distance between the mesh and the true surface, in both directions, mm.
    pub tolerance: f64,
}

/// Tolerance of a question that names none, mm.
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

    /// Why there is no theta1, where there is none.
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
pub(crate) struct CanonicalRequest {
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

/// A clearance over the table and a tool's radius as they are kept: the radius counts beside a clearance alone. -0 is 0.
pub(crate) fn over_table(clearance: Option<f64>, tool_radius: f64) -> [Option<f64>; 2] {
    [clearance, clearance.map(|_| tool_radius)].map(|length| length.map(|length| length + 0.0))
}

impl From<&WorkspaceRequest> for CanonicalRequest {
    fn from(asked: &WorkspaceRequest) -> Self {
        // -0 is 0.
        let (tool, part) = (asked.kind != KindName::Platform, asked.kind == KindName::Part);
        let clearance = asked.table_clearance.filter(|_| part);
        let [table_clearance, tool_radius] = over_table(clearance, asked.tool_radius);
        Self {
            kind: asked.kind,
            tool_length: tool.then_some(asked.tool_length + 0.0),
            table_clearance,
            tool_radius,
            phi1: part.then_some(asked.phi1 + 0.0),
            phi2: part.then_some(asked.phi2 + 0.0),
            tolerance: asked.tolerance,
        }
    }
}

impl CanonicalRequest {
    /// What is not checked.
    pub(crate) fn not_checked(&self) -> &'static [Unchecked] {
        Unchecked::beside(self.table_clearance.is_some())
    }
}

impl From<&CanonicalRequest> for Request {
    fn from(asked: &CanonicalRequest) -> Self {
        Self {
            kind: match asked.kind {
                KindName::Platform => Kind::Platform,
                KindName::Tool => Kind::Tool,
                KindName::Part => Kind::Part,
            },
            tool_length: asked.tool_length.unwrap_or_default(),
            table_clearance: asked.table_clearance,
            tool_radius: asked.tool_radius.unwrap_or_default(),
            phi1: from_degrees_of_turn(asked.phi1.unwrap_or_default()),
            phi2: from_degrees_of_turn(asked.phi2.unwrap_or_default()),
            tolerance: asked.tolerance,
        }
    }
}

//! The moves of a program that the machine cannot follow.

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::toolpath::{Change, Failure, Parameter};
use verne_solver::{PartPose, TableAngles};

use crate::wire::constraint::{ConstraintName, ElementName, Unit};
use crate::wire::degrees::to_degrees;
use crate::wire::fixed_array::FixedArray;
use crate::wire::request::Joints;

/// Consecutive moves that the machine cannot follow for the same reason.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathFailure)]
pub(crate) struct FailureObject {
    /// The first and the last line.
    #[schema(value_type = Vec<u32>, min_items = 2, max_items = 2)]
    pub lines: [u32; 2],
    /// The first 200 characters of the first line. Rows (CSV, NDJSON, points) have no text.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub text: Option<String>,
    /// The constraint that the moves break.
    pub constraint: ConstraintName,
    /// The part of the machine, such as `slider2.max`.
    #[schema(value_type = String, example = "slider2.max")]
    pub element: ElementName,
    /// The worst margin: negative, as much as is missing.
    pub margin: f64,
    /// Unit of `margin`.
    pub unit: Unit,
    /// The place with the worst margin.
    pub at: FailurePlace,
    /// The smallest change of one number of the request that lets the machine follow these moves. The service looks for
    /// it up to 512 mm for the first three stretches of at most 2000 moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub change: Option<ChangeObject>,
}

/// A change of one number of the request.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathChange)]
pub(crate) struct ChangeObject {
    /// The number.
    pub parameter: ParameterName,
    /// The change, mm: add it to the parameter.
    pub delta: f64,
}

/// A number of the request: `setup.x`, `setup.y`, `setup.z` (of the frame that the moves are in), or `tool_length` (of
/// the tool of the moves).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[schema(as = ToolpathParameter)]
pub(crate) enum ParameterName {
    /// x of the frame.
    #[serde(rename = "setup.x")]
    X,
    /// y of the frame.
    #[serde(rename = "setup.y")]
    Y,
    /// z of the frame.
    #[serde(rename = "setup.z")]
    Z,
    /// The length of the tool.
    #[serde(rename = "tool_length")]
    ToolLength,
}

impl From<Change> for ChangeObject {
    fn from(Change { parameter, delta }: Change) -> Self {
        let parameter = match parameter {
            Parameter::X => ParameterName::X,
            Parameter::Y => ParameterName::Y,
            Parameter::Z => ParameterName::Z,
            Parameter::ToolLength => ParameterName::ToolLength,
        };
        Self { parameter, delta }
    }
}

/// A place of a program. /fk for its joints with this tool has the margin of the failure; a place without joints has
/// none in the working mode, and /ik for its pose in frame `part` says why.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FailurePlace {
    /// The line.
    pub line: u32,
    /// x of the tool's end in the part frame, mm.
    pub x: f64,
    /// y, mm.
    pub y: f64,
    /// z, mm.
    pub z: f64,
    /// Inclination of the tool, degrees.
    pub phi1: f64,
    /// Azimuth of the tool, degrees, on the winding of the plan.
    pub phi2: f64,
    /// Distance from P to the tool end, mm. With `tip: "centre"` the end is the centre of the ball.
    pub tool_length: f64,
    /// The joints, with theta2 on the winding of the plan. A place that the machine cannot reach has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub joints: Option<Joints>,
}

impl FailurePlace {
    /// The place of a failure at a line, with its tool.
    pub(crate) fn new(line: u32, failure: &Failure, tool_length: f64) -> Self {
        let PartPose { x, y, z, phi1, phi2 } = failure.pose;
        let [phi1, phi2] = [phi1, phi2].map(to_degrees);
        let joints = failure.joints.map(|(rho, TableAngles { theta1, theta2 })| {
            let [theta1, theta2] = [theta1, theta2].map(|theta| Some(to_degrees(theta)));
            Joints { rho: FixedArray(rho), theta1, theta2 }
        });
        Self { line, x: x + 0.0, y: y + 0.0, z: z + 0.0, phi1, phi2, tool_length, joints }
    }
}

//! The request for a tool path with its default values.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::drives::DrivesObject;
use crate::wire::result_id::ResultId;
use crate::wire::start::Start;
use crate::wire::toolpath::{
    OnLimitName, OrientationName, RapidsName, Setup, TipName, Tolerance, ToolLengths,
};

/// The request for a tool path with its default values, without the fields that have no effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalToolpathRequest)]
pub(crate) struct CanonicalToolpath {
    /// The id of the program.
    #[schema(value_type = String)]
    pub program: ResultId,
    /// The program's frame in the part frame.
    pub setup: Setup,
    /// The program's frame for each work offset.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub offsets: BTreeMap<String, Setup>,
    /// The lengths of the tools, mm; missing if those of the program are used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_length: Option<ToolLengths>,
    /// The entry of `tool_length` for moves before the program calls a tool. Only a table of lengths has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub length_before: Option<u32>,
    /// Radius of the tool's end, mm. Only a request with a table check or with `tip: "centre"` has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_radius: Option<f64>,
    /// The point of the tool that the program moves.
    pub tip: TipName,
    /// The motion of the axis between two points; missing if it follows the words of each point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub orientation: Option<OrientationName>,
    /// Whether the table keeps the program's phi2 also where phi1 is 0. Only a request with `hold_rotary` has it.
    #[serde(default, skip_serializing_if = "is_false")]
    pub hold_rotary: bool,
    /// Greatest deviations.
    pub tolerance: Tolerance,
    /// Half-angle of the cap around the table's own axis in which theta2 is free, degrees.
    pub pole: f64,
    /// The motion in rapids.
    pub rapids: RapidsName,
    /// Where the machine stands before the program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub start: Option<Start>,
    /// Table clearance, mm. Only a request with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub table_clearance: Option<f64>,
    /// The drives of the machine, which its hash leaves out; missing if it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub drives: Option<DrivesObject>,
    /// Seconds in which the velocity of a drive may change at a corner. Only machines whose drives have accelerations
    /// have it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub cycle: Option<f64>,
    /// Behaviour where the machine cannot follow a cut.
    pub on_limit: OnLimitName,
    /// How far the tool leaves the part, mm. Only a request with `on_limit: "retract"` has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub clearance: Option<f64>,
    /// Height at which the table turns, mm; missing if it is `clearance` above the program's highest point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub retract_z: Option<f64>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_false(flag: &bool) -> bool {
    !flag
}

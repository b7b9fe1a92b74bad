//! Parameters of `POST /toolpath` with a file as the body, in query strings and on the command line.

use std::collections::BTreeMap;

use clap::Args;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::wire::error::{FieldError, OperationError};
use crate::wire::json_text::JsonText;
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};
use crate::wire::start::Start;
use crate::wire::strict_object::StrictObject;
use crate::wire::toolpath::{
    OnLimitName, OrientationName, RapidsName, Setup, TipName, Tolerance, ToolLengths, ToolpathRequest,
};

/// The fields of a request for a tool path whose program is the body.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct ToolpathQuery {
    /// Name of the machine. On the command line it may also be the path of a machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// The program's frame in the part frame as JSON: any of x, y, z (mm), a, b, c (degrees), such as `{"x":10}`.
    #[arg(long, value_name = "JSON")]
    #[param(value_type = Option<String>, nullable = false)]
    pub setup: Option<JsonText<StrictObject<Setup>>>,
    /// The program's frame for each work offset as JSON, such as `{"G55":{"x":100}}`.
    #[arg(long, value_name = "JSON")]
    #[param(value_type = Option<String>, nullable = false)]
    pub offsets: Option<JsonText<BTreeMap<String, StrictObject<Setup>>>>,
    /// Distance from P to the tool end, mm: one number for every tool, or JSON with the length of each tool by its
    /// number, such as `{"1":120,"2":95}`. Without it the lengths that the program states are used.
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    #[param(value_type = Option<String>, nullable = false)]
    pub tool_length: Option<JsonText<ToolLengths>>,
    /// The entry of `tool_length` for moves before the program calls a tool.
    #[arg(long)]
    #[param(nullable = false)]
    pub length_before: Option<u32>,
    /// Radius of the tool's end, mm. Only `tip=centre` and `table_clearance` use it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// The point of the tool that the program moves.
    #[serde(default)]
    #[arg(long, default_value = "end")]
    pub tip: TipName,
    /// The motion of the axis between two points. The default follows the words of each point: `vector` for i, j, k,
    /// and `rotary` for rotary words.
    #[arg(long)]
    #[param(inline, nullable = false)]
    pub orientation: Option<OrientationName>,
    /// Whether the table keeps the program's phi2 also where phi1 is 0, so that phi2 does not turn the tool's axis. It
    /// then turns through the stated angles everywhere; otherwise theta2 is free there. Only moves between points with
    /// rotary words keep it, and only frames with a = b = 0 allow it.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub hold_rotary: bool,
    /// Greatest deviation of the tool's end in feed moves, mm.
    #[serde(default = "default_tip")]
    #[arg(long, default_value_t = default_tip(), allow_hyphen_values = true)]
    #[param(minimum = 1e-5, maximum = 100, default = 0.01)]
    pub tip_tolerance: f64,
    /// Greatest deviation of the tool's axis in feed moves, degrees.
    #[serde(default = "default_axis")]
    #[arg(long, default_value_t = default_axis(), allow_hyphen_values = true)]
    #[param(minimum = 1e-5, maximum = 10, default = 0.05)]
    pub axis_tolerance: f64,
    /// Greatest deviation of the tool's end in rapids, mm.
    #[serde(default = "default_rapid")]
    #[arg(long, default_value_t = default_rapid(), allow_hyphen_values = true)]
    #[param(minimum = 1e-5, maximum = 1000, default = 1.0)]
    pub rapid_tolerance: f64,
    /// Half-angle of the cap around the table's own axis in which theta2 is free, degrees: less than the axis
    /// tolerance, of which it is a part. The default is half the axis tolerance.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, nullable = false)]
    pub pole: Option<f64>,
    /// The motion in rapids.
    #[serde(default)]
    #[arg(long, default_value = "linear")]
    pub rapids: RapidsName,
    /// Where the machine stands before the program as JSON, such as `{"rho":[600,500,500],"theta1":0,"theta2":180}`: it
    /// moves from there to the first point as in a rapid. Without it, the machine stands at the first point.
    #[arg(long, value_name = "JSON")]
    #[param(value_type = Option<String>, nullable = false)]
    pub start: Option<JsonText<StrictObject<Start>>>,
    /// Least height of the tool's end and of the platform's six joints over the table (the plane Z = 0 of the part
    /// frame), mm. The default is the limit of the machine; if the machine has none, the service does not check the
    /// table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Cycle of the controller, s: at a corner of the path the velocity of each drive changes by at most what its
    /// acceleration changes in this time. Only a machine with accelerations in `drives` uses it. The default is 0.004.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 1e-6, maximum = 1, nullable = false)]
    pub cycle: Option<f64>,
    /// Behaviour where the machine cannot follow a cut.
    #[serde(default)]
    #[arg(long, default_value = "fail")]
    pub on_limit: OnLimitName,
    /// How far the tool leaves the part along its axis, and how far above the program's highest point it turns with the
    /// table, mm. The default is 50. Only with `on_limit=retract`.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0.1, maximum = 1e7, nullable = false)]
    pub clearance: Option<f64>,
    /// Height of the tool's end in the part frame at which the table turns, mm; at least that of the program's highest
    /// point. The default is `clearance` above it. Only with `on_limit=retract`.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = -1e7, maximum = 1e7, nullable = false)]
    pub retract_z: Option<f64>,
}

fn default_tip() -> f64 {
    Tolerance::default().tip
}

fn default_axis() -> f64 {
    Tolerance::default().axis
}

fn default_rapid() -> f64 {
    Tolerance::default().rapid
}

impl ToolpathQuery {
    /// The request, without its program.
    pub(crate) fn into_request(self) -> ToolpathRequest {
        let offsets = self.offsets.map(|offsets| offsets.0).unwrap_or_default();
        ToolpathRequest {
            program: None,
            units: None,
            machine: MachineRef::Name(self.machine),
            setup: self.setup.map(|setup| setup.0.0).unwrap_or_default(),
            offsets: offsets.into_iter().map(|(name, setup)| (name, setup.0)).collect(),
            tool_length: self.tool_length.map(|lengths| lengths.0),
            length_before: self.length_before,
            tool_radius: self.tool_radius,
            tip: self.tip,
            orientation: self.orientation,
            hold_rotary: self.hold_rotary,
            tolerance: Tolerance {
                tip: self.tip_tolerance,
                axis: self.axis_tolerance,
                rapid: self.rapid_tolerance,
            },
            pole: self.pole,
            rapids: self.rapids,
            start: self.start.map(|start| start.0.0),
            table_clearance: self.table_clearance,
            cycle: self.cycle,
            on_limit: self.on_limit,
            clearance: self.clearance,
            retract_z: self.retract_z,
        }
    }
}

/// Turns the pointers into the body of a request into pointers to the parameters of its query.
pub(crate) fn point_into_toolpath_query(error: OperationError) -> OperationError {
    let OperationError::Fields(faults) = error else { return error };
    let moved = faults.into_iter().map(|fault| {
        // The parameters of a joint program are in the query only.
        if fault.pointer.starts_with("/query/") {
            return fault;
        }
        let name = match fault.pointer.strip_prefix("/tolerance/") {
            Some(name) => format!("/{name}_tolerance"),
            None => fault.pointer,
        };
        FieldError::new(format!("/query{name}"), fault.detail)
    });
    OperationError::Fields(moved.collect())
}

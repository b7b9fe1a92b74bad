//! Parameters of batches whose rows come in columns, in query strings and on the command line: everything that is not a
//! row.

use clap::Args;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::wire::batch::{FkBatchNumbers, IkBatchNumbers, Orientation};
use crate::wire::bounded_list::BoundedList;
use crate::wire::contains::ANY_TOLERANCE;
use crate::wire::jacobian::JacobianColumns;
use crate::wire::json_text::JsonText;
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};
use crate::wire::request::Frame;
use crate::wire::row_format::RowFormat;
use crate::wire::start::Start;
use crate::wire::strict_object::StrictObject;
use crate::wire::sweep::Sweep;
use crate::wire::workspace::{KindName, WorkspaceRequest};

/// Parameters of POST /ik/batch with rows in columns.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct IkRowsQuery {
    /// Answer in this format. It overrides Accept. If Content-Type states no format, it is also that of the body. A
    /// JSON body is answered in JSON and takes no other parameter.
    #[arg(skip)]
    #[param(inline, nullable = false)]
    pub format: Option<RowFormat>,
    /// Name of the machine, or in a query a machine object as JSON. On the command line it may also be the path of a
    /// machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Frame of the rows.
    #[serde(default)]
    #[arg(long, default_value = "part")]
    pub frame: Frame,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only frame `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Columns of the Jacobian that the answer has. `condition`: det_p, condition_number and, if the machine has
    /// drives, speed_x, speed_y, speed_z. `matrix`: j11 to j55, too. Only frame `part` has it.
    #[arg(id = "jacobian_columns", long)]
    #[param(nullable = false)]
    pub jacobian: Option<JacobianColumns>,
    /// Length by which the Jacobian's lengths are divided before its condition number is computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 1e-3, maximum = 1e7, nullable = false)]
    pub characteristic_length: Option<f64>,
    /// Whether each row continues from the row before: on the same preimage (phi1, phi2) of its tool axis, with theta2
    /// within half a turn, in the same working solution. A row that cannot has `jump`. Only frame `part` has it.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub continuous: bool,
    /// Joints as JSON, such as `{"rho":[600,500,500],"theta1":0,"theta2":180}`, from which the first row continues.
    /// Only with `continuous`.
    #[arg(long, value_name = "JSON")]
    #[param(value_type = Option<String>, nullable = false)]
    pub start: Option<JsonText<StrictObject<Start>>>,
}

impl From<IkRowsQuery> for IkBatchNumbers {
    /// The request without rows.
    fn from(query: IkRowsQuery) -> Self {
        Self {
            machine: MachineRef::Name(query.machine),
            frame: query.frame,
            tool_length: query.tool_length,
            table_clearance: query.table_clearance,
            tool_radius: query.tool_radius,
            jacobian: query.jacobian,
            characteristic_length: query.characteristic_length,
            poses: BoundedList::default(),
            continuous: query.continuous,
            start: query.start.map(|start| start.0.0),
        }
    }
}

/// Parameters of POST /fk/batch with rows in columns.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct FkRowsQuery {
    /// Answer in this format. It overrides Accept. If Content-Type states no format, it is also that of the body. A
    /// JSON body is answered in JSON and takes no other parameter.
    #[arg(skip)]
    #[param(inline, nullable = false)]
    pub format: Option<RowFormat>,
    /// Name of the machine, or in a query a machine object as JSON. On the command line it may also be the path of a
    /// machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Needs theta1. The default is the limit of the machine; if the machine has none, the service
    /// does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Columns of the Jacobian that the answer has. `condition`: det_p, condition_number and, if the machine has
    /// drives, speed_x, speed_y, speed_z. `matrix`: j11 to j55, too. Needs theta1 and theta2.
    #[arg(id = "jacobian_columns", long)]
    #[param(nullable = false)]
    pub jacobian: Option<JacobianColumns>,
    /// Length by which the Jacobian's lengths are divided before its condition number is computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 1e-3, maximum = 1e7, nullable = false)]
    pub characteristic_length: Option<f64>,
    /// Columns of the tool's orientation in the part frame: phi1 and phi2, or i, j and k.
    #[serde(default)]
    #[arg(long, default_value = "rotary")]
    pub orientation: Orientation,
}

impl From<FkRowsQuery> for FkBatchNumbers {
    /// The request without rows.
    fn from(query: FkRowsQuery) -> Self {
        Self {
            machine: MachineRef::Name(query.machine),
            tool_length: query.tool_length,
            table_clearance: query.table_clearance,
            tool_radius: query.tool_radius,
            jacobian: query.jacobian,
            characteristic_length: query.characteristic_length,
            orientation: query.orientation,
            joints: BoundedList::default(),
        }
    }
}

/// Parameters of POST /workspace/contains with points in columns.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct ContainsRowsQuery {
    /// Answer in this format. It overrides Accept. If Content-Type states no format, it is also that of the body. A
    /// JSON body is answered in JSON and takes no other parameter.
    #[arg(skip)]
    #[param(inline, nullable = false)]
    pub format: Option<RowFormat>,
    /// Name of the machine, or in a query a machine object as JSON. On the command line it may also be the path of a
    /// machine file.
    #[serde(default = "reference_name")]
    #[arg(long, default_value = REFERENCE)]
    #[param(default = "verne")]
    pub machine: String,
    /// Point and frame of the positions.
    #[serde(default)]
    #[arg(long, default_value = "platform")]
    pub kind: KindName,
    /// Distance from P to the tool end, mm. Kind `platform` ignores it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only kind `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Inclination of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi1: f64,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
}

impl From<ContainsRowsQuery> for WorkspaceRequest {
    /// The request for the workspace.
    fn from(query: ContainsRowsQuery) -> Self {
        Self {
            machine: MachineRef::Name(query.machine),
            kind: query.kind,
            tool_length: Sweep::One(query.tool_length),
            table_clearance: query.table_clearance,
            tool_radius: query.tool_radius,
            phi1: Sweep::One(query.phi1),
            phi2: Sweep::One(query.phi2),
            tolerance: ANY_TOLERANCE,
        }
    }
}

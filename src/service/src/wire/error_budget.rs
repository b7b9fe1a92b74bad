//! `POST /error-budget`.

use clap::Args;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use crate::wire::answer::MachineId;
use crate::wire::batch::{Row, RowReport};
use crate::wire::bounded_list::BoundedList;
use crate::wire::constraint::Unit;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::fixed_array::{Triple, TripleList};
use crate::wire::json_text::JsonText;
use crate::wire::machine_ref::{MachineRef, REFERENCE, reference_name};
use crate::wire::parameter_tolerances::ParameterTolerances;
use crate::wire::request::Frame;
use crate::wire::row_format::RowFormat;
use crate::wire::strict_object::{StrictObject, strict_object};

/// The errors of the tool at poses, for tolerances of the machine's parameters.
///
/// The service reads the rows one by one, so a malformed row does not affect the others.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(bound = "")]
pub(crate) struct ErrorBudgetRequest<R> {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Frame of the rows and of the errors. In frame `part` the errors of the table count, too; in frame `platform`
    /// they are those of P, and the tool has no effect.
    #[serde(default)]
    pub frame: Frame,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// The tolerances of the parameters.
    #[serde(deserialize_with = "strict_object")]
    pub parameter_tolerances: ParameterTolerances,
    /// Rows `[x, y, z, phi1, phi2]` or `[x, y, z, i, j, k]` in frame `part`, `[x, y, z]` in the other frames, as in
    /// /ik/batch. A malformed row has the status `invalid`.
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub poses: BoundedList<R>,
}

/// An [`ErrorBudgetRequest`] whose rows are arrays of numbers.
pub(crate) type ErrorBudgetNumbers = ErrorBudgetRequest<Row>;

/// The error budgets of all poses, in order.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct ErrorBudgetAnswer {
    /// The machine.
    pub machine: MachineId,
    /// The parameters with a tolerance. `worst_changes` and `contributions` have their order.
    pub parameters: Vec<ParameterObject>,
    /// `[rho1, rho2, rho3]`, in frame `part` `[rho1, rho2, rho3, theta1, theta2]`; null for a row without a solution.
    /// If several working solutions exist, a feasible one is preferred.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub joints: Vec<Option<Row>>,
    /// The budget of each row; null for a row without a solution, and at a parallel singularity, where errors have no
    /// bound.
    pub budgets: Vec<Option<BudgetObject>>,
    /// Status of each row.
    #[serde(flatten)]
    pub report: RowReport,
}

/// A parameter with its tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
#[schema(as = ParameterTolerance)]
pub(crate) struct ParameterObject {
    /// The name.
    pub name: &'static str,
    /// Unit of its numbers: `mm` or `deg`.
    pub unit: Unit,
    /// Value in the machine; 0 for a parameter that a machine has no field for.
    pub nominal: f64,
    /// Tolerance.
    pub tolerance: f64,
}

/// The error budget of a pose, to the first order.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
#[schema(as = ErrorBudget)]
pub(crate) struct BudgetObject {
    /// Displacement of the tool end, mm.
    pub tip: FigureObject,
    /// Angle of the tool's axis, degrees.
    pub axis: FigureObject,
}

/// An error, to the first order: mm, or degrees.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
#[schema(as = ErrorFigure)]
pub(crate) struct FigureObject {
    /// Root of the mean square of the error, for independent parameters whose standard deviations are the tolerances.
    pub rms: f64,
    /// Standard deviations of the error along x, y and z of the frame. For the axis they are those of its unit vector,
    /// as angles.
    #[schema(inline)]
    pub standard_deviations: Triple,
    /// Greatest error with every parameter within its tolerance.
    pub worst: f64,
    /// The error with `worst_changes` in the exact model, or with the opposite changes if it is greater; null if no
    /// posture is near with them.
    pub worst_exact: Option<f64>,
    /// Changes of the parameters with which `worst` is attained. The opposite changes are as bad.
    pub worst_changes: Vec<f64>,
    /// The error with one parameter alone off by its tolerance, for each. `rms` is the root of the sum of their
    /// squares.
    pub contributions: Vec<f64>,
}

/// Parameters of POST /error-budget with rows in columns.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct ErrorBudgetRowsQuery {
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
    /// Frame of the rows and of the errors.
    #[serde(default)]
    #[arg(long, default_value = "part")]
    pub frame: Frame,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    #[param(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// The tolerances of the parameters as JSON, mm and degrees, such as `{"L1":0.02,"tilt_zero":0.001}`. A table needs
    /// them.
    #[arg(long, value_name = "JSON", required = true)]
    #[param(value_type = String, example = "{\"L1\":0.02}")]
    pub parameter_tolerances: Option<JsonText<StrictObject<ParameterTolerances>>>,
}

/// A pose whose error budget `verne error-budget` computes.
#[derive(Debug, Args)]
pub(crate) struct ErrorBudgetQuery {
    /// Name of the machine, or the path of a machine file.
    #[arg(long, default_value = REFERENCE)]
    pub machine: String,
    /// Frame of x, y, z, of the orientation and of the errors.
    #[arg(long, default_value = "part")]
    pub frame: Frame,
    /// x, mm.
    #[arg(long, allow_hyphen_values = true)]
    pub x: f64,
    /// y, mm.
    #[arg(long, allow_hyphen_values = true)]
    pub y: f64,
    /// z, mm. It points down in the base frame and up from the table in the part frame.
    #[arg(long, allow_hyphen_values = true)]
    pub z: f64,
    /// Inclination of the tool, degrees. Only frame `part` has it. The default is 0, unless --axis is given.
    #[arg(long, allow_hyphen_values = true)]
    pub phi1: Option<f64>,
    /// Azimuth of the tool, degrees. Only frame `part` has it. The default is 0, unless --axis is given.
    #[arg(long, allow_hyphen_values = true)]
    pub phi2: Option<f64>,
    /// Tool axis i,j,k in the part frame, from the tool end to the holder. Only frame `part` has it.
    #[arg(long, allow_hyphen_values = true, conflicts_with_all = ["phi1", "phi2"])]
    pub axis: Option<TripleList>,
    /// Distance from P to the tool end, mm.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub tool_length: f64,
    /// The tolerances of the parameters as JSON, mm and degrees, such as `{"L1":0.02,"tilt_zero":0.001}`.
    #[arg(long, value_name = "JSON")]
    pub parameter_tolerances: JsonText<StrictObject<ParameterTolerances>>,
}

impl ErrorBudgetRowsQuery {
    /// The request without rows, for a machine.
    pub(crate) fn into_request(self, machine: MachineRef) -> Result<ErrorBudgetNumbers, OperationError> {
        let missing = || {
            let detail = "is missing: a table needs it";
            OperationError::Fields(vec![FieldError::new("/parameter_tolerances", detail)])
        };
        Ok(ErrorBudgetNumbers {
            machine,
            frame: self.frame,
            tool_length: self.tool_length,
            parameter_tolerances: self.parameter_tolerances.ok_or_else(missing)?.0.0,
            poses: BoundedList::default(),
        })
    }
}

impl ErrorBudgetQuery {
    /// The request without its pose, for a machine; and the pose as a row.
    pub(crate) fn into_request(self, machine: MachineRef) -> (ErrorBudgetNumbers, Row) {
        let mut pose: Row = [self.x, self.y, self.z].into_iter().collect();
        match (self.axis, self.frame) {
            (Some(axis), _) => pose.extend(axis.first.0),
            (None, Frame::Part) => {
                pose.extend([self.phi1, self.phi2].map(Option::unwrap_or_default));
            }
            (None, Frame::Platform | Frame::Tool) => pose.extend(self.phi1.into_iter().chain(self.phi2)),
        }
        let request = ErrorBudgetNumbers {
            machine,
            frame: self.frame,
            tool_length: self.tool_length,
            parameter_tolerances: self.parameter_tolerances.0.0,
            poses: BoundedList::default(),
        };
        (request, pose)
    }
}

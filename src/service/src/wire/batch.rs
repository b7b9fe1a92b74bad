//! Batches: many rows in, columns out.

use arrayvec::ArrayVec;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::bounded_list::BoundedList;
use crate::wire::constraint::{ConstraintName, ElementName};
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::request::Frame;
use crate::wire::tool::has_tool;

/// The working solution for many poses.
///
/// The service reads the rows one by one, so a malformed row does not affect the others.
// `R` is a row: `Row` if every row is an array of numbers, which is several times as fast to parse; otherwise the text
// of the row.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(bound = "")]
pub(crate) struct IkBatchRequest<R> {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Frame of the rows.
    #[serde(default)]
    pub frame: Frame,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only frame `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Rows `[x, y, z, phi1, phi2]` in frame `part`, `[x, y, z]` in the other frames. A malformed row has the status
    /// `invalid`.
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub poses: BoundedList<R>,
}

/// The working solution for many joint positions.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(bound = "")]
pub(crate) struct FkBatchRequest<R> {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Every row then needs theta1. The default is the limit of the machine; if the machine has none,
    /// the service does not check the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Rows `[rho1, rho2, rho3]` or `[rho1, rho2, rho3, theta1, theta2]`. A malformed row has the status `invalid`.
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub joints: BoundedList<R>,
}

/// Numbers of one row.
pub(crate) type Row = ArrayVec<f64, 5>;

/// An [`IkBatchRequest`] whose rows are arrays of numbers.
pub(crate) type IkBatchNumbers = IkBatchRequest<Row>;

/// An [`FkBatchRequest`] whose rows are arrays of numbers.
pub(crate) type FkBatchNumbers = FkBatchRequest<Row>;

has_tool!(IkBatchRequest<R>);
has_tool!(FkBatchRequest<R>);

/// Joints for every pose, in order.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct IkBatchAnswer {
    /// The machine.
    pub machine: MachineId,
    /// `[rho1, rho2, rho3]`, in frame `part` `[rho1, rho2, rho3, theta1, theta2]`; null for a row without a solution.
    /// Joints that break a limit have the status `infeasible`. If a pose has several working solutions, the service
    /// returns the first one that the solver finds from a level platform, if it is feasible; otherwise the feasible one
    /// with the least alpha; otherwise the first one.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub joints: Vec<Option<Row>>,
    /// Status of each row.
    #[serde(flatten)]
    pub report: RowReport,
}

/// Poses for all joints, in order.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct FkBatchAnswer {
    /// The machine.
    pub machine: MachineId,
    /// `[x, y, z, alpha]` of the platform in the base frame; null for a row without a solution.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub poses: Vec<Option<Row>>,
    /// `[x, y, z, phi1, phi2]` of the tool in the part frame, for rows with theta1 and theta2.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub parts: Vec<Option<Row>>,
    /// Status of each row.
    #[serde(flatten)]
    pub report: RowReport,
}

/// Status of each row, as columns with one entry for each row, and totals.
#[derive(Debug, Default, Serialize, ToSchema)]
pub(crate) struct RowReport {
    /// Status of each row.
    pub status: Vec<Status>,
    /// The worst violated constraint of each row that is not `ok`; null for `ok` and `invalid`.
    pub constraint: Vec<Option<ConstraintName>>,
    /// Margin of this constraint: negative, in its unit (mm, degrees or a pure number).
    pub margin: Vec<Option<f64>>,
    /// The part of the machine with this margin, such as `slider2.max`.
    #[schema(value_type = Vec<Option<String>>)]
    pub element: Vec<Option<ElementName>>,
    /// Number of rows with each status.
    pub counts: Counts,
    /// Conditions that the service did not check for at least one row.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Errors of the invalid rows, for the first hundred of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<RowError>,
}

/// Status of a row: `ok`; `unreachable`, the working mode has no solution; `infeasible`, the solution breaks a limit;
/// `invalid`, the row is malformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Status {
    /// Rows with a solution within every limit.
    Ok,
    /// Rows without a solution in the working mode.
    Unreachable,
    /// Solved, but breaks a limit.
    Infeasible,
    /// The row cannot be read.
    Invalid,
}

/// Number of rows with each status.
#[derive(Clone, Copy, Debug, Default, Serialize, ToSchema)]
pub(crate) struct Counts {
    /// Rows with a solution within every limit.
    pub ok: usize,
    /// Rows without a solution in the working mode.
    pub unreachable: usize,
    /// Rows with a solution that breaks a limit.
    pub infeasible: usize,
    /// Malformed.
    pub invalid: usize,
}

/// Error of a row.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct RowError {
    /// The row, from 0.
    pub row: usize,
    /// The error, and the accepted values.
    pub detail: String,
}

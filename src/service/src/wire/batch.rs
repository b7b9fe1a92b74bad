//! Batches: many rows in, columns out.

use arrayvec::ArrayVec;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::bounded_list::BoundedList;
use crate::wire::constraint::{ConstraintName, ElementName};
use crate::wire::jacobian::{JacobianColumns, JacobianLists};
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::request::Frame;
use crate::wire::start::Start;
use crate::wire::strict_object::optional_strict_object;
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
    /// Columns of the Jacobian that the answer has: `condition` or `matrix`. Only frame `part` has it.
    #[serde(default)]
    #[schema(nullable = false)]
    pub jacobian: Option<JacobianColumns>,
    /// Length by which the Jacobian's lengths are divided before its condition number is computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[serde(default)]
    #[schema(minimum = 1e-3, maximum = 1e7)]
    pub characteristic_length: Option<f64>,
    /// Rows `[x, y, z, phi1, phi2]` or `[x, y, z, i, j, k]` in frame `part`, `[x, y, z]` in the other frames. i, j, k
    /// is the tool axis in the part frame, from the tool end to the holder, of any length. Both orientations that have
    /// the axis are solved. A malformed row has the status `invalid`.
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub poses: BoundedList<R>,
    /// Whether each row continues from the row before: on the same preimage (phi1, phi2) of its tool axis, with theta2
    /// within half a turn, in the same working solution. A row that cannot has `jump`. Only frame `part` has it.
    ///
    /// A row then states the tool's end and its axis, by phi1 and phi2 or by i, j, k. The service decides row by row;
    /// it does not look ahead.
    #[serde(default)]
    #[schema(default = false)]
    pub continuous: bool,
    /// Joints, with the sliders, from which the first row continues. Only with `continuous`. Without it the first row
    /// has the least |theta2|, or phi1 >= 0 if two are equal.
    #[serde(default, deserialize_with = "optional_strict_object")]
    pub start: Option<Start>,
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
    /// Columns of the Jacobian that the answer has: `condition` or `matrix`. Every row then needs theta1 and
    /// theta2.
    #[serde(default)]
    #[schema(nullable = false)]
    pub jacobian: Option<JacobianColumns>,
    /// Length by which the Jacobian's lengths are divided before its condition number is computed, mm. Only with
    /// `jacobian`. The default is R1 of the machine.
    #[serde(default)]
    #[schema(minimum = 1e-3, maximum = 1e7)]
    pub characteristic_length: Option<f64>,
    /// Orientation of the rows of `parts`.
    #[serde(default)]
    pub orientation: Orientation,
    /// Rows `[rho1, rho2, rho3]` or `[rho1, rho2, rho3, theta1, theta2]`. A malformed row has the status `invalid`.
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub joints: BoundedList<R>,
}

/// Orientation of a pose in the part frame: `rotary` (default), phi1 and phi2 in degrees; `vector`, the tool axis i, j,
/// k, a unit vector from the tool end to the holder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Orientation {
    /// phi1 and phi2.
    #[default]
    Rotary,
    /// i, j, k.
    Vector,
}

/// Numbers of one row.
pub(crate) type Row = ArrayVec<f64, 6>;

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
    /// with the least alpha; otherwise the first one. A row `[x, y, z, i, j, k]` has two preimages (phi1, phi2): the
    /// service prefers a feasible solution, then the least |theta2|, then phi1 >= 0. With `continuous` the row before
    /// decides.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub joints: Vec<Option<Row>>,
    /// Whether each row does not continue from the row before, or from `start`: it needs another preimage (phi1, phi2),
    /// winding or working solution. null for a row without a solution. Only with `continuous`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub jump: Option<Vec<Option<bool>>>,
    /// How many rows have `jump`. Only with `continuous`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub jumps: Option<usize>,
    /// Jacobians of the rows. Only with `jacobian` in the request.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub jacobian: Option<JacobianLists>,
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
    /// `[x, y, z, phi1, phi2]` of the tool in the part frame, for rows with theta1 and theta2; `[x, y, z, i, j, k]` if
    /// `orientation` is `vector`. null for other rows.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub parts: Vec<Option<Row>>,
    /// Jacobians of the rows. Only with `jacobian` in the request.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub jacobian: Option<JacobianLists>,
    /// Status of each row.
    #[serde(flatten)]
    pub report: RowReport,
}

/// Status of each row, as columns with one entry for each row, and totals.
#[derive(Debug, Default, Serialize, ToSchema)]
pub(crate) struct RowReport {
    /// Status of each row.
    pub status: Vec<Status>,
    /// The constraint with the least margin of each row, as a fraction of its own range: the nearest limit of an `ok`
    /// row, the limit that prevents another one. null for `invalid`.
    pub constraint: Vec<Option<ConstraintName>>,
    /// Margin of this constraint in its unit (mm, degrees or a pure number): at least zero for `ok`, otherwise
    /// negative.
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

impl Status {
    /// All of them, in the order of their values.
    pub(crate) const ALL: [Self; 4] = [Self::Ok, Self::Unreachable, Self::Infeasible, Self::Invalid];

    /// The name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Unreachable => "unreachable",
            Self::Infeasible => "infeasible",
            Self::Invalid => "invalid",
        }
    }
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

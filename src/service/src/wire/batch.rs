//! Batches: many rows in, columns out.

use arrayvec::ArrayVec;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

use super::answer::MachineId;
use super::capped::Capped;
use super::limit::{ConstraintName, ElementName, Unchecked};
use super::machine_ref::MachineRef;
use super::request::Frame;

/// The working solution for many poses.
///
/// Rows stay text here and are read one by one: a bad one then spoils no other.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct IkBatchRequest<'a> {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// What the rows describe.
    #[serde(default)]
    pub frame: Frame,
    /// Distance from P to the tool's tip, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm; only in frame `part`. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Rows `[x, y, z, phi1, phi2]` in frame `part`, `[x, y, z]` in the others. A row that cannot be read is
    /// answered as `invalid`.
    #[serde(borrow)]
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub poses: Capped<&'a RawValue>,
}

/// The working solution for many joint positions.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FkBatchRequest<'a> {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Distance from P to the tool's tip, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm; every row then needs theta1. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Rows `[rho1, rho2, rho3]` or `[rho1, rho2, rho3, theta1, theta2]`. A row that cannot be read is answered as
    /// `invalid`.
    #[serde(borrow)]
    #[schema(value_type = Vec<Option<Vec<Option<f64>>>>)]
    pub joints: Capped<&'a RawValue>,
}

/// Numbers of one row.
pub(crate) type Row = ArrayVec<f64, 5>;

/// An [`IkBatchRequest`] all of whose rows are numbers, as nearly always: they are read with the rest of the body,
/// which is several times as fast as finding their ends first.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct IkBatchNumbers {
    #[serde(default)]
    pub machine: MachineRef,
    #[serde(default)]
    pub frame: Frame,
    #[serde(default)]
    pub tool_length: f64,
    #[serde(default)]
    pub table_clearance: Option<f64>,
    #[serde(default)]
    pub tool_radius: f64,
    pub poses: Capped<Row>,
}

/// An [`FkBatchRequest`] all of whose rows are numbers.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FkBatchNumbers {
    #[serde(default)]
    pub machine: MachineRef,
    #[serde(default)]
    pub tool_length: f64,
    #[serde(default)]
    pub table_clearance: Option<f64>,
    #[serde(default)]
    pub tool_radius: f64,
    pub joints: Capped<Row>,
}

/// The rows of a batch.
#[derive(Debug)]
pub(crate) enum Rows<'a> {
    /// Every one was read.
    Read(Capped<Row>),
    /// At least one cannot be read; each is still text.
    Text(Capped<&'a RawValue>),
}

impl Rows<'_> {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Read(rows) => rows.len(),
            Self::Text(rows) => rows.len(),
        }
    }
}

/// Joints for every pose, in order.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct IkBatchAnswer {
    /// The machine.
    pub machine: MachineId,
    /// `[rho1, rho2, rho3]`, in frame `part` `[rho1, rho2, rho3, theta1, theta2]`; null where there are none. Joints
    /// that break a limit are answered, as `infeasible`. Of several working solutions the one is answered that the
    /// solver finds first, starting from a level platform, if it breaks no limit; else the one with the least alpha
    /// that breaks none; else the first.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub joints: Vec<Option<Row>>,
    /// How each row fares.
    #[serde(flatten)]
    pub report: RowReport,
}

/// Poses for all joints, in order.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct FkBatchAnswer {
    /// The machine.
    pub machine: MachineId,
    /// `[x, y, z, alpha]` of the platform in the base frame; null where there is none.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub poses: Vec<Option<Row>>,
    /// `[x, y, z, phi1, phi2]` of the tool in the table frame, for rows that give theta1 and theta2.
    #[schema(value_type = Vec<Option<Vec<f64>>>)]
    pub parts: Vec<Option<Row>>,
    /// How each row fares.
    #[serde(flatten)]
    pub report: RowReport,
}

/// How each row fares: columns as long as the batch, and their sums.
#[derive(Debug, Default, Serialize, ToSchema)]
pub(crate) struct RowReport {
    /// Status of each row.
    pub status: Vec<Status>,
    /// The worst violated constraint of each row that is not `ok`; null for `ok` and `invalid`.
    pub constraint: Vec<Option<ConstraintName>>,
    /// Its margin: negative, in the constraint's unit (mm, degrees or a pure number).
    pub margin: Vec<Option<f64>>,
    /// The part of the machine it belongs to, such as `slider2.max`.
    #[schema(value_type = Vec<Option<String>>)]
    pub element: Vec<Option<ElementName>>,
    /// How many rows have each status.
    pub counts: Counts,
    /// What was not checked, of at least one row.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// What is wrong with the invalid rows: the first hundred.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<RowError>,
}

/// Status of a row: `ok`; `unreachable`, no solution in the working mode; `infeasible`, solved, but breaks a limit;
/// `invalid`, cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Status {
    /// Solved, within every limit.
    Ok,
    /// No solution in the working mode.
    Unreachable,
    /// Solved, but breaks a limit.
    Infeasible,
    /// The row cannot be read.
    Invalid,
}

/// How many rows have each status.
#[derive(Clone, Copy, Debug, Default, Serialize, ToSchema)]
pub(crate) struct Counts {
    /// Solved, within every limit.
    pub ok: usize,
    /// No solution in the working mode.
    pub unreachable: usize,
    /// Solved, but break a limit.
    pub infeasible: usize,
    /// Cannot be read.
    pub invalid: usize,
}

/// What is wrong with a row.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct RowError {
    /// The row, from 0.
    pub row: usize,
    /// What is wrong, and what would be accepted.
    pub detail: String,
}

//! The rows of a batch: reading the numbers of a row, the outcome of a row, and the columns of the answer.

use arrayvec::ArrayVec;
use serde_json::value::RawValue;
use verne_solver::{Clearance, KinematicsError, MAX_INPUT, Machine, Margin, Margins, Posture, TableAngles};

use crate::operations::solutions::self_motion_margin;
use crate::wire::batch::{Counts, Row, RowError, RowReport, Status};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, LARGEST_ANGLE, is_angle, is_length, too_far};
use crate::wire::jacobian::{JacobianColumns, check_jacobian};
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::tool::Tool;

/// Least rows of one task on the compute pool: enough to outweigh the cost of handing them over. A multiple of the rows
/// that the solver computes at once.
pub(crate) const MIN_CHUNK: usize = 64;

/// Rows of one task that answers them by column.
pub(crate) const BLOCK_OF_COLUMNS: usize = 512;

/// About the bytes of an answered row.
pub(crate) const ROW_BYTES: usize = 208;

/// How many numbers a row with a tool axis has: `[x, y, z, i, j, k]`.
pub(crate) const ROW_WITH_AXIS: usize = 6;

/// Most invalid rows whose errors are explained.
pub(crate) const MAX_EXPLAINED: usize = 100;

/// The outcome of a row.
#[derive(Debug)]
pub(crate) enum RowOutcome {
    /// The solution keeps every limit: the worst margin.
    Ok(Margin),
    /// No solution: the margin names the constraint that prevents it.
    Unreachable(Margin),
    /// The solution breaks a limit: the worst margin.
    Infeasible(Margin),
    /// The row cannot be used: the reason.
    Invalid(String),
}

impl RowOutcome {
    /// The outcome of a row with a solution, from its worst margin.
    pub(crate) fn of_worst(worst: Margin, feasible: bool) -> Self {
        if feasible { Self::Ok(worst) } else { Self::Infeasible(worst) }
    }

    /// The status.
    pub(crate) fn status(&self) -> Status {
        match self {
            Self::Ok(_) => Status::Ok,
            Self::Unreachable(_) => Status::Unreachable,
            Self::Infeasible(_) => Status::Infeasible,
            Self::Invalid(_) => Status::Invalid,
        }
    }

    /// The margin.
    pub(crate) fn margin(&self) -> Option<Margin> {
        match self {
            Self::Ok(margin) | Self::Unreachable(margin) | Self::Infeasible(margin) => Some(*margin),
            Self::Invalid(_) => None,
        }
    }

    /// Why the row cannot be used.
    pub(crate) fn detail(&self) -> Option<&str> {
        match self {
            Self::Invalid(detail) => Some(detail),
            _ => None,
        }
    }
}

/// The numbers that a row may have. The first three numbers are lengths in mm; one or two more are angles in degrees,
/// three more a direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowFormat {
    /// The accepted lengths of a row.
    pub(crate) lengths: &'static [usize],
    /// The accepted rows in words.
    pub(crate) description: &'static str,
}

impl RowFormat {
    fn expected(self) -> String {
        format!("expected {}", self.description)
    }

    /// The row if its numbers and its length are accepted.
    fn checked(self, row: Row) -> Result<Row, String> {
        let has_direction = row.len() == ROW_WITH_AXIS;
        let fault =
            row.iter().enumerate().find_map(|(i, &number)| Some((i, fault_of(i, number, has_direction)?)));
        if let Some((i, fault)) = fault {
            return Err(format!("item {i} {fault}"));
        }
        if self.lengths.contains(&row.len()) { Ok(row) } else { Err(self.expected()) }
    }
}

/// A row of a batch in either form: as numbers, or as JSON text that is still to be read.
pub(crate) trait BatchRow: Sync {
    /// The numbers of the row, or the reason why they cannot be used.
    fn numbers(&self, format: RowFormat) -> Result<Row, String>;
}

impl BatchRow for Row {
    fn numbers(&self, format: RowFormat) -> Result<Row, String> {
        format.checked(self.clone())
    }
}

impl BatchRow for &RawValue {
    fn numbers(&self, format: RowFormat) -> Result<Row, String> {
        let items = self.get().strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        let mut row: Row = ArrayVec::new();
        let mut rest = Some(items.ok_or_else(|| format.expected())?);
        while let Some(text) = rest {
            let i = row.len();
            let item;
            (item, rest) = first_item(text);
            // The text is JSON already, so what parses here is a JSON number.
            let number: f64 = item
                .trim_ascii()
                .parse()
                .map_err(|_| format!("item {i} is not a number; {}", format.expected()))?;
            row.try_push(number).map_err(|_| format.expected())?;
        }
        format.checked(row)
    }
}

/// Why number i of a row cannot be used, if it cannot.
pub(crate) fn fault_of(i: usize, number: f64, has_direction: bool) -> Option<String> {
    if i >= 3 && has_direction {
        return (!number.is_finite()).then(|| "must be a finite number".to_owned());
    }
    if i < 3 && !is_length(number) {
        return Some(format!("must be within ±{MAX_INPUT:e} mm"));
    }
    (i >= 3 && !is_angle(number)).then(|| format!("must be within ±{LARGEST_ANGLE} degrees"))
}

/// The text up to the first comma, and the text after it. Items are short: the standard library's search is made for
/// long texts and takes more time.
fn first_item(text: &str) -> (&str, Option<&str>) {
    match text.bytes().position(|byte| byte == b',') {
        Some(at) => (&text[..at], Some(&text[at + 1..])),
        None => (text, None),
    }
}

/// The outcome of a row with a solution.
pub(crate) fn outcome_of_solution(
    machine: &Machine,
    posture: &Posture,
    table: Option<TableAngles>,
    clearance: Option<&Clearance>,
) -> RowOutcome {
    let margins = Margins::above_table(machine, posture, table, clearance);
    RowOutcome::of_worst(margins.worst(machine), margins.feasible())
}

/// The outcome of a row without a solution.
pub(crate) fn outcome_of_refusal(machine: &Machine, refusal: KinematicsError) -> RowOutcome {
    match refusal {
        KinematicsError::Unreachable(margin) => RowOutcome::Unreachable(margin),
        KinematicsError::SelfMotion => RowOutcome::Unreachable(self_motion_margin(machine)),
        KinematicsError::OutOfDomain => RowOutcome::Invalid("the numbers together are too large".to_owned()),
        KinematicsError::OutOfProportion => {
            RowOutcome::Invalid(format!("the row's lengths {}", too_far(machine)))
        }
    }
}

/// The columns of the answer. `table_checked` states whether the table was checked for every row.
pub(crate) fn row_report(
    outcomes: impl ExactSizeIterator<Item = RowOutcome>,
    table_checked: bool,
) -> RowReport {
    let rows = outcomes.len();
    let mut report = RowReport {
        status: Vec::with_capacity(rows),
        constraint: Vec::with_capacity(rows),
        margin: Vec::with_capacity(rows),
        element: Vec::with_capacity(rows),
        not_checked: Unchecked::beside(table_checked),
        ..RowReport::default()
    };
    for (row, outcome) in outcomes.enumerate() {
        let status = outcome.status();
        count(&mut report.counts, status);
        let limit = outcome.margin().map(Limit::from);
        if let RowOutcome::Invalid(detail) = outcome
            && report.errors.len() < MAX_EXPLAINED
        {
            report.errors.push(RowError { row, detail });
        }
        report.status.push(status);
        report.constraint.push(limit.as_ref().map(|limit| limit.constraint));
        report.margin.push(limit.as_ref().map(|limit| limit.value));
        report.element.push(limit.map(|limit| limit.element));
    }
    report
}

fn count(counts: &mut Counts, status: Status) {
    match status {
        Status::Ok => counts.ok += 1,
        Status::Unreachable => counts.unreachable += 1,
        Status::Infeasible => counts.infeasible += 1,
        Status::Invalid => counts.invalid += 1,
    }
}

/// Checks what all rows share. `without_theta1` is the reason why no row has theta1, if none has.
pub(crate) fn check_batch(
    tool: Tool,
    (jacobian, characteristic_length): (Option<JacobianColumns>, Option<f64>),
    without_theta1: Option<&str>,
    (rows, max_rows): (usize, usize),
) -> Result<(), OperationError> {
    if rows > max_rows {
        return Err(OperationError::TooManyRows { rows, limit: max_rows });
    }
    let mut faults = FieldErrors::default();
    tool.check(without_theta1, &mut faults);
    check_jacobian(jacobian.is_some(), characteristic_length, without_theta1, &mut faults);
    faults.into_result()
}

//! What both batches share: reading a row, judging it, and turning rows into columns.

use arrayvec::ArrayVec;
use serde_json::value::RawValue;
use verne_solver::{Clearance, KinematicsError, MAX_INPUT, Machine, Margin, Margins, Posture, TableAngles};

use crate::operations::solutions::unheld;
use crate::wire::batch::{Counts, Row, RowError, RowReport, Rows, Status};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, LARGEST_ANGLE, is_angle, is_length, too_far};
use crate::wire::limit::{Limit, Unchecked};

/// Rows that one task takes at least: enough to outweigh the cost of handing them over.
pub(crate) const CHUNK: usize = 64;

/// About the bytes of an answered row.
pub(crate) const ROW_BYTES: usize = 192;

/// How many bad rows are explained.
pub(crate) const EXPLAINED: usize = 100;

/// How one row fares.
#[derive(Debug)]
pub(crate) enum Verdict {
    Ok,
    Unreachable(Margin),
    Infeasible(Margin),
    Invalid(String),
}

/// What a row may hold, and how that is said: the last two of five numbers are angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) lengths: &'static [usize],
    pub(crate) words: &'static str,
}

impl Shape {
    /// One of the rows, or what is wrong with it.
    pub(crate) fn row(self, rows: &Rows<'_>, i: usize) -> Result<Row, String> {
        let row = match rows {
            Rows::Read(rows) => {
                let row = &rows.kept()[i];
                check(row).map(|()| row.clone())
            }
            Rows::Text(rows) => self.read(rows.kept()[i]),
        }?;
        if self.lengths.contains(&row.len()) { Ok(row) } else { Err(self.expected()) }
    }

    fn expected(self) -> String {
        format!("expected {}", self.words)
    }

    fn read(self, text: &RawValue) -> Result<Row, String> {
        let bare = text.get().strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        let mut row: Row = ArrayVec::new();
        let mut rest = Some(bare.ok_or_else(|| self.expected())?);
        while let Some(text) = rest {
            let i = row.len();
            let item;
            (item, rest) = first_item(text);
            // The text is JSON already, so what parses here is a JSON number.
            let number: f64 = item
                .trim_ascii()
                .parse()
                .map_err(|_| format!("item {i} is not a number; expected {}", self.words))?;
            check_item(i, number)?;
            row.try_push(number).map_err(|_| self.expected())?;
        }
        Ok(row)
    }
}

fn check(row: &Row) -> Result<(), String> {
    row.iter().enumerate().try_for_each(|(i, &number)| check_item(i, number))
}

fn check_item(i: usize, number: f64) -> Result<(), String> {
    if i < 3 && !is_length(number) {
        return Err(format!("item {i} must be within ±{MAX_INPUT:e} mm"));
    }
    if i >= 3 && !is_angle(number) {
        return Err(format!("item {i} must be within ±{LARGEST_ANGLE} degrees"));
    }
    Ok(())
}

/// The text up to the first comma, and what follows it. Items are short: the standard library's search, made for long
/// texts, takes longer.
fn first_item(text: &str) -> (&str, Option<&str>) {
    match text.bytes().position(|byte| byte == b',') {
        Some(at) => (&text[..at], Some(&text[at + 1..])),
        None => (text, None),
    }
}

/// Judges a solved row by its margins.
pub(crate) fn judge(
    machine: &Machine,
    posture: &Posture,
    table: Option<TableAngles>,
    clearance: Option<&Clearance>,
) -> Verdict {
    let margins = Margins::above_table(machine, posture, table, clearance);
    if margins.feasible() { Verdict::Ok } else { Verdict::Infeasible(margins.worst(machine)) }
}

/// Judges a row without solution.
pub(crate) fn refuse(machine: &Machine, refusal: KinematicsError) -> Verdict {
    match refusal {
        KinematicsError::Unreachable(margin) => Verdict::Unreachable(margin),
        KinematicsError::SelfMotion => Verdict::Unreachable(unheld(machine)),
        KinematicsError::OutOfDomain => Verdict::Invalid("the numbers together are too large".to_owned()),
        KinematicsError::OutOfProportion => {
            Verdict::Invalid(format!("the row's lengths {}", too_far(machine)))
        }
    }
}

/// Turns verdicts into columns; says whether the table was checked of every row.
pub(crate) fn report(verdicts: impl ExactSizeIterator<Item = Verdict>, table_checked: bool) -> RowReport {
    let rows = verdicts.len();
    let mut report = RowReport {
        status: Vec::with_capacity(rows),
        constraint: Vec::with_capacity(rows),
        margin: Vec::with_capacity(rows),
        element: Vec::with_capacity(rows),
        not_checked: Unchecked::beside(table_checked),
        ..RowReport::default()
    };
    for (row, verdict) in verdicts.enumerate() {
        let (status, margin) = match verdict {
            Verdict::Ok => (Status::Ok, None),
            Verdict::Unreachable(margin) => (Status::Unreachable, Some(margin)),
            Verdict::Infeasible(margin) => (Status::Infeasible, Some(margin)),
            Verdict::Invalid(detail) => {
                if report.errors.len() < EXPLAINED {
                    report.errors.push(RowError { row, detail });
                }
                (Status::Invalid, None)
            }
        };
        count(&mut report.counts, status);
        let limit = margin.map(Limit::from);
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

/// A tool and the clearance over the table, as all rows of a batch have them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shared {
    pub(crate) tool_length: f64,
    pub(crate) table_clearance: Option<f64>,
    pub(crate) tool_radius: f64,
}

impl Shared {
    /// The clearance that is checked.
    pub(crate) fn clearance(self, machine: &Machine) -> Option<Clearance> {
        Clearance::of(machine, self.table_clearance, self.tool_length, self.tool_radius)
    }
}

/// Checks what all rows share; `lacking` is why they have no theta1, where none has.
pub(crate) fn check_batch(
    shared: Shared,
    lacking: Option<&str>,
    rows: usize,
    limit: usize,
) -> Result<(), OperationError> {
    if rows > limit {
        return Err(OperationError::TooManyRows { rows, limit });
    }
    let mut faults = FieldErrors::default();
    faults.tool_length(shared.tool_length);
    faults.clearance(shared.table_clearance, shared.tool_radius, lacking);
    faults.into_result()
}

//! `/workspace/contains`: which points belong to a workspace.

use rayon::prelude::*;
use verne_solver::Point;
use verne_solver::workspace::{Membership, Observer, Request, contains};

use crate::operations::batch_rows::{BatchRow, MAX_EXPLAINED, MIN_CHUNK, RowFormat};
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::solver_errors::workspace_error;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::batch::RowError;
use crate::wire::contains::{ContainsAnswer, ContainsCounts, ContainsRequest};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, out_of_proportion};
use crate::wire::json::write_json;
use crate::wire::limit::Limit;
use crate::wire::parse::parse_body;
use crate::wire::workspace::WorkspaceRequest;

/// About the bytes of an answered point.
const POINT_BYTES: usize = 96;

/// A point as a row.
const POINT: RowFormat = RowFormat { lengths: &[3], description: "[x, y, z]" };

/// Answers a batch of points: from the JSON of the request to the JSON of the answer. Call it on the compute pool.
pub(crate) fn answer_contains(
    body: &[u8],
    machines: &MachineRegistry,
    max_rows: usize,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let request: ContainsRequest<'_> = parse_body(body)?;
    let rows = request.points.len();
    if rows > max_rows {
        return Err(OperationError::TooManyRows { rows, limit: max_rows });
    }
    let batch = PointBatch::new(&request.workspace(), machines)?;
    let points = batch.answer(request.points.items(), observer)?;
    let mut answer = ContainsAnswer::with_capacity(&batch.question, rows);
    for point in points {
        match point {
            Ok(membership) => answer.add(membership),
            Err(detail) => answer.add_invalid(detail),
        }
    }
    write_json(&answer, POINT_BYTES * rows)
}

/// What all points share.
pub(crate) struct PointBatch {
    pub(crate) question: WorkspaceQuestion,
}

impl PointBatch {
    /// Checks what all points share.
    pub(crate) fn new(
        request: &WorkspaceRequest,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        let question = WorkspaceQuestion::new(request, machines)?;
        let mut faults = FieldErrors::default();
        let tool_length = question.request.tool_length.unwrap_or_default();
        faults.proportion("/tool_length", tool_length, &question.machine);
        faults.into_result()?;
        Ok(Self { question })
    }

    /// Answers some points; for a malformed one, why it cannot be used.
    pub(crate) fn answer<R: BatchRow>(
        &self,
        rows: &[R],
        observer: &dyn Observer,
    ) -> Result<Vec<Result<Membership, String>>, OperationError> {
        let machine = &*self.question.machine;
        let points = rows.par_iter().with_min_len(MIN_CHUNK).map(|row| {
            let row = row.numbers(POINT)?;
            let fault = row.iter().find_map(|&length| out_of_proportion(length, machine));
            fault.map_or(Ok([row[0], row[1], row[2]]), |fault| Err(format!("each coordinate {fault}")))
        });
        let points: Vec<Result<Point, String>> = points.collect();
        let valid: Vec<Point> = points.iter().flatten().copied().collect();
        let found = contains(machine, &Request::from(&self.question.request), &valid, observer);
        let mut memberships = found.map_err(workspace_error)?.into_iter();
        let mut answered = |_| memberships.next().ok_or(OperationError::Internal);
        points
            .into_iter()
            .map(|point| point.map_or_else(|detail| Ok(Err(detail)), |point| answered(point).map(Ok)))
            .collect()
    }
}

impl ContainsAnswer {
    fn with_capacity(question: &WorkspaceQuestion, points: usize) -> Self {
        Self {
            machine: question.machine.id.clone(),
            inside: Vec::with_capacity(points),
            margin: Vec::with_capacity(points),
            unit: Vec::with_capacity(points),
            constraint: Vec::with_capacity(points),
            element: Vec::with_capacity(points),
            counts: ContainsCounts::default(),
            not_checked: question.request.not_checked(),
            errors: Vec::new(),
        }
    }

    fn add(&mut self, membership: Membership) {
        *(if membership.inside { &mut self.counts.inside } else { &mut self.counts.outside }) += 1;
        self.push(Some(membership.inside), membership.margin.map(Limit::from));
    }

    fn add_invalid(&mut self, detail: String) {
        if self.errors.len() < MAX_EXPLAINED {
            self.errors.push(RowError { row: self.inside.len(), detail });
        }
        self.counts.invalid += 1;
        self.push(None, None);
    }

    fn push(&mut self, inside: Option<bool>, limit: Option<Limit>) {
        self.inside.push(inside);
        self.margin.push(limit.as_ref().map(|limit| limit.value));
        self.unit.push(limit.as_ref().map(|limit| limit.unit));
        self.constraint.push(limit.as_ref().map(|limit| limit.constraint));
        self.element.push(limit.map(|limit| limit.element));
    }
}

//! `/workspace/contains`: which points belong to a workspace.

use rayon::prelude::*;
use verne_solver::Point;
use verne_solver::workspace::{Membership, Observer, Request, contains};

use crate::operations::batch_rows::{CHUNK, EXPLAINED, Shape};
use crate::operations::registry::Registry;
use crate::operations::workspace_question::{WorkspaceQuestion, workspace_error};
use crate::wire::batch::{RowError, Rows};
use crate::wire::contains::{ContainsAnswer, ContainsCounts, ContainsRequest};
use crate::wire::error::OperationError;
use crate::wire::field_errors::{FieldErrors, out_of_proportion};
use crate::wire::json::write_json;
use crate::wire::limit::Limit;
use crate::wire::parse::parse_body;
use crate::wire::workspace::WorkspaceRequest;

/// Membership needs no tolerance; any one that is allowed will do.
const COARSE: f64 = 1000.0;

/// About the bytes of an answered point.
const POINT_BYTES: usize = 96;

/// Answers a batch of points, from its body to the answer's; to be called on the worker threads.
pub(crate) fn answer_contains(
    body: &[u8],
    machines: &Registry,
    most_rows: usize,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let asked: ContainsRequest<'_> = parse_body(body)?;
    let (rows, limit) = (asked.points.len(), most_rows);
    if rows > limit {
        return Err(OperationError::TooManyRows { rows, limit });
    }
    let ContainsRequest { machine, kind, tool_length, table_clearance, tool_radius, phi1, phi2, points } =
        asked;
    let tolerance = COARSE;
    let whole =
        WorkspaceRequest { machine, kind, tool_length, table_clearance, tool_radius, phi1, phi2, tolerance };
    let question = WorkspaceQuestion::new(&whole, machines)?;
    let machine = &question.published.machine;
    let mut faults = FieldErrors::default();
    faults.proportion("/tool_length", question.request.tool_length.unwrap_or_default(), machine);
    faults.into_result()?;
    let (shape, points) = (Shape { lengths: &[3], words: "[x, y, z]" }, Rows::Text(points));
    let read: Vec<Result<Point, String>> = (0..rows)
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(|i| {
            let row = shape.row(&points, i)?;
            let fault = row.iter().find_map(|&length| out_of_proportion(length, machine));
            fault.map_or(Ok([row[0], row[1], row[2]]), |fault| Err(format!("each coordinate {fault}")))
        })
        .collect();
    let good: Vec<Point> = read.iter().flatten().copied().collect();
    let request = Request::from(&question.request);
    let found = contains(machine, &request, &good, observer).map_err(workspace_error)?;
    let mut answer = ContainsAnswer::with_room(&question, rows);
    let mut found = found.into_iter();
    for point in read {
        match point {
            Ok(_) => answer.add(found.next().ok_or(OperationError::Internal)?),
            Err(detail) => answer.add_invalid(detail),
        }
    }
    write_json(&answer, POINT_BYTES * rows)
}

impl ContainsAnswer {
    fn with_room(question: &WorkspaceQuestion, points: usize) -> Self {
        Self {
            machine: question.published.id.clone(),
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
        if self.errors.len() < EXPLAINED {
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

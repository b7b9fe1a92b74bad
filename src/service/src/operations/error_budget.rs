//! `/error-budget`: the errors of the tool at poses, for tolerances of the machine's parameters.

use serde_json::value::RawValue;
use verne_solver::error_budget::{ErrorBudget, ErrorFigure};
use verne_solver::parameter::{PARAMETERS, Parameter};
use verne_solver::workspace::{Observer, Unobserved};

use crate::operations::batch_rows::{BatchRow, row_report};
use crate::operations::error_budget_rows::{BudgetBatch, BudgetRow};
use crate::operations::machine_registry::MachineRegistry;
use crate::wire::batch::Row;
use crate::wire::degrees::to_degrees;
use crate::wire::error::OperationError;
use crate::wire::error_budget::{
    BudgetObject, ErrorBudgetAnswer, ErrorBudgetNumbers, ErrorBudgetRequest, FigureObject,
};
use crate::wire::fixed_array::FixedArray;
use crate::wire::json::write_json;
use crate::wire::parameter::to_wire;
use crate::wire::parse::{parse_body, parse_expected};

/// Most rows of an answer in JSON, which has all contributions. Rows in columns are not limited.
pub(crate) const MOST_BUDGETS: usize = 10_000;

/// About the bytes of an answered row.
const ROW_BYTES: usize = 3072;

/// Answers a batch: from the JSON of the request to the JSON of the answer. Call it on the compute pool.
pub(crate) fn answer_error_budget(
    body: &[u8],
    machines: &MachineRegistry,
    max_rows: usize,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    // Nearly always every row is an array of numbers. Only another body is read row by row.
    match parse_expected::<ErrorBudgetNumbers>(body) {
        Some(request) => answer(&request, machines, max_rows, observer),
        None => answer(&parse_body::<ErrorBudgetRequest<&RawValue>>(body)?, machines, max_rows, observer),
    }
}

fn answer<R: BatchRow>(
    request: &ErrorBudgetRequest<R>,
    machines: &MachineRegistry,
    max_rows: usize,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let (rows, limit) = (request.poses.len(), max_rows.min(MOST_BUDGETS));
    if rows > limit {
        return Err(OperationError::TooManyRows { rows, limit });
    }
    let batch = BudgetBatch::new(request, machines)?;
    write_json(&answer_rows(&batch, request.poses.items(), observer)?, ROW_BYTES * rows)
}

/// The answer to one pose.
pub(crate) fn answer_one(
    request: &ErrorBudgetNumbers,
    pose: Row,
    machines: &MachineRegistry,
) -> Result<ErrorBudgetAnswer, OperationError> {
    answer_rows(&BudgetBatch::new(request, machines)?, &[pose], &Unobserved)
}

fn answer_rows<R: BatchRow>(
    batch: &BudgetBatch,
    rows: &[R],
    observer: &dyn Observer,
) -> Result<ErrorBudgetAnswer, OperationError> {
    let (mut joints, mut budgets, mut outcomes) = (Vec::new(), Vec::new(), Vec::new());
    let parameters = batch.each_parameter();
    for BudgetRow { joints: found, budget, outcome } in batch.answer(rows, observer)? {
        joints.push(found);
        budgets.push(budget.map(|budget| budget_object(&budget, &parameters)));
        outcomes.push(outcome);
    }
    Ok(ErrorBudgetAnswer {
        machine: batch.machine.id.clone(),
        parameters: batch.parameters(),
        joints,
        budgets,
        report: row_report(outcomes.into_iter(), batch.clearance.is_some()),
    })
}

fn budget_object(budget: &ErrorBudget, parameters: &[Parameter]) -> BudgetObject {
    let exact = |changes: &[f64; PARAMETERS]| budget.exact(changes);
    let of_tip = exact(&budget.tip.worst_changes).map(|found| found.tip);
    let of_axis = exact(&budget.axis.worst_changes).map(|found| found.axis);
    BudgetObject {
        tip: figure(&budget.tip, of_tip, parameters, |length| length + 0.0),
        axis: figure(&budget.axis, of_axis, parameters, to_degrees),
    }
}

fn figure(
    figure: &ErrorFigure,
    exact: Option<f64>,
    parameters: &[Parameter],
    unit: fn(f64) -> f64,
) -> FigureObject {
    let changes = parameters.iter().map(|of| to_wire(of.unit(), figure.worst_changes[of.index()]));
    FigureObject {
        rms: unit(figure.rms),
        standard_deviations: FixedArray(figure.standard_deviations.map(unit)),
        worst: unit(figure.worst),
        worst_exact: exact.map(unit),
        worst_changes: changes.collect(),
        contributions: parameters.iter().map(|of| unit(figure.contributions[of.index()])).collect(),
    }
}

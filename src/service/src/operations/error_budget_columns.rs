//! `/error-budget` with rows in columns.

use verne_rows::{Chunk, Column};
use verne_solver::error_budget::ErrorBudget;
use verne_solver::workspace::Observer;

use crate::operations::column_rows::{Group, RowColumns, RowNames};
use crate::operations::error_budget_rows::{BudgetBatch, BudgetRow};
use crate::operations::inverse_columns::{JOINTS, NUMBERS, pose_names};
use crate::operations::inverse_rows::numbers_of_answer;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::outcome_columns::{OutcomeColumns, number_columns};
use crate::operations::row_stream::RowAnswer;
use crate::operations::row_tally::RowTally;
use crate::wire::degrees::to_degrees;
use crate::wire::error::OperationError;
use crate::wire::error_budget::ErrorBudgetNumbers;

/// The errors of a row, by name.
type ErrorColumn = (&'static str, fn(&ErrorBudget) -> Option<f64>);

/// The columns of errors.
const ERRORS: [ErrorColumn; 6] = [
    ("tip_rms", |budget| Some(budget.tip.rms)),
    ("tip_worst", |budget| Some(budget.tip.worst)),
    ("tip_worst_exact", |budget| Some(budget.exact(&budget.tip.worst_changes)?.tip)),
    ("axis_rms", |budget| Some(to_degrees(budget.axis.rms))),
    ("axis_worst", |budget| Some(to_degrees(budget.axis.worst))),
    ("axis_worst_exact", |budget| Some(to_degrees(budget.exact(&budget.axis.worst_changes)?.axis))),
];

/// Answers poses with their errors.
pub(crate) struct ErrorBudgetColumns {
    batch: BudgetBatch,
    outcomes: OutcomeColumns,
    names: RowNames,
}

impl ErrorBudgetColumns {
    /// Checks the request, which has no rows.
    pub(crate) fn new(
        request: &ErrorBudgetNumbers,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        let batch = BudgetBatch::new(request, machines)?;
        Ok(Self { batch, outcomes: OutcomeColumns::new()?, names: RowNames::new() })
    }
}

impl RowAnswer for ErrorBudgetColumns {
    fn numbers(&self) -> Group {
        NUMBERS
    }

    fn begin(&mut self, columns: &[Column]) -> Result<(), OperationError> {
        self.names = pose_names(self.batch.frame, columns)?;
        Ok(())
    }

    fn answer(&mut self, chunk: &Chunk, observer: &dyn Observer) -> Result<Vec<Column>, OperationError> {
        let rows = RowColumns::of(chunk, &self.names)?;
        let answered = self.batch.answer(&rows.rows(), observer)?;
        let joints: Vec<_> = answered.iter().map(|row| row.joints.as_ref()).collect();
        let mut columns: Vec<_> =
            number_columns(&JOINTS[..numbers_of_answer(self.batch.frame)], &joints).collect();
        for (name, error) in ERRORS {
            columns.push(Column::numbers(name, answered.iter().map(|row| error(row.budget.as_ref()?))));
        }
        let outcomes: Vec<_> = answered.into_iter().map(|BudgetRow { outcome, .. }| outcome).collect();
        columns.extend(self.outcomes.of(chunk, &outcomes)?);
        Ok(columns)
    }

    fn tally(&self) -> &RowTally {
        self.outcomes.tally()
    }

    fn machine(&self) -> &IdentifiedMachine {
        &self.batch.machine
    }
}

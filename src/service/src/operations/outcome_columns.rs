//! The outcomes of rows as columns.

use verne_rows::{Chunk, Column, Names, WriteError};
use verne_solver::Margin;

use crate::operations::batch_rows::RowOutcome;
use crate::operations::column_rows::pointer;
use crate::operations::row_tally::RowTally;
use crate::wire::batch::{Row, Status};
use crate::wire::constraint::{ConstraintName, ElementName};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::limit::Limit;

/// The words of the columns of outcomes, which every chunk of an answer shares, and the outcomes so far.
#[derive(Debug)]
pub(crate) struct OutcomeColumns {
    statuses: Names,
    limits: LimitColumns,
    tally: RowTally,
}

/// The constraint, the margin in its unit, and the part of the machine.
type SentLimit = (ConstraintName, f64, ElementName);

/// The words of the columns of limits.
#[derive(Debug)]
pub(crate) struct LimitColumns {
    constraints: Names,
    elements: Names,
}

impl OutcomeColumns {
    pub(crate) fn new() -> Result<Self, OperationError> {
        let statuses = Status::ALL.map(Status::name);
        Ok(Self {
            statuses: Names::new(&statuses).map_err(defect)?,
            limits: LimitColumns::new()?,
            tally: RowTally::new(&statuses),
        })
    }

    /// The columns `status`, `constraint`, `margin`, `element` and `detail` of the rows of a chunk.
    pub(crate) fn of(
        &mut self,
        chunk: &Chunk,
        outcomes: &[RowOutcome],
    ) -> Result<Vec<Column>, OperationError> {
        self.tally.add_outcomes(chunk, outcomes);
        let status = outcomes.iter().map(|outcome| code(Some(outcome.status() as usize))).collect();
        let mut columns = vec![Column::names_by_code("status", &self.statuses, status).map_err(defect)?];
        columns.extend(self.limits.of(outcomes.iter().map(RowOutcome::margin))?);
        let details = outcomes.iter().enumerate();
        let details: Vec<_> = details.filter_map(|(i, outcome)| Some((i, outcome.detail()?))).collect();
        columns.push(Column::few_texts("detail", outcomes.len(), &details));
        Ok(columns)
    }

    /// The outcomes so far.
    pub(crate) fn tally(&self) -> &RowTally {
        &self.tally
    }
}

impl LimitColumns {
    pub(crate) fn new() -> Result<Self, OperationError> {
        Ok(Self {
            constraints: Names::new(&ConstraintName::all()).map_err(defect)?,
            elements: Names::new(&ElementName::all()).map_err(defect)?,
        })
    }

    /// The columns `constraint`, `margin` and `element`.
    pub(crate) fn of(
        &self,
        margins: impl ExactSizeIterator<Item = Option<Margin>>,
    ) -> Result<[Column; 3], OperationError> {
        let limits = margins.map(|margin| margin.map(Limit::from));
        self.of_limits(limits.map(|limit| limit.map(|limit| (limit.constraint, limit.value, limit.element))))
    }

    /// The same for limits as they are sent.
    pub(crate) fn of_limits(
        &self,
        limits: impl ExactSizeIterator<Item = Option<SentLimit>>,
    ) -> Result<[Column; 3], OperationError> {
        let rows = limits.len();
        let (mut constraints, mut elements) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let (mut margins, mut has_margin) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        for limit in limits {
            constraints.push(code(limit.map(|limit| limit.0.code())));
            elements.push(code(limit.and_then(|limit| limit.2.code())));
            margins.push(limit.map_or(0.0, |limit| limit.1));
            has_margin.push(limit.is_some());
        }
        Ok([
            Column::names_by_code("constraint", &self.constraints, constraints).map_err(defect)?,
            Column::numbers_where("margin", margins, &has_margin).map_err(defect)?,
            Column::names_by_code("element", &self.elements, elements).map_err(defect)?,
        ])
    }
}

/// A column for each number of the rows; a row that has no such number has no value.
pub(crate) fn number_columns<'a>(
    names: &'a [&'static str],
    rows: &'a [Option<&'a Row>],
) -> impl Iterator<Item = Column> + 'a {
    let column = |(i, name): (usize, &&str)| {
        Column::numbers(name, rows.iter().map(move |row| row.and_then(|row| row.get(i).copied())))
    };
    names.iter().enumerate().map(column)
}

/// The code of a name in a column; negative for no name.
fn code(code: Option<usize>) -> i8 {
    code.and_then(|code| i8::try_from(code).ok()).unwrap_or(-1)
}

/// Why the columns of a request cannot be passed on.
pub(crate) fn write_error(error: WriteError) -> OperationError {
    match error {
        WriteError::NoText { name, kind } => {
            let detail = format!("has the type {kind}: only an answer in Arrow can have it");
            OperationError::Fields(vec![FieldError::new(pointer(&name), detail)])
        }
        WriteError::TooLong(_) => OperationError::Rows(error.to_string()),
        WriteError::Twice(_) | WriteError::Columns(_) => defect(error),
    }
}

/// Columns of the service's own do not fit together.
#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
pub(crate) fn defect(error: WriteError) -> OperationError {
    tracing::error!(%error, "cannot make the columns of an answer");
    OperationError::Internal
}

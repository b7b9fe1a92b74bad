//! The outcomes of rows as columns.

use verne_rows::{Chunk, Column, Names, WriteError};
use verne_solver::Margin;

use crate::operations::batch_rows::RowOutcome;
use crate::operations::column_rows::pointer;
use crate::operations::row_tally::{Reason, RowTally};
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
        outcomes: &[&RowOutcome],
    ) -> Result<Vec<Column>, OperationError> {
        let counted = outcomes.iter().map(|outcome| (outcome.status() as usize, Reason::of(outcome)));
        self.tally.add(chunk, counted);
        let status = outcomes.iter().map(|outcome| code(outcome.status() as usize));
        let mut columns = vec![Column::names("status", &self.statuses, status).map_err(defect)?];
        let margins: Vec<_> = outcomes.iter().map(|outcome| outcome.margin()).collect();
        columns.extend(self.limits.of(&margins)?);
        columns.push(Column::texts("detail", outcomes.iter().map(|outcome| outcome.detail())));
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
    pub(crate) fn of(&self, margins: &[Option<Margin>]) -> Result<[Column; 3], OperationError> {
        let limits = margins.iter().map(|margin| margin.map(Limit::from));
        let limits = limits.map(|limit| limit.map(|limit| (limit.constraint, limit.value, limit.element)));
        self.of_limits(&limits.collect::<Vec<_>>())
    }

    /// The same for limits as they are sent.
    pub(crate) fn of_limits(&self, limits: &[Option<SentLimit>]) -> Result<[Column; 3], OperationError> {
        let constraints = limits.iter().map(|limit| code((*limit)?.0.code()));
        let elements = limits.iter().map(|limit| code((*limit)?.2.code()?));
        Ok([
            Column::names("constraint", &self.constraints, constraints).map_err(defect)?,
            Column::numbers("margin", limits.iter().map(|limit| Some((*limit)?.1))),
            Column::names("element", &self.elements, elements).map_err(defect)?,
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

fn code(code: usize) -> Option<i8> {
    i8::try_from(code).ok()
}

/// Why the columns of a request cannot be passed on.
pub(crate) fn write_error(error: WriteError) -> OperationError {
    match error {
        WriteError::NoText { name, kind } => {
            let detail = format!("has the type {kind}: only an answer in Arrow can have it");
            OperationError::Fields(vec![FieldError::new(pointer(&name), detail)])
        }
        WriteError::Twice(name) => {
            let detail = "is the name of a column of the answer: rename the column, or leave it out";
            OperationError::Fields(vec![FieldError::new(pointer(&name), detail)])
        }
        WriteError::TooLong(_) => OperationError::Rows(error.to_string()),
        WriteError::Columns(_) => defect(error),
    }
}

/// Columns of the service's own do not fit together.
#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
pub(crate) fn defect(error: WriteError) -> OperationError {
    tracing::error!(%error, "cannot make the columns of an answer");
    OperationError::Internal
}

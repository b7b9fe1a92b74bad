//! `/workspace/contains` with points in columns.

use verne_rows::{Chunk, Column, Names};
use verne_solver::workspace::Observer;

use crate::operations::column_rows::{Group, RowColumns, row_names};
use crate::operations::contains::PointBatch;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::outcome_columns::{LimitColumns, defect};
use crate::operations::row_stream::RowAnswer;
use crate::operations::row_tally::{Reason, RowTally};
use crate::wire::constraint::Unit;
use crate::wire::error::OperationError;
use crate::wire::limit::Limit;
use crate::wire::workspace::WorkspaceRequest;

/// The columns of a point.
const POINT: Group = &["x", "y", "z"];

/// The outcomes of a point: [`INSIDE`] and the ones after it.
const OUTCOMES: [&str; 3] = ["inside", "outside", "invalid"];
const INSIDE: usize = 0;
const OUTSIDE: usize = 1;
const INVALID: usize = 2;

/// Answers points.
pub(crate) struct ContainsColumns {
    batch: PointBatch,
    limits: LimitColumns,
    units: Names,
    tally: RowTally,
}

impl ContainsColumns {
    /// Checks the request.
    pub(crate) fn new(
        request: &WorkspaceRequest,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        let units = Names::new(&Unit::ALL.map(Unit::name)).map_err(defect)?;
        Ok(Self {
            batch: PointBatch::new(request, machines)?,
            limits: LimitColumns::new()?,
            units,
            tally: RowTally::new(&OUTCOMES),
        })
    }
}

impl RowAnswer for ContainsColumns {
    fn numbers(&self) -> Group {
        POINT
    }

    fn begin(&mut self, columns: &[Column]) -> Result<(), OperationError> {
        row_names(columns, POINT, &[], false).map(drop)
    }

    fn answer(&mut self, chunk: &Chunk, observer: &dyn Observer) -> Result<Vec<Column>, OperationError> {
        let columns = RowColumns::of(chunk, POINT)?;
        let answered = self.batch.answer(&columns.rows(), observer)?;
        let counted = answered.iter().map(|point| match point {
            Ok(point) => (if point.inside { INSIDE } else { OUTSIDE }, None),
            Err(detail) => (INVALID, Some(Reason::Detail(detail.into()))),
        });
        self.tally.add(chunk, counted);
        let memberships: Vec<_> = answered.iter().map(|point| point.as_ref().ok()).collect();
        let margins: Vec<_> = memberships.iter().map(|point| point.and_then(|point| point.margin)).collect();
        let units = margins.iter().map(|margin| i8::try_from(Limit::from((*margin)?).unit as usize).ok());
        let mut columns =
            vec![Column::flags("inside", memberships.iter().map(|point| Some((*point)?.inside)))];
        columns.extend(self.limits.of(margins.iter().copied())?);
        columns.push(Column::names("unit", &self.units, units).map_err(defect)?);
        columns.push(Column::texts("detail", answered.iter().map(|point| point.as_ref().err())));
        Ok(columns)
    }

    fn tally(&self) -> &RowTally {
        &self.tally
    }

    fn machine(&self) -> &IdentifiedMachine {
        &self.batch.question.machine
    }
}

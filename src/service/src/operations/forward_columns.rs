//! `/fk/batch` with rows in columns.

use verne_rows::{Chunk, Column};
use verne_solver::workspace::Observer;

use crate::operations::column_rows::{Group, RowColumns, RowNames, row_names};
use crate::operations::forward_batch::JointBatch;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::outcome_columns::{OutcomeColumns, number_columns};
use crate::operations::row_stream::RowAnswer;
use crate::operations::row_tally::RowTally;
use crate::wire::batch::{FkBatchNumbers, Orientation};
use crate::wire::error::OperationError;

/// The columns that a row may have.
const NUMBERS: Group = &["rho1", "rho2", "rho3", "theta1", "theta2"];

/// The columns that every row has.
const SLIDERS: Group = &["rho1", "rho2", "rho3"];

/// The columns of the table.
const TABLE: &[Group] = &[&["theta1", "theta2"]];

/// The columns of the platform's pose in the base frame.
const PLATFORM: Group = &["platform_x", "platform_y", "platform_z", "alpha"];

/// Answers joints.
pub(crate) struct ForwardColumns {
    batch: JointBatch,
    outcomes: OutcomeColumns,
    names: RowNames,
}

impl ForwardColumns {
    /// Checks the request, which has no rows.
    pub(crate) fn new(request: &FkBatchNumbers, machines: &MachineRegistry) -> Result<Self, OperationError> {
        let batch = JointBatch::new(request, machines, 0)?;
        Ok(Self { batch, outcomes: OutcomeColumns::new()?, names: RowNames::new() })
    }

    /// The columns of the tool's pose in the part frame; without the angles of the table there is none.
    fn part(&self) -> Group {
        match self.batch.orientation {
            _ if self.names.len() == SLIDERS.len() => &[],
            Orientation::Rotary => &["x", "y", "z", "phi1", "phi2"],
            Orientation::Vector => &["x", "y", "z", "i", "j", "k"],
        }
    }
}

impl RowAnswer for ForwardColumns {
    fn numbers(&self) -> Group {
        NUMBERS
    }

    fn begin(&mut self, columns: &[Column]) -> Result<(), OperationError> {
        self.names = row_names(columns, SLIDERS, TABLE, self.batch.needs_table())?;
        Ok(())
    }

    fn answer(&mut self, chunk: &Chunk, _: &dyn Observer) -> Result<Vec<Column>, OperationError> {
        let rows = RowColumns::of(chunk, &self.names)?;
        let answered = self.batch.answer(&rows.rows());
        let poses: Vec<_> = answered.iter().map(|row| row.pose.as_ref()).collect();
        let parts: Vec<_> = answered.iter().map(|row| row.part.as_ref()).collect();
        let mut columns: Vec<_> = number_columns(PLATFORM, &poses).collect();
        columns.extend(number_columns(self.part(), &parts));
        if let Some(jacobians) = self.batch.jacobians {
            let found: Vec<_> = answered.iter().map(|row| row.jacobian.as_deref()).collect();
            columns.extend(jacobians.columns_of(&found));
        }
        let outcomes: Vec<_> = answered.into_iter().map(|row| row.outcome).collect();
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

//! `/ik/batch` with rows in columns.

use verne_rows::{Chunk, Column};
use verne_solver::workspace::Observer;

use crate::operations::column_rows::{Group, RowColumns, RowNames, refuse, row_names};
use crate::operations::inverse_batch::{AnsweredPoses, PoseBatch};
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::outcome_columns::{OutcomeColumns, defect};
use crate::operations::row_stream::RowAnswer;
use crate::operations::row_tally::RowTally;
use crate::wire::batch::IkBatchNumbers;
use crate::wire::error::OperationError;
use crate::wire::request::Frame;

/// The columns that a row may have.
pub(crate) const NUMBERS: Group = &["x", "y", "z", "phi1", "phi2", "i", "j", "k"];

/// The columns that every row has.
const POSITION: Group = &["x", "y", "z"];

/// The columns of an orientation.
const ORIENTATIONS: &[Group] = &[&["phi1", "phi2"], &["i", "j", "k"]];

/// The columns of joints; only frame `part` has the last two.
pub(crate) const JOINTS: Group = &["rho1", "rho2", "rho3", "theta1", "theta2"];

/// The columns of the rows in a frame, of those that there are.
pub(crate) fn pose_names(frame: Frame, columns: &[Column]) -> Result<RowNames, OperationError> {
    let has_orientation = frame == Frame::Part;
    if !has_orientation {
        refuse(columns, &NUMBERS[POSITION.len()..], "is allowed only in frame part")?;
    }
    row_names(columns, POSITION, ORIENTATIONS, has_orientation)
}

/// Answers poses.
pub(crate) struct InverseColumns {
    batch: PoseBatch,
    outcomes: OutcomeColumns,
    names: RowNames,
}

impl InverseColumns {
    /// Checks the request, which has no rows.
    pub(crate) fn new(request: &IkBatchNumbers, machines: &MachineRegistry) -> Result<Self, OperationError> {
        let batch = PoseBatch::new(request, machines, 0)?;
        Ok(Self { batch, outcomes: OutcomeColumns::new()?, names: RowNames::new() })
    }
}

impl RowAnswer for InverseColumns {
    fn numbers(&self) -> Group {
        NUMBERS
    }

    fn begin(&mut self, columns: &[Column]) -> Result<(), OperationError> {
        self.names = pose_names(self.batch.frame, columns)?;
        Ok(())
    }

    fn answer(&mut self, chunk: &Chunk, _: &dyn Observer) -> Result<Vec<Column>, OperationError> {
        let rows = RowColumns::of(chunk, &self.names)?;
        let AnsweredPoses { columns: answered, jumps } = self.batch.answer(&rows.rows());
        let jacobians = self.batch.jacobians.map(|jacobians| {
            let found: Vec<_> = answered.jacobians().collect();
            jacobians.columns_of(&found)
        });
        let (mut columns, outcomes) = answered.into_columns(JOINTS).map_err(defect)?;
        columns.extend(jacobians.into_iter().flatten());
        columns.extend(jumps.map(|jumps| Column::flags("jump", jumps)));
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

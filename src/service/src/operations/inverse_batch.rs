//! `/ik/batch`: the working solution for many poses.

use std::sync::Arc;

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::{Clearance, forward_working};

use crate::operations::answer_columns::AnswerColumns;
use crate::operations::batch_rows::{BLOCK_OF_COLUMNS, BatchRow, ROW_BYTES, check_batch, row_report};
use crate::operations::continuation::{Setting, Standing};
use crate::operations::continuous_rows::answer_continuous;
use crate::operations::inverse_rows::{PART_POSE, answer_rows, numbers_of_answer};
use crate::operations::jacobians::RowJacobians;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::table_angles::TablePosition;
use crate::wire::batch::{IkBatchAnswer, IkBatchNumbers, IkBatchRequest, RowReport};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::FieldErrors;
use crate::wire::json::write_json;
use crate::wire::parse::{parse_body, parse_expected};
use crate::wire::request::Frame;
use crate::wire::start::Start;

/// Answers a batch: from the JSON of the request to the JSON of the answer. Call it on the compute pool.
pub(crate) fn answer_ik_batch(
    body: &[u8],
    machines: &MachineRegistry,
    max_rows: usize,
) -> Result<Vec<u8>, OperationError> {
    // Nearly always every row is an array of numbers. Only another body is read row by row.
    match parse_expected::<IkBatchNumbers>(body) {
        Some(request) => answer(&request, machines, max_rows),
        None => answer(&parse_body::<IkBatchRequest<&RawValue>>(body)?, machines, max_rows),
    }
}

fn answer<R: BatchRow>(
    request: &IkBatchRequest<R>,
    machines: &MachineRegistry,
    max_rows: usize,
) -> Result<Vec<u8>, OperationError> {
    let mut batch = PoseBatch::new(request, machines, max_rows)?;
    let AnsweredPoses { columns, jumps } = batch.answer(request.poses.items());
    let mut answer = IkBatchAnswer {
        machine: batch.machine.id.clone(),
        joints: Vec::new(),
        jump: None,
        jumps: None,
        jacobian: None,
        report: RowReport::default(),
    };
    answer.jacobian = batch.jacobians.map(|jacobians| jacobians.lists(&columns.jacobians()));
    answer.jumps = jumps.as_ref().map(|jumps| jumps.iter().filter(|jump| **jump == Some(true)).count());
    answer.jump = jumps;
    let outcomes;
    (answer.joints, outcomes) = columns.into_rows();
    answer.report = row_report(outcomes.into_iter(), batch.clearance.is_some());
    write_json(&answer, ROW_BYTES * answer.joints.len())
}

/// The answers of poses.
pub(crate) struct AnsweredPoses {
    /// The joints, and the outcomes.
    pub(crate) columns: AnswerColumns,
    /// `jump` of each row; `None` if the batch is not continuous.
    pub(crate) jumps: Option<Vec<Option<bool>>>,
}

/// What all rows of a batch share, and where the machine stands after those that are answered.
pub(crate) struct PoseBatch {
    pub(crate) machine: Arc<IdentifiedMachine>,
    pub(crate) frame: Frame,
    tool_length: f64,
    clearance: Option<Clearance>,
    pub(crate) jacobians: Option<RowJacobians>,
    continuous: bool,
    standing: Option<Standing>,
}

impl PoseBatch {
    /// Checks what all rows share. Of the rows only the number is checked.
    pub(crate) fn new<R>(
        request: &IkBatchRequest<R>,
        machines: &MachineRegistry,
        max_rows: usize,
    ) -> Result<Self, OperationError> {
        let (tool, frame) = (request.tool(), request.frame);
        let jacobian = (request.jacobian, request.characteristic_length);
        check_batch(tool, jacobian, frame.without_tilt(), (request.poses.len(), max_rows))?;
        check_continuous(request)?;
        let machine = machines.resolve(&request.machine)?;
        let clearance = tool.clearance(&machine).filter(|_| frame == Frame::Part);
        let (tool_length, continuous) = (tool.length, request.continuous);
        let jacobians = RowJacobians::requested(&machine, jacobian.0, jacobian.1);
        let mut batch =
            Self { machine, frame, tool_length, clearance, jacobians, continuous, standing: None };
        batch.standing = request.start.map(|start| standing_at(&batch.setting(), start)).transpose()?;
        Ok(batch)
    }

    fn setting(&self) -> Setting<'_> {
        Setting {
            machine: &self.machine,
            tool_length: self.tool_length,
            clearance: self.clearance.as_ref(),
            jacobians: self.jacobians,
        }
    }

    /// Answers the next rows.
    pub(crate) fn answer<R: BatchRow>(&mut self, rows: &[R]) -> AnsweredPoses {
        let mut columns = AnswerColumns::with_capacity(numbers_of_answer(self.frame), rows.len());
        if self.continuous {
            let mut standing = self.standing.take();
            let answered = answer_continuous(self.setting(), PART_POSE, rows, &mut standing);
            self.standing = standing;
            let jumps = answered.iter().map(|row| row.jump).collect();
            for row in answered {
                columns.push_pose(row);
            }
            return AnsweredPoses { columns, jumps: Some(jumps) };
        }
        let (setting, frame) = (self.setting(), self.frame);
        let parts = rows.par_chunks(BLOCK_OF_COLUMNS).map(|rows| answer_rows(setting, frame, rows));
        parts.collect::<Vec<_>>().into_iter().for_each(|part| columns.append(part));
        AnsweredPoses { columns, jumps: None }
    }
}

/// Checks `continuous` and `start`.
fn check_continuous<R>(request: &IkBatchRequest<R>) -> Result<(), OperationError> {
    let mut faults = FieldErrors::default();
    if request.continuous && request.frame != Frame::Part {
        faults.add("/continuous", "is allowed only in frame part: the table has the windings and preimages");
    }
    if let Some(start) = &request.start {
        if !request.continuous {
            faults.add("/start", "is allowed only with `continuous: true`");
        }
        start.check(&mut faults);
    }
    faults.into_result()
}

/// Where the machine stands at `start`.
fn standing_at(setting: &Setting<'_>, start: Start) -> Result<Standing, OperationError> {
    let posture = forward_working(setting.machine, start.rho.0).map_err(|_| {
        let detail = "must be sliders of the working mode: no platform pose in this mode has them";
        OperationError::Fields(vec![FieldError::new("/start/rho", detail)])
    })?;
    let table = TablePosition::of_degrees([start.theta1, start.theta2]).angles;
    Ok(Standing::at(setting.machine, &posture, table, setting.tool_length))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

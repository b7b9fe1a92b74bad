//! `/fk/batch`: the working pose for many joint positions.

use std::sync::Arc;

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::axis::tool_axis;
use verne_solver::{
    Clearance, Machine, PartPose, PlatformPose, Registers, TableAngles, forward_working_rows, margin_rows,
    part_pose,
};

use crate::operations::batch_rows::{
    BatchRow, MIN_CHUNK, ROW_BYTES, RowFormat, RowOutcome, check_batch, outcome_of_margins,
    outcome_of_refusal, row_report,
};
use crate::operations::jacobians::{RowJacobian, RowJacobians};
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::wire::batch::{FkBatchAnswer, FkBatchNumbers, FkBatchRequest, Orientation, Row};
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::parse::{parse_body, parse_expected};
use crate::wire::tool::Tool;

/// A row without a table clearance.
const JOINTS: RowFormat =
    RowFormat { lengths: &[3, 5], description: "[rho1, rho2, rho3] or [rho1, rho2, rho3, theta1, theta2]" };

/// A row with a table clearance or a Jacobian.
const JOINTS_WITH_TABLE: RowFormat = RowFormat {
    lengths: &[5],
    description: "[rho1, rho2, rho3, theta1, theta2]: table_clearance and jacobian need theta1 and theta2",
};

/// The poses of a row.
pub(crate) struct AnsweredJoints {
    pub(crate) pose: Option<Row>,
    pub(crate) part: Option<Row>,
    pub(crate) outcome: RowOutcome,
    pub(crate) jacobian: Option<Box<RowJacobian>>,
    /// Whether the row gives theta1.
    has_theta1: bool,
}

impl AnsweredJoints {
    fn with_solution(pose: &PlatformPose, part: Option<Row>, outcome: RowOutcome) -> Self {
        let has_theta1 = part.is_some();
        let pose = [pose.x, pose.y, pose.z, to_degrees(pose.alpha)].into_iter().collect();
        Self { pose: Some(pose), part, outcome, jacobian: None, has_theta1 }
    }

    fn without_solution(outcome: RowOutcome, has_theta1: bool) -> Self {
        Self { pose: None, part: None, outcome, jacobian: None, has_theta1 }
    }
}

/// Answers a batch: from the JSON of the request to the JSON of the answer. Call it on the compute pool.
pub(crate) fn answer_fk_batch(
    body: &[u8],
    machines: &MachineRegistry,
    max_rows: usize,
) -> Result<Vec<u8>, OperationError> {
    // Nearly always every row is an array of numbers. Only another body is read row by row.
    match parse_expected::<FkBatchNumbers>(body) {
        Some(request) => answer(&request, machines, max_rows),
        None => answer(&parse_body::<FkBatchRequest<&RawValue>>(body)?, machines, max_rows),
    }
}

fn answer<R: BatchRow>(
    request: &FkBatchRequest<R>,
    machines: &MachineRegistry,
    max_rows: usize,
) -> Result<Vec<u8>, OperationError> {
    let batch = JointBatch::new(request, machines, max_rows)?;
    let rows = batch.answer(request.joints.items());
    let jacobian =
        batch.jacobians.map(|jacobians| jacobians.lists(&rows.iter().map(|row| row.jacobian.as_deref())));
    let (mut poses, mut parts) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    let mut outcomes = Vec::with_capacity(rows.len());
    let mut table_checked = batch.clearance.is_some();
    for AnsweredJoints { pose, part, outcome, has_theta1, .. } in rows {
        table_checked &= has_theta1;
        poses.push(pose);
        parts.push(part);
        outcomes.push(outcome);
    }
    let report = row_report(outcomes.into_iter(), table_checked);
    let answer = FkBatchAnswer { machine: batch.machine.id.clone(), poses, parts, jacobian, report };
    write_json(&answer, ROW_BYTES * answer.poses.len())
}

/// What all rows of a batch share.
pub(crate) struct JointBatch {
    pub(crate) machine: Arc<IdentifiedMachine>,
    pub(crate) tool: Tool,
    clearance: Option<Clearance>,
    pub(crate) jacobians: Option<RowJacobians>,
    pub(crate) orientation: Orientation,
}

impl JointBatch {
    /// Checks what all rows share. Of the rows only the number is checked.
    pub(crate) fn new<R>(
        request: &FkBatchRequest<R>,
        machines: &MachineRegistry,
        max_rows: usize,
    ) -> Result<Self, OperationError> {
        let tool = request.tool();
        let jacobian = (request.jacobian, request.characteristic_length);
        check_batch(tool, jacobian, None, (request.joints.len(), max_rows))?;
        let machine = machines.resolve(&request.machine)?;
        let clearance = tool.clearance(&machine);
        let jacobians = RowJacobians::requested(&machine, jacobian.0, jacobian.1);
        Ok(Self { machine, tool, clearance, jacobians, orientation: request.orientation })
    }

    /// Answers some rows.
    pub(crate) fn answer<R: BatchRow>(&self, rows: &[R]) -> Vec<AnsweredJoints> {
        rows.par_chunks(MIN_CHUNK).flat_map_iter(|rows| self.answer_some(rows)).collect()
    }

    /// Whether every row has to give the table's angles.
    pub(crate) fn needs_table(&self) -> bool {
        self.tool.table_clearance.is_some() || self.jacobians.is_some()
    }

    /// Answers rows: first it reads all of them, then it solves them, then it computes the margins.
    fn answer_some(&self, rows: &[impl BatchRow]) -> Vec<AnsweredJoints> {
        let Self { tool, orientation, .. } = *self;
        let machine: &Machine = &self.machine;
        let format = if self.needs_table() { JOINTS_WITH_TABLE } else { JOINTS };
        let read: Vec<Result<Joints, String>> =
            rows.iter().map(|row| row.numbers(format).map(|row| joints(&row))).collect();
        let joints = || read.iter().filter_map(|row| row.as_ref().ok());
        let sliders: Vec<_> = joints().map(|(rho, _)| *rho).collect();
        let mut solved = Vec::with_capacity(sliders.len());
        forward_working_rows(machine, &sliders, Registers::Widest, |_, answer| solved.push(answer));
        let postures: Vec<_> =
            joints().zip(&solved).filter_map(|((_, table), answer)| Some((answer.ok()?, *table))).collect();
        let mut outcomes = Vec::with_capacity(postures.len());
        margin_rows(machine, &postures, self.clearance.as_ref(), Registers::Widest, |_, margins| {
            outcomes.push(outcome_of_margins(machine, &margins));
        });
        let (mut solved, mut outcomes) = (solved.into_iter(), outcomes.into_iter());
        let answered = read.into_iter().map(|row| {
            let table = match row {
                Ok((_, table)) => table,
                Err(detail) => {
                    return Some(AnsweredJoints::without_solution(RowOutcome::Invalid(detail), true));
                }
            };
            Some(match solved.next()? {
                Ok(posture) => {
                    let part = table.map(|table| {
                        part_row(&part_pose(machine, &posture.pose, table, tool.length), orientation)
                    });
                    let mut answered = AnsweredJoints::with_solution(&posture.pose, part, outcomes.next()?);
                    let jacobians = self.jacobians.zip(table);
                    answered.jacobian = jacobians
                        .map(|(jacobians, table)| jacobians.of(machine, &posture, table, tool.length));
                    answered
                }
                Err(refusal) => {
                    AnsweredJoints::without_solution(outcome_of_refusal(machine, refusal), table.is_some())
                }
            })
        });
        answered.flatten().collect()
    }
}

/// Sliders, and theta1 and theta2 if the row gives them.
type Joints = ([f64; 3], Option<TableAngles>);

fn joints(row: &Row) -> Joints {
    let table =
        (row.len() == 5).then(|| TableAngles { theta1: from_degrees(row[3]), theta2: from_degrees(row[4]) });
    ([row[0], row[1], row[2]], table)
}

fn part_row(part: &PartPose, orientation: Orientation) -> Row {
    let mut row: Row = [part.x, part.y, part.z].into_iter().collect();
    match orientation {
        Orientation::Rotary => row.extend([part.phi1, part.phi2].map(to_degrees)),
        Orientation::Vector => row.extend(tool_axis(part.phi1, part.phi2).map(|cosine| cosine + 0.0)),
    }
    row
}

//! `/ik/batch`: the working solution for many poses.

use std::sync::Arc;

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::{
    Clearance, KinematicsError, Machine, PartPose, Point, Posture, Postures, forward_working,
    part_every_working, part_working, platform_working, tool_every_working, tool_working,
};

use crate::operations::batch_rows::{
    BatchRow, MIN_CHUNK, ROW_BYTES, ROW_WITH_AXIS, RowFormat, RowOutcome, check_batch, outcome_of_refusal,
    outcome_of_solution, row_report,
};
use crate::operations::continuation::{Setting, Standing};
use crate::operations::continuous_rows::{AnsweredPose, answer_continuous};
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::part_row::PartRow;
use crate::operations::table_angles::{TablePosition, ToolOrientation};
use crate::wire::batch::{IkBatchAnswer, IkBatchNumbers, IkBatchRequest, Row, RowReport};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::FieldErrors;
use crate::wire::json::write_json;
use crate::wire::parse::{parse_body, parse_expected};
use crate::wire::request::Frame;
use crate::wire::start::Start;

/// A row in frame `part`.
const PART_POSE: RowFormat =
    RowFormat { lengths: &[5, ROW_WITH_AXIS], description: "[x, y, z, phi1, phi2] or [x, y, z, i, j, k]" };

/// A row in the other frames.
const POSITION: RowFormat =
    RowFormat { lengths: &[3], description: "[x, y, z]: only rows of frame part have an orientation" };

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
    let rows = batch.answer(request.poses.items());
    let mut answer = IkBatchAnswer {
        machine: batch.machine.id.clone(),
        joints: Vec::new(),
        jump: None,
        jumps: None,
        report: RowReport::default(),
    };
    if batch.continuous {
        let jumps: Vec<_> = rows.iter().map(|row| row.jump).collect();
        answer.jumps = Some(jumps.iter().filter(|jump| **jump == Some(true)).count());
        answer.jump = Some(jumps);
    }
    let outcomes: Vec<RowOutcome>;
    (answer.joints, outcomes) = rows.into_iter().map(|row| (row.joints, row.outcome)).unzip();
    answer.report = row_report(outcomes.into_iter(), batch.clearance.is_some());
    write_json(&answer, ROW_BYTES * answer.joints.len())
}

/// What all rows of a batch share, and where the machine stands after those that are answered.
pub(crate) struct PoseBatch {
    pub(crate) machine: Arc<IdentifiedMachine>,
    pub(crate) frame: Frame,
    tool_length: f64,
    clearance: Option<Clearance>,
    pub(crate) continuous: bool,
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
        check_batch(tool, frame.without_tilt(), request.poses.len(), max_rows)?;
        check_continuous(request)?;
        let machine = machines.resolve(&request.machine)?;
        let clearance = tool.clearance(&machine).filter(|_| frame == Frame::Part);
        let (tool_length, continuous) = (tool.length, request.continuous);
        let mut batch = Self { machine, frame, tool_length, clearance, continuous, standing: None };
        batch.standing = request.start.map(|start| standing_at(&batch.setting(), start)).transpose()?;
        Ok(batch)
    }

    fn setting(&self) -> Setting<'_> {
        Setting { machine: &self.machine, tool_length: self.tool_length, clearance: self.clearance.as_ref() }
    }

    /// Answers the next rows.
    pub(crate) fn answer<R: BatchRow>(&mut self, rows: &[R]) -> Vec<AnsweredPose> {
        if self.continuous {
            let mut standing = self.standing.take();
            let answered = answer_continuous(self.setting(), PART_POSE, rows, &mut standing);
            self.standing = standing;
            return answered;
        }
        let (setting, frame) = (self.setting(), self.frame);
        let answered = rows.par_iter().with_min_len(MIN_CHUNK).map(|row| {
            let (joints, outcome) = answer_row(setting, frame, row);
            AnsweredPose { joints, outcome, jump: None }
        });
        answered.collect()
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

fn answer_row(setting: Setting<'_>, frame: Frame, row: &impl BatchRow) -> (Option<Row>, RowOutcome) {
    let row = match row.numbers(if frame == Frame::Part { PART_POSE } else { POSITION }) {
        Ok(row) => row,
        Err(detail) => return (None, RowOutcome::Invalid(detail)),
    };
    if row.len() == ROW_WITH_AXIS {
        return answer_axis(setting, &row);
    }
    let Setting { machine, tool_length, clearance } = setting;
    let point = [row[0], row[1], row[2]];
    let target = match frame {
        Frame::Platform => Target::Platform(point),
        Frame::Tool => Target::Tool(point, tool_length),
        Frame::Part => {
            let orientation = ToolOrientation::of_degrees([row[3], row[4]]);
            Target::Part(orientation.at(point), orientation, tool_length)
        }
    };
    match target.working(machine) {
        Ok(first) => target.preferred(machine, clearance, &first),
        Err(refusal) => (None, outcome_of_refusal(machine, refusal)),
    }
}

/// Answers a row with a tool axis as if it were the first row of a continuous batch.
fn answer_axis(setting: Setting<'_>, row: &Row) -> (Option<Row>, RowOutcome) {
    let chosen = PartRow::of_numbers(row).map_err(RowOutcome::Invalid).and_then(|row| {
        let candidates = row.candidates(setting.machine, setting.tool_length, 0.0);
        setting.choose(None, &row, &candidates)
    });
    let answered = setting.answered(chosen);
    (answered.joints, answered.outcome)
}

/// The pose of a row.
enum Target {
    Platform(Point),
    Tool(Point, f64),
    Part(PartPose, ToolOrientation, f64),
}

impl Target {
    fn working(&self, machine: &Machine) -> Result<Posture, KinematicsError> {
        match self {
            Self::Platform(point) => platform_working(machine, *point),
            Self::Tool(point, length) => tool_working(machine, *point, *length),
            Self::Part(pose, _, length) => part_working(machine, pose, *length),
        }
    }

    /// Joints and outcome of the first working posture if it is feasible, or if no other is; otherwise of the feasible
    /// one with the least alpha.
    fn preferred(
        &self,
        machine: &Machine,
        clearance: Option<&Clearance>,
        first: &Posture,
    ) -> (Option<Row>, RowOutcome) {
        let answered = |posture: &Posture| {
            let table = self.table(machine, posture.pose.alpha);
            let outcome = outcome_of_solution(machine, posture, table.map(|table| table.angles), clearance);
            (Some(joints(posture, table)), outcome)
        };
        let answer = answered(first);
        if !matches!(answer.1, RowOutcome::Infeasible(_)) {
            return answer;
        }
        let mut others = self.every_working(machine);
        others.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
        others
            .iter()
            .map(answered)
            .find(|(_, outcome)| matches!(outcome, RowOutcome::Ok(_)))
            .unwrap_or(answer)
    }

    fn every_working(&self, machine: &Machine) -> Postures {
        let found = match self {
            Self::Platform(_) => return Postures::new(),
            Self::Tool(point, length) => tool_every_working(machine, *point, *length),
            Self::Part(pose, _, length) => part_every_working(machine, pose, *length),
        };
        found.unwrap_or_default()
    }

    fn table(&self, machine: &Machine, alpha: f64) -> Option<TablePosition> {
        match self {
            Self::Part(_, orientation, _) => Some(orientation.table(machine, alpha, None)),
            _ => None,
        }
    }
}

fn joints(posture: &Posture, table: Option<TablePosition>) -> Row {
    let mut row: Row = posture.rho.into_iter().collect();
    row.extend(table.into_iter().flat_map(|table| table.degrees));
    row
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

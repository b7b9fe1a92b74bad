//! `/ik/batch`: the working solution for many poses.

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::{
    Clearance, KinematicsError, Machine, PartPose, Point, Posture, Postures, part_every_working,
    part_working, platform_working, tool_every_working, tool_working,
};

use crate::operations::batch_rows::{
    BatchRow, MIN_CHUNK, ROW_BYTES, RowFormat, RowOutcome, check_batch, outcome_of_refusal,
    outcome_of_solution, row_report,
};
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::table_angles::{TablePosition, ToolOrientation};
use crate::wire::batch::{IkBatchAnswer, IkBatchNumbers, IkBatchRequest, Row};
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::parse::{parse_body, parse_expected};
use crate::wire::request::Frame;

/// A row in frame `part`.
const PART_POSE: RowFormat = RowFormat { lengths: &[5], description: "[x, y, z, phi1, phi2]" };

/// A row in the other frames.
const POSITION: RowFormat = RowFormat { lengths: &[3], description: "[x, y, z]" };

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
    let (tool, frame) = (request.tool(), request.frame);
    check_batch(tool, frame.without_tilt(), request.poses.len(), max_rows)?;
    let machine = machines.resolve(&request.machine)?;
    let clearance = tool.clearance(&machine).filter(|_| frame == Frame::Part);
    let (joints, outcomes): (Vec<_>, Vec<_>) = request
        .poses
        .items()
        .par_iter()
        .with_min_len(MIN_CHUNK)
        .map(|row| answer_row(&machine, frame, tool.length, clearance.as_ref(), row))
        .unzip();
    let report = row_report(outcomes.into_iter(), clearance.is_some());
    let answer = IkBatchAnswer { machine: machine.id.clone(), joints, report };
    write_json(&answer, ROW_BYTES * answer.joints.len())
}

fn answer_row(
    machine: &Machine,
    frame: Frame,
    tool_length: f64,
    clearance: Option<&Clearance>,
    row: &impl BatchRow,
) -> (Option<Row>, RowOutcome) {
    let row = match row.numbers(if frame == Frame::Part { PART_POSE } else { POSITION }) {
        Ok(row) => row,
        Err(detail) => return (None, RowOutcome::Invalid(detail)),
    };
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
        others.iter().map(answered).find(|(_, outcome)| matches!(outcome, RowOutcome::Ok)).unwrap_or(answer)
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

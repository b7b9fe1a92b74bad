//! `/ik/batch`: the working solution for many poses.

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::{
    KinematicsError, Machine, PartPose, Point, Posture, Postures, Registers, forward_working, margin_rows,
    part_every_working, part_working_rows, platform_working_rows, tool_every_working, tool_working_rows,
};

use crate::operations::batch_rows::{
    BatchRow, MIN_CHUNK, ROW_BYTES, ROW_WITH_AXIS, RowFormat, RowOutcome, check_batch, outcome_of_margins,
    outcome_of_refusal, outcome_of_solution, row_report,
};
use crate::operations::continuation::{Setting, Standing};
use crate::operations::continuous_rows::answer_continuous;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::part_row::PartRow;
use crate::operations::table_angles::{TablePosition, ToolOrientation};
use crate::wire::batch::{IkBatchAnswer, IkBatchNumbers, IkBatchRequest, Row, RowReport};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::FixedArray;
use crate::wire::json::write_json;
use crate::wire::parse::{parse_body, parse_expected};
use crate::wire::request::Frame;

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
    let (tool, frame) = (request.tool(), request.frame);
    check_batch(tool, frame.without_tilt(), request.poses.len(), max_rows)?;
    check_continuous(request)?;
    let machine = machines.resolve(&request.machine)?;
    let clearance = tool.clearance(&machine).filter(|_| frame == Frame::Part);
    let setting = Setting { machine: &machine, tool_length: tool.length, clearance: clearance.as_ref() };
    let mut answer = IkBatchAnswer {
        machine: machine.id.clone(),
        joints: Vec::new(),
        jump: None,
        jumps: None,
        report: RowReport::default(),
    };
    let rows = request.poses.items();
    let outcomes: Vec<RowOutcome>;
    if request.continuous {
        let start = request.start.map(|start| standing_at(&setting, &start.0)).transpose()?;
        let answered = answer_continuous(setting, PART_POSE, rows, start);
        let jumps: Vec<_> = answered.iter().map(|row| row.jump).collect();
        answer.jumps = Some(jumps.iter().filter(|jump| **jump == Some(true)).count());
        answer.jump = Some(jumps);
        (answer.joints, outcomes) = answered.into_iter().map(|row| (row.joints, row.outcome)).unzip();
    } else {
        let answered = rows.par_chunks(MIN_CHUNK).flat_map_iter(|rows| answer_rows(setting, frame, rows));
        (answer.joints, outcomes) = answered.unzip();
    }
    answer.report = row_report(outcomes.into_iter(), clearance.is_some());
    write_json(&answer, ROW_BYTES * answer.joints.len())
}

/// Checks `continuous` and `start`.
fn check_continuous<R>(request: &IkBatchRequest<R>) -> Result<(), OperationError> {
    let mut faults = FieldErrors::default();
    if request.continuous && request.frame != Frame::Part {
        faults.add("/continuous", "is allowed only in frame part: the table has the windings and preimages");
    }
    if let Some(FixedArray([rho1, rho2, rho3, theta1, theta2])) = request.start {
        if !request.continuous {
            faults.add("/start", "is allowed only with `continuous: true`");
        }
        faults.lengths("/start", &[rho1, rho2, rho3]);
        faults.angle("/start/3", Some(theta1));
        faults.angle("/start/4", Some(theta2));
    }
    faults.into_result()
}

/// Where the machine stands at `start`.
fn standing_at(
    setting: &Setting<'_>,
    &[rho1, rho2, rho3, theta1, theta2]: &[f64; 5],
) -> Result<Standing, OperationError> {
    let posture = forward_working(setting.machine, [rho1, rho2, rho3]).map_err(|_| {
        let detail = "must be joints of the working mode: no platform pose in this mode has these sliders";
        OperationError::Fields(vec![FieldError::new("/start", detail)])
    })?;
    let table = TablePosition::of_degrees([theta1, theta2]).angles;
    Ok(Standing::at(setting.machine, &posture, table, setting.tool_length))
}

/// Answers rows: first it reads all of them, then it solves them, then it computes the margins.
fn answer_rows(setting: Setting<'_>, frame: Frame, rows: &[impl BatchRow]) -> Vec<(Option<Row>, RowOutcome)> {
    let machine = setting.machine;
    let read: Vec<_> = rows.iter().map(|row| read_row(setting, frame, row)).collect();
    let targets: Vec<Target> = read.iter().filter_map(|row| row.as_ref().ok().copied()).collect();
    let solved = solved(setting, frame, &targets);
    let postures: Vec<_> = targets
        .iter()
        .zip(&solved)
        .filter_map(|(target, answer)| {
            let posture = answer.ok()?;
            Some((posture, target.table(machine, posture.pose.alpha).map(|table| table.angles)))
        })
        .collect();
    let mut outcomes = Vec::with_capacity(postures.len());
    margin_rows(machine, &postures, setting.clearance, Registers::Widest, |_, margins| {
        outcomes.push(outcome_of_margins(machine, &margins));
    });
    let (mut solved, mut outcomes) = (solved.into_iter(), outcomes.into_iter());
    let answered = read.into_iter().map(|row| {
        let target = match row {
            Ok(target) => target,
            Err(answered) => return Some(answered),
        };
        Some(match solved.next()? {
            Ok(posture) => target.preferred(setting, &posture, outcomes.next()?),
            Err(refusal) => (None, outcome_of_refusal(machine, refusal)),
        })
    });
    answered.flatten().collect()
}

/// The target of a row; or the row's answer, if it has none or a tool axis.
fn read_row(
    setting: Setting<'_>,
    frame: Frame,
    row: &impl BatchRow,
) -> Result<Target, (Option<Row>, RowOutcome)> {
    let row = row.numbers(if frame == Frame::Part { PART_POSE } else { POSITION });
    let row = row.map_err(|detail| (None, RowOutcome::Invalid(detail)))?;
    if row.len() == ROW_WITH_AXIS {
        return Err(answer_axis(setting, &row));
    }
    let point = [row[0], row[1], row[2]];
    Ok(match frame {
        Frame::Platform => Target::Platform(point),
        Frame::Tool => Target::Tool(point),
        Frame::Part => {
            let orientation = ToolOrientation::of_degrees([row[3], row[4]]);
            Target::Part(orientation.at(point), orientation)
        }
    })
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
#[derive(Clone, Copy, Debug)]
enum Target {
    Platform(Point),
    Tool(Point),
    Part(PartPose, ToolOrientation),
}

/// The first working posture of each target.
fn solved(
    Setting { machine, tool_length, .. }: Setting<'_>,
    frame: Frame,
    targets: &[Target],
) -> Vec<Result<Posture, KinematicsError>> {
    let mut solved = Vec::with_capacity(targets.len());
    let found = |_, answer| solved.push(answer);
    let points = || -> Vec<Point> { targets.iter().map(Target::point).collect() };
    match frame {
        Frame::Platform => platform_working_rows(machine, &points(), Registers::Widest, found),
        Frame::Tool => tool_working_rows(machine, &points(), tool_length, Registers::Widest, found),
        Frame::Part => {
            let poses: Vec<_> = targets.iter().filter_map(Target::part_pose).collect();
            part_working_rows(machine, &poses, tool_length, Registers::Widest, found);
        }
    }
    solved
}

impl Target {
    fn point(&self) -> Point {
        match self {
            Self::Platform(point) | Self::Tool(point) => *point,
            Self::Part(pose, _) => [pose.x, pose.y, pose.z],
        }
    }

    fn part_pose(&self) -> Option<PartPose> {
        if let Self::Part(pose, _) = self { Some(*pose) } else { None }
    }

    /// Joints and outcome of the first working posture if it is feasible, or if no other is; otherwise of the feasible
    /// one with the least alpha.
    fn preferred(
        &self,
        setting: Setting<'_>,
        first: &Posture,
        outcome: RowOutcome,
    ) -> (Option<Row>, RowOutcome) {
        let Setting { machine, tool_length, clearance } = setting;
        let joints = |posture: &Posture| Some(joints(posture, self.table(machine, posture.pose.alpha)));
        if !matches!(outcome, RowOutcome::Infeasible(_)) {
            return (joints(first), outcome);
        }
        let mut others = self.every_working(machine, tool_length);
        others.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
        others
            .iter()
            .map(|posture| {
                let table = self.table(machine, posture.pose.alpha).map(|table| table.angles);
                (joints(posture), outcome_of_solution(machine, posture, table, clearance))
            })
            .find(|(_, outcome)| matches!(outcome, RowOutcome::Ok(_)))
            .unwrap_or_else(|| (joints(first), outcome))
    }

    fn every_working(&self, machine: &Machine, tool_length: f64) -> Postures {
        let found = match self {
            Self::Platform(_) => return Postures::new(),
            Self::Tool(point) => tool_every_working(machine, *point, tool_length),
            Self::Part(pose, _) => part_every_working(machine, pose, tool_length),
        };
        found.unwrap_or_default()
    }

    fn table(&self, machine: &Machine, alpha: f64) -> Option<TablePosition> {
        match self {
            Self::Part(_, orientation) => Some(orientation.table(machine, alpha, None)),
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

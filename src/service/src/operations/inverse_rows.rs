//! The rows of a batch of poses that is not continuous: each is answered by itself.

use verne_solver::{
    KinematicsError, Machine, Margin, PartPose, Point, Posture, PostureColumns, Postures, Registers,
    part_every_working, part_working_rows, platform_working_rows, tool_every_working, tool_working_rows,
    worst_margin_rows,
};

use crate::operations::answer_columns::AnswerColumns;
use crate::operations::batch_rows::{
    BatchRow, ROW_WITH_AXIS, RowFormat, RowOutcome, outcome_of_refusal, outcome_of_solution,
};
use crate::operations::continuation::Setting;
use crate::operations::continuous_rows::AnsweredPose;
use crate::operations::jacobians::RowJacobian;
use crate::operations::part_row::PartRow;
use crate::operations::table_angles::{TablePosition, ToolOrientation, WoundTable};
use crate::wire::batch::Row;
use crate::wire::request::Frame;

/// A row in frame `part`.
pub(crate) const PART_POSE: RowFormat =
    RowFormat { lengths: &[5, ROW_WITH_AXIS], description: "[x, y, z, phi1, phi2] or [x, y, z, i, j, k]" };

/// A row in the other frames.
const POSITION: RowFormat =
    RowFormat { lengths: &[3], description: "[x, y, z]: only rows of frame part have an orientation" };

/// The rows of a frame.
pub(crate) fn row_format(frame: Frame) -> RowFormat {
    if frame == Frame::Part { PART_POSE } else { POSITION }
}

/// How many numbers an answered row has.
pub(crate) fn numbers_of_answer(frame: Frame) -> usize {
    if frame == Frame::Part { 5 } else { 3 }
}

/// The first working posture of a target.
struct Solution {
    rho: [f64; 3],
    table: Option<WoundTable>,
    jacobian: Option<Box<RowJacobian>>,
}

/// Answers rows: first it reads all of them, then it solves them, then it computes the margins.
pub(crate) fn answer_rows(setting: Setting<'_>, frame: Frame, rows: &[impl BatchRow]) -> AnswerColumns {
    let mut targets = Vec::with_capacity(rows.len());
    // Rows that are not solved with the others: malformed ones, and those with a tool axis.
    let mut answered: Vec<(usize, AnsweredPose)> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        match read_row(setting, frame, row) {
            Ok(target) => targets.push(target),
            Err(row) => answered.push((i, row)),
        }
    }
    let (solved, worst) = solve(setting, frame, &targets);
    let mut answers = AnswerColumns::with_capacity(numbers_of_answer(frame), rows.len());
    let (mut answered, mut worst) = (answered.into_iter().peekable(), worst.into_iter());
    let mut solved = targets.iter().zip(solved);
    for i in 0..rows.len() {
        if let Some((_, pose)) = answered.next_if(|(row, _)| *row == i) {
            answers.push_pose(pose);
            continue;
        }
        match solved.next() {
            Some((target, Ok(solution))) => {
                if let Some((margin, feasible)) = worst.next() {
                    push_solution(setting, target, solution, (margin, feasible), &mut answers);
                }
            }
            Some((_, Err(refusal))) => {
                answers.push(None, outcome_of_refusal(setting.machine, refusal), None);
            }
            None => {}
        }
    }
    answers
}

/// The worst margin of a solution, and whether the solution is feasible.
type Feasibility = (Margin, bool);

/// The solutions of targets, and the worst margins of those that have one.
fn solve(
    setting: Setting<'_>,
    frame: Frame,
    targets: &[Target],
) -> (Vec<Result<Solution, KinematicsError>>, Vec<Feasibility>) {
    let Setting { machine, tool_length, clearance, .. } = setting;
    let mut solved = Vec::with_capacity(targets.len());
    let mut postures = PostureColumns::new();
    let found = |i: usize, answer: Result<Posture, KinematicsError>| {
        solved.push(answer.map(|posture| {
            let table = targets.get(i).and_then(|target| target.wound(machine, posture.pose.alpha));
            postures.push(&posture, table.map(|table| table.angles()));
            let jacobian = table.and_then(|table| setting.jacobian(&posture, table.angles()));
            Solution { rho: posture.rho, table, jacobian }
        }));
    };
    let points = || -> Vec<Point> { targets.iter().map(Target::point).collect() };
    match frame {
        Frame::Platform => platform_working_rows(machine, &points(), Registers::Widest, found),
        Frame::Tool => tool_working_rows(machine, &points(), tool_length, Registers::Widest, found),
        Frame::Part => {
            let poses: Vec<_> = targets.iter().filter_map(Target::part_pose).collect();
            part_working_rows(machine, &poses, tool_length, Registers::Widest, found);
        }
    }
    let mut worst = Vec::with_capacity(postures.len());
    worst_margin_rows(machine, &postures, clearance, Registers::Widest, |_, margin, feasible| {
        worst.push((margin, feasible));
    });
    (solved, worst)
}

/// Adds the first working posture of a target if it is feasible, or if no other is; otherwise the feasible one with the
/// least alpha.
fn push_solution(
    setting: Setting<'_>,
    target: &Target,
    first: Solution,
    (worst, feasible): Feasibility,
    answers: &mut AnswerColumns,
) {
    if !feasible && let Some(pose) = target.feasible_other(setting) {
        answers.push_pose(pose);
        return;
    }
    let outcome = RowOutcome::of_worst(worst, feasible);
    let [rho1, rho2, rho3] = first.rho;
    match first.table {
        Some(table) => {
            let [theta1, theta2] = TablePosition::from(table).degrees;
            answers.push(Some(&[rho1, rho2, rho3, theta1, theta2]), outcome, first.jacobian);
        }
        None => answers.push(Some(&first.rho), outcome, None),
    }
}

/// The target of a row; or the row's answer, if it has none or a tool axis.
fn read_row(setting: Setting<'_>, frame: Frame, row: &impl BatchRow) -> Result<Target, AnsweredPose> {
    let row = row.numbers(row_format(frame));
    let row = row.map_err(|detail| AnsweredPose::without_solution(RowOutcome::Invalid(detail)))?;
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
fn answer_axis(setting: Setting<'_>, row: &Row) -> AnsweredPose {
    let chosen = PartRow::of_numbers(row).map_err(RowOutcome::Invalid).and_then(|row| {
        let candidates = row.candidates(setting.machine, setting.tool_length, 0.0);
        setting.choose(None, &row, &candidates)
    });
    AnsweredPose { jump: None, ..setting.answered(chosen) }
}

/// The pose of a row.
#[derive(Clone, Copy, Debug)]
enum Target {
    Platform(Point),
    Tool(Point),
    Part(PartPose, ToolOrientation),
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

    /// Joints and outcome of the feasible working posture with the least alpha, if there is one.
    fn feasible_other(&self, setting: Setting<'_>) -> Option<AnsweredPose> {
        let Setting { machine, tool_length, clearance, .. } = setting;
        let mut others = self.every_working(machine, tool_length);
        others.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
        others.iter().find_map(|posture| {
            let table = self.wound(machine, posture.pose.alpha).map(TablePosition::from);
            let angles = table.map(|table| table.angles);
            let outcome = outcome_of_solution(machine, posture, angles, clearance);
            matches!(outcome, RowOutcome::Ok(_)).then(|| {
                let jacobian = angles.and_then(|angles| setting.jacobian(posture, angles));
                AnsweredPose { joints: Some(joints(posture, table)), outcome, jump: None, jacobian }
            })
        })
    }

    fn every_working(&self, machine: &Machine, tool_length: f64) -> Postures {
        let found = match self {
            Self::Platform(_) => return Postures::new(),
            Self::Tool(point) => tool_every_working(machine, *point, tool_length),
            Self::Part(pose, _) => part_every_working(machine, pose, tool_length),
        };
        found.unwrap_or_default()
    }

    fn wound(&self, machine: &Machine, alpha: f64) -> Option<WoundTable> {
        match self {
            Self::Part(_, orientation) => Some(orientation.wound(machine, alpha, [None; 2])),
            _ => None,
        }
    }
}

fn joints(posture: &Posture, table: Option<TablePosition>) -> Row {
    let mut row: Row = posture.rho.into_iter().collect();
    row.extend(table.into_iter().flat_map(|table| table.degrees));
    row
}

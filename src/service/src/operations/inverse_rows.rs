//! The rows of a batch of poses that is not continuous: each is answered by itself.

use verne_solver::{
    KinematicsError, Machine, PartPose, Point, Posture, Postures, Registers, margin_rows, part_every_working,
    part_working_rows, platform_working_rows, tool_every_working, tool_working_rows,
};

use crate::operations::batch_rows::{
    BatchRow, ROW_WITH_AXIS, RowFormat, RowOutcome, outcome_of_margins, outcome_of_refusal,
    outcome_of_solution,
};
use crate::operations::continuation::Setting;
use crate::operations::continuous_rows::AnsweredPose;
use crate::operations::part_row::PartRow;
use crate::operations::table_angles::{TablePosition, ToolOrientation};
use crate::wire::batch::Row;
use crate::wire::request::Frame;

/// A row in frame `part`.
pub(crate) const PART_POSE: RowFormat =
    RowFormat { lengths: &[5, ROW_WITH_AXIS], description: "[x, y, z, phi1, phi2] or [x, y, z, i, j, k]" };

/// A row in the other frames.
const POSITION: RowFormat =
    RowFormat { lengths: &[3], description: "[x, y, z]: only rows of frame part have an orientation" };

/// Answers rows: first it reads all of them, then it solves them, then it computes the margins.
pub(crate) fn answer_rows(setting: Setting<'_>, frame: Frame, rows: &[impl BatchRow]) -> Vec<AnsweredPose> {
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
            Err(refusal) => AnsweredPose::without_solution(outcome_of_refusal(machine, refusal)),
        })
    });
    answered.flatten().collect()
}

/// The target of a row; or the row's answer, if it has none or a tool axis.
fn read_row(setting: Setting<'_>, frame: Frame, row: &impl BatchRow) -> Result<Target, AnsweredPose> {
    let row = row.numbers(if frame == Frame::Part { PART_POSE } else { POSITION });
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

    /// The first working posture if it is feasible, or if no other is; otherwise the feasible one with the least alpha.
    fn preferred(&self, setting: Setting<'_>, first: &Posture, outcome: RowOutcome) -> AnsweredPose {
        let Setting { machine, tool_length, clearance, .. } = setting;
        if !matches!(outcome, RowOutcome::Infeasible(_)) {
            return self.answered(setting, first, outcome);
        }
        let mut others = self.every_working(machine, tool_length);
        others.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
        let feasible = others.iter().find_map(|posture| {
            let table = self.table(machine, posture.pose.alpha).map(|table| table.angles);
            let outcome = outcome_of_solution(machine, posture, table, clearance);
            matches!(outcome, RowOutcome::Ok(_)).then_some((posture, outcome))
        });
        let (posture, outcome) = feasible.unwrap_or((first, outcome));
        self.answered(setting, posture, outcome)
    }

    fn answered(&self, setting: Setting<'_>, posture: &Posture, outcome: RowOutcome) -> AnsweredPose {
        let table = self.table(setting.machine, posture.pose.alpha);
        let jacobian = table.and_then(|table| setting.jacobian(posture, table.angles));
        AnsweredPose { joints: Some(joints(posture, table)), outcome, jump: None, jacobian }
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

//! `/ik/batch`: the working solution for many poses.

use rayon::prelude::*;
use verne_solver::{
    Clearance, KinematicsError, Machine, PartPose, Point, Posture, Postures, part_every_working,
    part_working, platform_working, tool_every_working, tool_working,
};

use crate::operations::batch_rows::{
    CHUNK, ROW_BYTES, Shape, Shared, Verdict, check_batch, judge, refuse, report,
};
use crate::operations::registry::Registry;
use crate::operations::table_angles::{Orientation, Stand};
use crate::wire::batch::{IkBatchAnswer, IkBatchNumbers, IkBatchRequest, Row, Rows};
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::machine_ref::MachineRef;
use crate::wire::parse::{parse_body, parse_usual};
use crate::wire::request::Frame;

/// A batch as it was read.
struct Question<'a> {
    machine: MachineRef,
    frame: Frame,
    shared: Shared,
    rows: Rows<'a>,
}

/// Reads a batch: at one go if every row is as it should be.
fn read(body: &[u8]) -> Result<Question<'_>, OperationError> {
    if let Some(usual) = parse_usual(body) {
        let IkBatchNumbers { machine, frame, tool_length, table_clearance, tool_radius, poses } = usual;
        let shared = Shared { tool_length, table_clearance, tool_radius };
        return Ok(Question { machine, frame, shared, rows: Rows::Read(poses) });
    }
    let IkBatchRequest { machine, frame, tool_length, table_clearance, tool_radius, poses } =
        parse_body(body)?;
    let shared = Shared { tool_length, table_clearance, tool_radius };
    Ok(Question { machine, frame, shared, rows: Rows::Text(poses) })
}

/// Answers a batch, from its body to the answer's; to be called on the worker threads.
pub(crate) fn answer_ik_batch(
    body: &[u8],
    machines: &Registry,
    most_rows: usize,
) -> Result<Vec<u8>, OperationError> {
    let question = read(body)?;
    check_batch(question.shared, question.frame.without_tilt(), question.rows.len(), most_rows)?;
    let published = machines.resolve(&question.machine)?;
    let clearance = question.shared.clearance(&published.machine);
    let clearance = clearance.filter(|_| question.frame == Frame::Part);
    let (joints, verdicts): (Vec<_>, Vec<_>) = (0..question.rows.len())
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(|row| answer_row(&published.machine, &question, clearance.as_ref(), row))
        .unzip();
    let report = report(verdicts.into_iter(), clearance.is_some());
    let answer = IkBatchAnswer { machine: published.id.clone(), joints, report };
    write_json(&answer, ROW_BYTES * answer.joints.len())
}

fn answer_row(
    machine: &Machine,
    question: &Question<'_>,
    clearance: Option<&Clearance>,
    row: usize,
) -> (Option<Row>, Verdict) {
    let &Question { frame, shared: Shared { tool_length, .. }, .. } = question;
    let shape = match frame {
        Frame::Part => Shape { lengths: &[5], words: "[x, y, z, phi1, phi2]" },
        Frame::Platform | Frame::Tool => Shape { lengths: &[3], words: "[x, y, z]" },
    };
    let row = match shape.row(&question.rows, row) {
        Ok(row) => row,
        Err(detail) => return (None, Verdict::Invalid(detail)),
    };
    let point = [row[0], row[1], row[2]];
    let target = match frame {
        Frame::Platform => Target::Platform(point),
        Frame::Tool => Target::Tool(point, tool_length),
        Frame::Part => {
            let orientation = Orientation::of_degrees([row[3], row[4]]);
            Target::Part(orientation.at(point), orientation, tool_length)
        }
    };
    match target.working(machine) {
        Ok(first) => target.chosen(machine, clearance, &first),
        Err(refusal) => (None, refuse(machine, refusal)),
    }
}

/// What a row asks for.
enum Target {
    Platform(Point),
    Tool(Point, f64),
    Part(PartPose, Orientation, f64),
}

impl Target {
    fn working(&self, machine: &Machine) -> Result<Posture, KinematicsError> {
        match self {
            Self::Platform(point) => platform_working(machine, *point),
            Self::Tool(point, length) => tool_working(machine, *point, *length),
            Self::Part(pose, _, length) => part_working(machine, pose, *length),
        }
    }

    /// The first working posture if it keeps every limit, or if no other does; else the next that
    /// does, in the order of alpha.
    fn chosen(
        &self,
        machine: &Machine,
        clearance: Option<&Clearance>,
        first: &Posture,
    ) -> (Option<Row>, Verdict) {
        let judged = |posture: &Posture| {
            let table = self.table(machine, posture.pose.alpha);
            let verdict = judge(machine, posture, table.map(|table| table.angles), clearance);
            (Some(joints(posture, table)), verdict)
        };
        let answer = judged(first);
        if !matches!(answer.1, Verdict::Infeasible(_)) {
            return answer;
        }
        let mut others = self.every_working(machine);
        others.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
        others.iter().map(judged).find(|(_, verdict)| matches!(verdict, Verdict::Ok)).unwrap_or(answer)
    }

    fn every_working(&self, machine: &Machine) -> Postures {
        let found = match self {
            Self::Platform(_) => return Postures::new(),
            Self::Tool(point, length) => tool_every_working(machine, *point, *length),
            Self::Part(pose, _, length) => part_every_working(machine, pose, *length),
        };
        found.unwrap_or_default()
    }

    fn table(&self, machine: &Machine, alpha: f64) -> Option<Stand> {
        match self {
            Self::Part(_, orientation, _) => Some(orientation.stand(machine, alpha, None)),
            _ => None,
        }
    }
}

fn joints(posture: &Posture, table: Option<Stand>) -> Row {
    let mut row: Row = posture.rho.into_iter().collect();
    row.extend(table.into_iter().flat_map(|table| table.degrees));
    row
}

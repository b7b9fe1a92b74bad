//! `/fk/batch`: the working pose for many joint positions.

use rayon::prelude::*;
use verne_solver::{Clearance, Machine, TableAngles, forward_working, part_pose};

use crate::operations::batch_rows::{
    CHUNK, ROW_BYTES, Shape, Shared, Verdict, check_batch, judge, refuse, report,
};
use crate::operations::registry::Registry;
use crate::wire::batch::{FkBatchAnswer, FkBatchNumbers, FkBatchRequest, Row, Rows};
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::machine_ref::MachineRef;
use crate::wire::parse::{parse_body, parse_usual};

/// One answered row.
struct Answered {
    pose: Option<Row>,
    part: Option<Row>,
    verdict: Verdict,
    /// Whether the row gives theta1.
    tilted: bool,
}

impl Answered {
    fn nothing(verdict: Verdict, tilted: bool) -> Self {
        Self { pose: None, part: None, verdict, tilted }
    }
}

/// A batch as it was read.
struct Question<'a> {
    machine: MachineRef,
    shared: Shared,
    rows: Rows<'a>,
}

/// Reads a batch: at one go if every row is as it should be.
fn read(body: &[u8]) -> Result<Question<'_>, OperationError> {
    if let Some(usual) = parse_usual(body) {
        let FkBatchNumbers { machine, tool_length, table_clearance, tool_radius, joints } = usual;
        let shared = Shared { tool_length, table_clearance, tool_radius };
        return Ok(Question { machine, shared, rows: Rows::Read(joints) });
    }
    let FkBatchRequest { machine, tool_length, table_clearance, tool_radius, joints } = parse_body(body)?;
    let shared = Shared { tool_length, table_clearance, tool_radius };
    Ok(Question { machine, shared, rows: Rows::Text(joints) })
}

/// Answers a batch, from its body to the answer's; to be called on the worker threads.
pub(crate) fn answer_fk_batch(
    body: &[u8],
    machines: &Registry,
    most_rows: usize,
) -> Result<Vec<u8>, OperationError> {
    let question = read(body)?;
    check_batch(question.shared, None, question.rows.len(), most_rows)?;
    let published = machines.resolve(&question.machine)?;
    let clearance = question.shared.clearance(&published.machine);
    let rows: Vec<_> = (0..question.rows.len())
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(|row| answer_row(&published.machine, &question, clearance.as_ref(), row))
        .collect();
    let (mut poses, mut parts) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    let mut verdicts = Vec::with_capacity(rows.len());
    let mut table_checked = clearance.is_some();
    for Answered { pose, part, verdict, tilted } in rows {
        table_checked &= tilted;
        poses.push(pose);
        parts.push(part);
        verdicts.push(verdict);
    }
    let machine = published.id.clone();
    let report = report(verdicts.into_iter(), table_checked);
    let answer = FkBatchAnswer { machine, poses, parts, report };
    write_json(&answer, ROW_BYTES * answer.poses.len())
}

fn answer_row(
    machine: &Machine,
    question: &Question<'_>,
    clearance: Option<&Clearance>,
    row: usize,
) -> Answered {
    let shape = if question.shared.table_clearance.is_none() {
        Shape { lengths: &[3, 5], words: "[rho1, rho2, rho3] or [rho1, rho2, rho3, theta1, theta2]" }
    } else {
        Shape { lengths: &[5], words: "[rho1, rho2, rho3, theta1, theta2]: table_clearance needs theta1" }
    };
    let row = match shape.row(&question.rows, row) {
        Ok(row) => row,
        Err(detail) => return Answered::nothing(Verdict::Invalid(detail), true),
    };
    let table =
        (row.len() == 5).then(|| TableAngles { theta1: from_degrees(row[3]), theta2: from_degrees(row[4]) });
    let posture = match forward_working(machine, [row[0], row[1], row[2]]) {
        Ok(posture) => posture,
        Err(refusal) => return Answered::nothing(refuse(machine, refusal), table.is_some()),
    };
    let pose = &posture.pose;
    let part = table.map(|table| {
        let part = part_pose(machine, pose, table, question.shared.tool_length);
        [part.x, part.y, part.z, to_degrees(part.phi1), to_degrees(part.phi2)].into()
    });
    Answered {
        pose: Some([pose.x, pose.y, pose.z, to_degrees(pose.alpha)].into_iter().collect()),
        part,
        verdict: judge(machine, &posture, table, clearance),
        tilted: table.is_some(),
    }
}

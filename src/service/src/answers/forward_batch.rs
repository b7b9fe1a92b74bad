//! `/fk/batch`: the working pose for many joint positions.

use rayon::prelude::*;
use verne_solver::{Machine, TableAngles, forward_working, part_pose};

use super::batch_rows::{CHUNK, ROW_BYTES, Shape, Verdict, check_batch, judge, refuse, report};
use crate::error::Error;
use crate::registry::Registry;
use crate::wire::batch::{FkBatchAnswer, FkBatchNumbers, FkBatchRequest, Row, Rows};
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::json::write_json;
use crate::wire::machine_ref::MachineRef;
use crate::wire::parse::{parse_body, parse_usual};

/// One answered row.
struct Answered {
    pose: Option<Row>,
    part: Option<Row>,
    verdict: Verdict,
}

impl Answered {
    fn nothing(verdict: Verdict) -> Self {
        Self { pose: None, part: None, verdict }
    }
}

/// A batch as it was read.
struct Question<'a> {
    machine: MachineRef,
    tool_length: f64,
    rows: Rows<'a>,
}

/// Reads a batch: at one go if every row is as it should be.
fn read(body: &[u8]) -> Result<Question<'_>, Error> {
    if let Some(FkBatchNumbers { machine, tool_length, joints }) = parse_usual(body) {
        return Ok(Question { machine, tool_length, rows: Rows::Read(joints) });
    }
    let FkBatchRequest { machine, tool_length, joints } = parse_body(body)?;
    Ok(Question { machine, tool_length, rows: Rows::Text(joints) })
}

/// Answers a batch, from its body to the answer's; to be called on the worker threads.
pub(crate) fn answer_fk_batch(body: &[u8], machines: &Registry, most_rows: usize) -> Result<Vec<u8>, Error> {
    let question = read(body)?;
    check_batch(question.tool_length, question.rows.len(), most_rows)?;
    let published = machines.resolve(&question.machine)?;
    let rows: Vec<_> = (0..question.rows.len())
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(|row| answer_row(&published.machine, &question, row))
        .collect();
    let (mut poses, mut parts) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    let mut verdicts = Vec::with_capacity(rows.len());
    for Answered { pose, part, verdict } in rows {
        poses.push(pose);
        parts.push(part);
        verdicts.push(verdict);
    }
    let machine = published.id.clone();
    let answer = FkBatchAnswer { machine, poses, parts, report: report(verdicts.into_iter()) };
    write_json(&answer, ROW_BYTES * answer.poses.len())
}

fn answer_row(machine: &Machine, question: &Question<'_>, row: usize) -> Answered {
    let tool_length = question.tool_length;
    let words = "[rho1, rho2, rho3] or [rho1, rho2, rho3, theta1, theta2]";
    let row = match (Shape { lengths: &[3, 5], words }).row(&question.rows, row) {
        Ok(row) => row,
        Err(detail) => return Answered::nothing(Verdict::Invalid(detail)),
    };
    let table =
        (row.len() == 5).then(|| TableAngles { theta1: from_degrees(row[3]), theta2: from_degrees(row[4]) });
    let posture = match forward_working(machine, [row[0], row[1], row[2]]) {
        Ok(posture) => posture,
        Err(refusal) => return Answered::nothing(refuse(machine, refusal)),
    };
    let pose = &posture.pose;
    let part = table.map(|table| {
        let part = part_pose(machine, pose, table, tool_length);
        [part.x, part.y, part.z, to_degrees(part.phi1), to_degrees(part.phi2)].into()
    });
    Answered {
        pose: Some([pose.x, pose.y, pose.z, to_degrees(pose.alpha)].into_iter().collect()),
        part,
        verdict: judge(machine, &posture, table),
    }
}

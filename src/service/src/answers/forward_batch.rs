//! `/fk/batch`: the working pose for many joint positions.

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::{Machine, TableAngles, forward_working, part_pose};

use super::batch_rows::{CHUNK, ROW_BYTES, Verdict, check_batch, judge, read_row, refuse, report};
use crate::error::Error;
use crate::state::State;
use crate::wire::batch::{FkBatchAnswer, FkBatchRequest, Row};
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::json::write_json;
use crate::wire::parse::parse_body;

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

/// Answers a batch, from its body to the answer's; to be called on the worker threads.
pub(crate) fn answer_fk_batch(body: &[u8], state: &State) -> Result<Vec<u8>, Error> {
    let request: FkBatchRequest<'_> = parse_body(body)?;
    check_batch(request.tool_length, request.joints.len(), state.limits.rows)?;
    let published = state.machines.resolve(&request.machine)?;
    let machine = &published.machine;
    let rows: Vec<_> = request
        .joints
        .par_iter()
        .with_min_len(CHUNK)
        .map(|text| answer_row(machine, request.tool_length, text))
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

fn answer_row(machine: &Machine, tool_length: f64, text: &RawValue) -> Answered {
    let row = match read_row(text, &[3, 5], "[rho1, rho2, rho3] or [rho1, rho2, rho3, theta1, theta2]") {
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

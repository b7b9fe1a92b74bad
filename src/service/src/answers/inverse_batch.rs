//! `/ik/batch`: the working solution for many poses.

use rayon::prelude::*;
use serde_json::value::RawValue;
use verne_solver::{
    Machine, PartPose, Posture, TableAngles, part_working, platform_working, table_angles, tool_working,
};

use super::batch_rows::{CHUNK, ROW_BYTES, Verdict, check_batch, judge, read_row, refuse, report};
use crate::error::Error;
use crate::state::State;
use crate::wire::batch::{IkBatchAnswer, IkBatchRequest, Row};
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::json::write_json;
use crate::wire::parse::parse_body;
use crate::wire::request::Frame;

/// Answers a batch, from its body to the answer's; to be called on the worker threads.
pub(crate) fn answer_ik_batch(body: &[u8], state: &State) -> Result<Vec<u8>, Error> {
    let request: IkBatchRequest<'_> = parse_body(body)?;
    check_batch(request.tool_length, request.poses.len(), state.limits.rows)?;
    let published = state.machines.resolve(&request.machine)?;
    let machine = &published.machine;
    let rows: Vec<_> = request
        .poses
        .par_iter()
        .with_min_len(CHUNK)
        .map(|text| answer_row(machine, request.frame, request.tool_length, text))
        .collect();
    let (joints, verdicts): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let answer =
        IkBatchAnswer { machine: published.id.clone(), joints, report: report(verdicts.into_iter()) };
    write_json(&answer, ROW_BYTES * answer.joints.len())
}

fn answer_row(machine: &Machine, frame: Frame, tool_length: f64, text: &RawValue) -> (Option<Row>, Verdict) {
    let row = match frame {
        Frame::Part => read_row(text, &[5], "[x, y, z, phi1, phi2]"),
        Frame::Platform | Frame::Tool => read_row(text, &[3], "[x, y, z]"),
    };
    let row = match row {
        Ok(row) => row,
        Err(detail) => return (None, Verdict::Invalid(detail)),
    };
    let point = [row[0], row[1], row[2]];
    let outcome = match frame {
        Frame::Platform => platform_working(machine, point).map(|posture| (posture, None)),
        Frame::Tool => tool_working(machine, point, tool_length).map(|posture| (posture, None)),
        Frame::Part => {
            let [x, y, z] = point;
            let (phi1, phi2) = (from_degrees(row[3]), from_degrees(row[4]));
            part_working(machine, &PartPose { x, y, z, phi1, phi2 }, tool_length).map(|posture| {
                let table = table_angles(machine, posture.pose.alpha, phi1, phi2);
                (posture, Some(table))
            })
        }
    };
    match outcome {
        Ok((posture, table)) => (Some(joints(&posture, table)), judge(machine, &posture, table)),
        Err(refusal) => (None, refuse(machine, refusal)),
    }
}

fn joints(posture: &Posture, table: Option<TableAngles>) -> Row {
    let mut row: Row = posture.rho.into_iter().collect();
    if let Some(table) = table {
        row.extend([table.theta1, table.theta2].map(to_degrees));
    }
    row
}

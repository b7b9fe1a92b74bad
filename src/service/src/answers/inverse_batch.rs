//! `/ik/batch`: the working solution for many poses.

use rayon::prelude::*;
use verne_solver::{
    Clearance, Machine, PartPose, Posture, TableAngles, part_working, platform_working, table_angles,
    tool_working,
};

use super::batch_rows::{CHUNK, ROW_BYTES, Shape, Shared, Verdict, check_batch, judge, refuse, report};
use crate::error::Error;
use crate::registry::Registry;
use crate::wire::batch::{IkBatchAnswer, IkBatchNumbers, IkBatchRequest, Row, Rows};
use crate::wire::degrees::{from_degrees, to_degrees};
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
fn read(body: &[u8]) -> Result<Question<'_>, Error> {
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
pub(crate) fn answer_ik_batch(body: &[u8], machines: &Registry, most_rows: usize) -> Result<Vec<u8>, Error> {
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
        Ok((posture, table)) => (Some(joints(&posture, table)), judge(machine, &posture, table, clearance)),
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

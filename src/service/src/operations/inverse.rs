//! `/ik`: which joints bring the machine to a pose.

use verne_solver::{
    Clearance, Machine, Point, Posture, part, part_every_working, platform, platform_working, tool,
    tool_every_working,
};

use crate::operations::nearest;
use crate::operations::orientation::{Orientations, no_orientation, orientations};
use crate::operations::registry::Registry;
use crate::operations::solutions::{Findings, Found, Presentation};
use crate::operations::table_angles::Orientation;
use crate::wire::answer::Answer;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::request::{Frame, IkRequest, Wanted};

/// Answers an inverse question.
pub(crate) fn answer_ik(request: &IkRequest, machines: &Registry) -> Result<Answer, OperationError> {
    let orientations = checked_orientations(request)?;
    let published = machines.resolve(&request.machine)?;
    let machine = &published.machine;
    let point = [request.pose.x, request.pose.y, request.pose.z];
    in_proportion(request, machine)?;
    let findings = match request.frame {
        Frame::Part => in_part(machine, request, point, &orientations),
        Frame::Platform | Frame::Tool => in_base(machine, request, point),
    };
    let IkRequest { tool_length, table_clearance, tool_radius, .. } = *request;
    let clearance = Clearance::of(machine, table_clearance, tool_length, tool_radius);
    let presentation = Presentation {
        published: &published,
        tool_length,
        clearance: clearance.filter(|_| request.frame == Frame::Part),
        wanted: request.solutions,
        near: request.near,
        free: orientations.free,
        joints: true,
    };
    presentation.answer(findings)
}

/// The orientations asked for, once every number of the request has been looked at.
fn checked_orientations(request: &IkRequest) -> Result<Orientations, OperationError> {
    let mut faults = FieldErrors::default();
    let pose = &request.pose;
    for (pointer, value) in [("/pose/x", pose.x), ("/pose/y", pose.y), ("/pose/z", pose.z)] {
        faults.length(pointer, value);
    }
    faults.tool_length(request.tool_length);
    faults.clearance(request.table_clearance, request.tool_radius, request.frame.without_tilt());
    if let Some(near) = &request.near {
        nearest::check(near, &mut faults);
    }
    let orientations = if request.frame == Frame::Part {
        orientations(pose, request.near.as_ref(), &mut faults)
    } else {
        no_orientation(pose, &mut faults);
        Orientations::default()
    };
    faults.into_result().map(|()| orientations)
}

/// Refuses lengths that are too long for the machine.
fn in_proportion(request: &IkRequest, machine: &Machine) -> Result<(), OperationError> {
    let pose = &request.pose;
    let lengths = [
        ("/pose/x", pose.x),
        ("/pose/y", pose.y),
        ("/pose/z", pose.z),
        ("/tool_length", request.tool_length),
    ];
    let mut faults = FieldErrors::default();
    for (pointer, value) in lengths {
        faults.proportion(pointer, value, machine);
    }
    faults.into_result()
}

fn in_part(machine: &Machine, request: &IkRequest, point: Point, asked: &Orientations) -> Findings {
    let mut findings = Findings::default();
    for &[phi1, phi2] in &asked.each {
        let orientation = Orientation::of_radians([phi1, phi2]);
        let target = orientation.at(point);
        let complete = |posture: Posture| {
            let table = orientation.stand(machine, posture.pose.alpha, request.near.as_ref());
            Found { posture, table: Some(table), asked: Some([phi1, phi2]) }
        };
        let solve = if request.solutions == Wanted::All { part } else { part_every_working };
        findings.add(solve(machine, &target, request.tool_length), complete);
    }
    findings
}

fn in_base(machine: &Machine, request: &IkRequest, point: Point) -> Findings {
    let (all, length) = (request.solutions == Wanted::All, request.tool_length);
    let complete = |posture| Found { posture, table: None, asked: None };
    let mut findings = Findings::default();
    match (request.frame == Frame::Tool, all) {
        (true, true) => findings.add(tool(machine, point, length), complete),
        (true, false) => findings.add(tool_every_working(machine, point, length), complete),
        (false, true) => findings.add(platform(machine, point), complete),
        (false, false) => findings.add_one(platform_working(machine, point), complete),
    }
    findings
}

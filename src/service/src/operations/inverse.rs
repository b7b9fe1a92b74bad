//! `/ik`: the joints that bring the machine to a pose.

use arrayvec::ArrayVec;
use verne_solver::certificate::{Scope, certify_part, certify_platform, certify_tool};
use verne_solver::{
    Machine, Point, Posture, part, part_every_working, platform, platform_working, tool, tool_every_working,
};

use crate::operations::jacobians::characteristic_length;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::nearest::check_near;
use crate::operations::requested_orientation::{
    RequestedOrientations, check_no_orientation, enclosed_orientations, requested_orientations,
};
use crate::operations::solutions::{AnswerBuilder, SolutionSet, SolvedPosture};
use crate::operations::table_angles::ToolOrientation;
use crate::wire::answer::Answer;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::jacobian::check_jacobian;
use crate::wire::request::{Frame, IkRequest};

/// Answers a request for joints.
pub(crate) fn answer_ik(request: &IkRequest, machines: &MachineRegistry) -> Result<Answer, OperationError> {
    let orientations = checked_orientations(request)?;
    let machine = machines.resolve(&request.machine)?;
    let point = [request.pose.x, request.pose.y, request.pose.z];
    check_proportions(request, &machine)?;
    let set = match request.frame {
        Frame::Part => in_part(&machine, request, point, &orientations),
        Frame::Platform | Frame::Tool => in_base(&machine, request, point),
    };
    let tool = request.tool();
    let builder = AnswerBuilder {
        machine: &machine,
        tool_length: tool.length,
        clearance: tool.clearance(&machine).filter(|_| request.frame == Frame::Part),
        filter: request.solutions,
        near: request.near,
        free: orientations.free,
        joints: true,
        jacobian: request.jacobian.then(|| characteristic_length(&machine, request.characteristic_length)),
    };
    builder.answer(set)
}

/// Checks every number of the request; the requested orientations.
fn checked_orientations(request: &IkRequest) -> Result<RequestedOrientations, OperationError> {
    let mut faults = FieldErrors::default();
    let pose = &request.pose;
    for (pointer, value) in [("/pose/x", pose.x), ("/pose/y", pose.y), ("/pose/z", pose.z)] {
        faults.length(pointer, value);
    }
    let without_theta1 = request.frame.without_tilt();
    request.tool().check(without_theta1, &mut faults);
    check_jacobian(request.jacobian, request.characteristic_length, without_theta1, &mut faults);
    if let Some(near) = &request.near {
        check_near(near, &mut faults);
    }
    let orientations = if request.frame == Frame::Part {
        requested_orientations(pose, request.near.as_ref(), &mut faults)
    } else {
        check_no_orientation(pose, &mut faults);
        RequestedOrientations::default()
    };
    faults.into_result().map(|()| orientations)
}

/// Refuses lengths that are too long for the machine.
fn check_proportions(request: &IkRequest, machine: &Machine) -> Result<(), OperationError> {
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

fn in_part(
    machine: &Machine,
    request: &IkRequest,
    point: Point,
    requested: &RequestedOrientations,
) -> SolutionSet {
    let (scope, length) = (request.solutions.scope(), request.tool_length);
    let solve = if scope == Scope::All { part } else { part_every_working };
    let enclosed = if request.certified {
        enclosed_orientations(&request.pose, request.near.as_ref())
    } else {
        ArrayVec::new()
    };
    let mut set = SolutionSet::default();
    for (i, &[phi1, phi2]) in requested.each.iter().enumerate() {
        let orientation = ToolOrientation::of_radians([phi1, phi2]);
        let target = orientation.at(point);
        let windings = Some(orientation.windings(machine));
        let complete = |posture: Posture| {
            let table = orientation.table(machine, posture.pose.alpha, request.near.as_ref());
            let requested = Some([phi1, phi2]);
            SolvedPosture { posture, table: Some(table), requested, windings, proof: None }
        };
        let certify = enclosed.get(i).map(|enclosed| {
            move |found: &[Posture]| certify_part(machine, point, enclosed, length, found, scope)
        });
        set.add(solve(machine, &target, length), certify, complete);
    }
    set
}

fn in_base(machine: &Machine, request: &IkRequest, point: Point) -> SolutionSet {
    let (scope, length) = (request.solutions.scope(), request.tool_length);
    let complete =
        |posture| SolvedPosture { posture, table: None, requested: None, windings: None, proof: None };
    let of_tool = request.frame == Frame::Tool;
    let certify = request.certified.then_some(|found: &[Posture]| {
        if of_tool {
            certify_tool(machine, point, length, found, scope)
        } else {
            certify_platform(machine, point, found, scope)
        }
    });
    let mut set = SolutionSet::default();
    match (of_tool, scope) {
        (true, Scope::All) => set.add(tool(machine, point, length), certify, complete),
        (true, Scope::Working) => set.add(tool_every_working(machine, point, length), certify, complete),
        (false, Scope::All) => set.add(platform(machine, point), certify, complete),
        (false, Scope::Working) => {
            set.add(platform_working(machine, point).map(|posture| [posture]), certify, complete);
        }
    }
    set
}

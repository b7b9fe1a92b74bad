//! `/fk`: the poses of platform, tool and part for given joints.

use verne_solver::certificate::{Scope, certify_forward};
use verne_solver::{Posture, forward, forward_working};

use crate::operations::jacobians::characteristic_length;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::nearest::check_near;
use crate::operations::solutions::{AnswerBuilder, SolutionSet, SolvedPosture};
use crate::operations::table_angles::TablePosition;
use crate::wire::answer::Answer;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::jacobian::check_jacobian;
use crate::wire::request::FkRequest;

/// Answers a request for poses.
pub(crate) fn answer_fk(request: &FkRequest, machines: &MachineRegistry) -> Result<Answer, OperationError> {
    let table = checked_table(request)?;
    let machine = machines.resolve(&request.machine)?;
    let rho = request.joints.rho.0;
    let mut faults = FieldErrors::default();
    for (i, &rho) in rho.iter().enumerate() {
        faults.proportion(&format!("/joints/rho/{i}"), rho, &machine);
    }
    faults.into_result()?;
    let complete = |posture| SolvedPosture { posture, table, requested: None, windings: None, proof: None };
    let scope = request.solutions.scope();
    let certify =
        request.certified.then_some(|found: &[Posture]| certify_forward(&machine, rho, found, scope));
    let mut set = SolutionSet::default();
    match scope {
        Scope::All => set.add(forward(&machine, rho), certify, complete),
        Scope::Working => set.add(forward_working(&machine, rho).map(|posture| [posture]), certify, complete),
    }
    let tool = request.tool();
    let builder = AnswerBuilder {
        machine: &machine,
        tool_length: tool.length,
        clearance: table.and_then(|_| tool.clearance(&machine)),
        filter: request.solutions,
        near: request.near,
        free: false,
        joints: false,
        jacobian: request.jacobian.then(|| characteristic_length(&machine, request.characteristic_length)),
    };
    builder.answer(set)
}

/// Checks every number of the request; the table's angles.
fn checked_table(request: &FkRequest) -> Result<Option<TablePosition>, OperationError> {
    let mut faults = FieldErrors::default();
    let joints = &request.joints;
    faults.lengths("/joints/rho", &joints.rho.0);
    faults.angle("/joints/theta1", joints.theta1);
    faults.angle("/joints/theta2", joints.theta2);
    let without_theta1 = joints.theta1.is_none().then_some("needs theta1 and theta2");
    request.tool().check(without_theta1, &mut faults);
    check_jacobian(request.jacobian, request.characteristic_length, without_theta1, &mut faults);
    if let Some(near) = &request.near {
        check_near(near, &mut faults);
    }
    let table = match (joints.theta1, joints.theta2) {
        (Some(theta1), Some(theta2)) => Some(TablePosition::of_degrees([theta1, theta2])),
        (None, None) => None,
        (Some(_), None) => {
            faults.add("/joints/theta2", "is required with theta1");
            None
        }
        (None, Some(_)) => {
            faults.add("/joints/theta1", "is required with theta2");
            None
        }
    };
    faults.into_result().map(|()| table)
}

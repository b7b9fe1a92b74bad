//! `/fk`: where platform, tool and part are for given joints.

use verne_solver::{Clearance, forward, forward_working};

use crate::operations::nearest;
use crate::operations::registry::Registry;
use crate::operations::solutions::{Findings, Found, Presentation};
use crate::operations::table_angles::Stand;
use crate::wire::answer::Answer;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::request::{FkRequest, Wanted};

/// Answers a forward question.
pub(crate) fn answer_fk(request: &FkRequest, machines: &Registry) -> Result<Answer, OperationError> {
    let table = checked_table(request)?;
    let published = machines.resolve(&request.machine)?;
    let rho = request.joints.rho.0;
    let mut faults = FieldErrors::default();
    for (i, &rho) in rho.iter().enumerate() {
        faults.proportion(&format!("/joints/rho/{i}"), rho, &published.machine);
    }
    faults.into_result()?;
    let complete = |posture| Found { posture, table, asked: None };
    let mut findings = Findings::default();
    match request.solutions {
        Wanted::All => findings.add(forward(&published.machine, rho), complete),
        Wanted::Working | Wanted::Feasible => {
            findings.add_one(forward_working(&published.machine, rho), complete);
        }
    }
    let FkRequest { tool_length, table_clearance, tool_radius, .. } = *request;
    let presentation = Presentation {
        published: &published,
        tool_length,
        clearance: table
            .and_then(|_| Clearance::of(&published.machine, table_clearance, tool_length, tool_radius)),
        wanted: request.solutions,
        near: request.near,
        free: false,
        joints: false,
    };
    presentation.answer(findings)
}

/// The table's angles, once every number of the request has been looked at.
fn checked_table(request: &FkRequest) -> Result<Option<Stand>, OperationError> {
    let mut faults = FieldErrors::default();
    let joints = &request.joints;
    faults.lengths("/joints/rho", &joints.rho.0);
    faults.angle("/joints/theta1", joints.theta1);
    faults.angle("/joints/theta2", joints.theta2);
    faults.tool_length(request.tool_length);
    let lacking = joints.theta1.is_none().then_some("needs theta1 and theta2");
    faults.clearance(request.table_clearance, request.tool_radius, lacking);
    if let Some(near) = &request.near {
        nearest::check(near, &mut faults);
    }
    let table = match (joints.theta1, joints.theta2) {
        (Some(theta1), Some(theta2)) => Some(Stand::given([theta1, theta2])),
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

//! Finds the set-up with the greatest reserve.

use std::sync::Arc;

use verne_program::Program;
use verne_solver::toolpath::{ActiveMargin, LeastMargin, place};
use verne_solver::workspace::Observer;

use crate::operations::placement_question::PlacementQuestion;
use crate::operations::program_motions::ProgramMotions;
use crate::operations::program_motions::adjustable::AdjustableMotions;
use crate::operations::solver_errors::plan_error;
use crate::wire::constraint::Unit;
use crate::wire::degrees::to_degrees;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::placement::{
    ActiveObject, GivenSetup, Guarantee, GuaranteeKind, PlacementAnswer, PlacementLinks,
};
use crate::wire::toolpath_report::{MarginObject, Verdict};

/// About the bytes of an answer.
const ANSWER_BYTES: usize = 8192;

/// The answer as it is sent.
pub(crate) fn compute_placement(
    question: &PlacementQuestion,
    program: &Arc<Program>,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let toolpath = &question.toolpath;
    let given = toolpath.motions(program).map_err(OperationError::ProgramFaults)?;
    let motions = AdjustableMotions::new(given, toolpath.request.setup, toolpath.one_tool_length());
    let given = motions.set_up();
    let request = question.placement_request(given.parameters());
    let found = place(&toolpath.machine, &motions, given, &request, &toolpath.plan_options(), observer)
        .map_err(plan_error)?;
    let (setup, tool_length) = motions.stated_setup(&found.set_up);
    let within = given
        .parameters()
        .iter()
        .zip(request.bounds)
        .all(|(value, [low, high])| (low..=high).contains(value));
    let lines = motions.given();
    let answer = PlacementAnswer {
        id: question.id,
        machine: toolpath.machine.id.clone(),
        program: toolpath.request.program,
        request: question.request(),
        verdict: verdict(found.report.is_feasible()),
        t: found.t,
        setup,
        tool_length: toolpath.one_tool_length().map(|_| tool_length),
        given: GivenSetup { verdict: verdict(found.given.1), t: found.given.0, within_bounds: within },
        guarantee: Guarantee { kind: GuaranteeKind::BestOfStarts, starts: found.starts },
        active: found.active.iter().map(|margin| active(lines, margin)).collect(),
        margins: found
            .report
            .least
            .iter()
            .map(|LeastMargin { margin, motion }| MarginObject::new(*margin, lines.line(*motion)))
            .collect(),
        rows: found.report.rows,
        not_checked: Unchecked::beside(toolpath.request.table_clearance.is_some()),
        links: PlacementLinks { itself: question.id.toolpath() },
    };
    write_json(&answer, ANSWER_BYTES)
}

fn verdict(is_feasible: bool) -> Verdict {
    if is_feasible { Verdict::Ok } else { Verdict::Fails }
}

fn active(motions: &ProgramMotions, ActiveMargin { motion, margin, reserve }: &ActiveMargin) -> ActiveObject {
    let Limit { constraint, value, unit, element } = (*margin).into();
    let in_unit = |reserve: f64| if unit == Unit::Degree { to_degrees(reserve) } else { reserve };
    let reserve = reserve.map(in_unit);
    ActiveObject { line: motions.line(*motion), constraint, element, margin: value, unit, reserve }
}

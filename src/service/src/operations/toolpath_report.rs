//! The report on a tool path, from what the planner has found out.

use std::iter::repeat;

use serde::Deserialize;
use verne_solver::toolpath::{Change, Departure, Failure, LeastMargin, Motions, Report};

use crate::operations::dwell_marks::DwellMarks;
use crate::operations::program_motions::ProgramMotions;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::wire::degrees::to_degrees;
use crate::wire::fixed_array::FixedArray;
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::program::WarningObject;
use crate::wire::toolpath_failure::{ChangeObject, FailureObject, FailurePlace};
use crate::wire::toolpath_report::{
    DepartureObject, DeviationObject, JointRanges, MarginObject, PathLengths, ToolpathLinks, ToolpathReport,
    TurningObject, Verdict,
};
use crate::wire::toolpath_time::TimeObject;

/// Whether a report says that the machine can run the program.
pub(crate) fn is_feasible(report: &[u8]) -> bool {
    #[derive(Deserialize)]
    struct VerdictField {
        verdict: Verdict,
    }
    serde_json::from_slice(report).is_ok_and(|field: VerdictField| field.verdict == Verdict::Ok)
}

/// The number of rows that a report states.
pub(crate) fn row_count(report: &[u8]) -> Option<u64> {
    #[derive(Deserialize)]
    struct RowCount {
        rows: u64,
    }
    serde_json::from_slice(report).ok().map(|count: RowCount| count.rows)
}

/// The report. `changes` are those that heal the first failures.
pub(crate) fn report(
    question: &ToolpathQuestion,
    motions: &ProgramMotions,
    planned: &Report,
    changes: &[Option<Change>],
    marks: DwellMarks,
    time: TimeObject,
) -> ToolpathReport {
    let [feed, rapid] = planned.length;
    let [theta1, theta2] = planned.turning.map(to_degrees);
    let read = motions.program().warnings();
    let warnings = motions.warnings.iter().cloned().chain(read.list.iter().cloned().map(WarningObject::from));
    let planning = motions.warnings.iter().map(|warning| u64::from(warning.occurrences)).sum::<u64>();
    ToolpathReport {
        id: question.id,
        machine: question.machine.id.clone(),
        program: question.request.program,
        request: question.request.clone(),
        verdict: if planned.is_feasible() { Verdict::Ok } else { Verdict::Fails },
        failures: planned
            .failures
            .iter()
            .zip(changes.iter().copied().chain(repeat(None)))
            .map(|(failure, change)| failed(motions, failure, change))
            .collect(),
        failure_count: planned.failure_count,
        rows: planned.rows,
        length: PathLengths { feed, rapid },
        time,
        margins: planned
            .least
            .iter()
            .map(|LeastMargin { margin, motion }| MarginObject::new(*margin, motions.line(*motion)))
            .collect(),
        ranges: planned.ranges.map(ranges),
        turning: TurningObject { theta1, theta2 },
        pole_distance: planned.least_inclination.map(to_degrees),
        deviation: DeviationObject { tip: planned.deviation.tip, axis: to_degrees(planned.deviation.axis) },
        preimage_changes: planned.preimage_changes,
        retracts: planned.retracts,
        dwell_marks: marks.list,
        dwell_mark_count: marks.count,
        departures: planned.departures.iter().map(|departure| departed(motions, departure)).collect(),
        departure_count: planned.departure_count,
        warnings: warnings.collect(),
        warning_count: planning + read.total,
        not_checked: Unchecked::beside(question.request.table_clearance.is_some()),
        links: ToolpathLinks {
            itself: question.id.toolpath(),
            rows: format!("{}/rows", question.id.toolpath()),
            program: planned.is_feasible().then(|| format!("{}/program", question.id.toolpath())),
            path: format!("{}/path", question.id.toolpath()),
        },
    }
}

fn failed(motions: &ProgramMotions, failure: &Failure, change: Option<Change>) -> FailureObject {
    let Limit { constraint, value, unit, element } = failure.margin.into();
    let tool_length = motions.motion(failure.motion).tool_length;
    FailureObject {
        lines: failure.motions.map(|motion| motions.line(motion)),
        text: None,
        constraint,
        element,
        margin: value,
        unit,
        at: FailurePlace::new(motions.line(failure.motion), failure, tool_length),
        change: change.map(ChangeObject::from),
    }
}

fn departed(motions: &ProgramMotions, departure: &Departure) -> DepartureObject {
    DepartureObject {
        line: motions.line(departure.motion),
        distance: departure.distance,
        direction: departure
            .distance
            .map(|_| FixedArray(departure.direction.map(|component| component + 0.0))),
    }
}

fn ranges([rho1, rho2, rho3, theta1, theta2]: [[f64; 2]; 5]) -> JointRanges {
    let [rho1, rho2, rho3] = [rho1, rho2, rho3].map(FixedArray);
    let [theta1, theta2] = [theta1, theta2].map(|range| FixedArray(range.map(to_degrees)));
    JointRanges { rho1, rho2, rho3, theta1, theta2 }
}

//! Faults of a program that only its motions show. They are found before a job is made.

use verne_program::{Move, Orientation, Program, ProgramError, ProgramErrors};
use verne_solver::Machine;
use verne_solver::toolpath::{Curve, Motion, MotionKind, Motions, Turning};

use crate::operations::program_motions::sections::{MOST_FAULTS, Section};
use crate::wire::field_errors::out_of_proportion;
use crate::wire::toolpath::OrientationName;

/// Sine of the angle below which two axes are opposite.
const OPPOSITE: f64 = 1e-9;

/// The program behind its motions, with the machine.
pub(crate) struct Checked<'a> {
    pub(crate) program: &'a Program,
    pub(crate) sections: &'a [Section],
    pub(crate) orientation: Option<OrientationName>,
    pub(crate) machine: &'a Machine,
}

impl Checked<'_> {
    /// Whether the tool, its length or the origin are others than in the move before.
    fn begins_section(&self, index: usize) -> bool {
        self.sections.binary_search_by_key(&index, |section| section.first as usize).is_ok()
    }
}

/// Checks every motion of a program.
pub(crate) fn check_motions(motions: &impl Motions, checked: &Checked<'_>) -> Result<(), ProgramErrors> {
    let mut faults = Vec::new();
    let mut before: Option<Motion> = None;
    for (index, step) in checked.program.moves().iter().enumerate() {
        let motion = motions.motion(index);
        if let Some(detail) = fault(checked, index, step, &motion, before.as_ref()) {
            if faults.len() == MOST_FAULTS {
                return Err(ProgramErrors { errors: faults, complete: false });
            }
            faults.push(ProgramError { line: step.line(), column: 1, word: String::new(), detail });
        }
        before = Some(motion);
    }
    if faults.is_empty() { Ok(()) } else { Err(ProgramErrors { errors: faults, complete: true }) }
}

fn fault(
    checked: &Checked<'_>,
    index: usize,
    step: &Move,
    motion: &Motion,
    before: Option<&Motion>,
) -> Option<String> {
    if let Some(detail) = out_of_reach(motion, checked.machine) {
        return Some(detail);
    }
    let is_vector = matches!(step.orientation(), Orientation::Vector(_));
    if checked.orientation == Some(OrientationName::Rotary) && is_vector {
        return Some(
            "orientation=rotary needs rotary words (A and C, B and C, or phi1 and phi2) in every move"
                .to_owned(),
        );
    }
    if index > 0 && checked.begins_section(index) && checked.program.arc(step).is_some() {
        return Some(
            "an arc needs a point to begin at, after a change of tool, length or origin; put one before"
                .to_owned(),
        );
    }
    let before = before.filter(|_| motion.kind == MotionKind::Feed)?;
    let could_turn_either_way =
        matches!(motion.turning, Turning::GreatCircle) && are_opposite(before.end.axis, motion.end.axis);
    could_turn_either_way.then(|| {
        "the axis is opposite to the one before, so it could turn either way; \
         put a point with an axis between them, or make the move a rapid"
            .to_owned()
    })
}

/// Lengths for which the solver has no answer.
fn out_of_reach(motion: &Motion, machine: &Machine) -> Option<String> {
    let centre = match motion.curve {
        Curve::Line => [0.0; 3],
        Curve::Arc { centre, .. } => centre,
    };
    let lengths = motion.end.tip.into_iter().chain(centre).chain([motion.tool_length]);
    let beyond = |length| out_of_proportion(length, machine);
    lengths
        .into_iter()
        .find_map(beyond)
        .map(|detail| format!("a length of the move, with its set-up, {detail}"))
}

fn are_opposite(a: [f64; 3], b: [f64; 3]) -> bool {
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    dot < 0.0 && cross.iter().map(|c| c * c).sum::<f64>() < OPPOSITE * OPPOSITE
}

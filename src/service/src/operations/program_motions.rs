//! The motions of a program in the part frame, as the planner reads them. They are made one by one from the program's
//! moves: a second list of a million motions would take more memory than the program.

pub(crate) mod adjustable;
pub(crate) mod check;
pub(crate) mod frame;
pub(crate) mod sections;
pub(crate) mod tool_lengths;

use std::sync::Arc;

use verne_program::{Move, MoveKind, Orientation, Program, ProgramErrors};
use verne_solver::Machine;
use verne_solver::toolpath::{Curve, Motion, MotionKind, Motions, ToolPosition, Turning};

use crate::operations::program_motions::check::{Checked, check_motions};
use crate::operations::program_motions::frame::Frame;
use crate::operations::program_motions::sections::{Section, Sections};
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::program::WarningObject;
use crate::wire::toolpath::OrientationName;

/// The motions of a program with its set-up and its tools.
pub(crate) struct ProgramMotions {
    program: Arc<Program>,
    sections: Vec<Section>,
    frames: Vec<Frame>,
    orientation: Option<OrientationName>,
    hold_rotary: bool,
    /// What the plan takes from the program instead of the request.
    pub warnings: Vec<WarningObject>,
}

impl ProgramMotions {
    /// The motions of a program for a request.
    ///
    /// # Errors
    ///
    /// The lines whose motion is unknown or impossible on every machine of this size: without a length, without an
    /// origin, with an axis that could turn either way.
    pub(crate) fn new(
        program: Arc<Program>,
        request: &CanonicalToolpath,
        machine: &Machine,
    ) -> Result<Self, ProgramErrors> {
        let Sections { list: sections, frames, warnings } = Sections::of(&program, request)?;
        let CanonicalToolpath { orientation, hold_rotary, .. } = *request;
        let motions = Self { program, sections, frames, orientation, hold_rotary, warnings };
        let Self { program, sections, .. } = &motions;
        check_motions(&motions, &Checked { program, sections, orientation, machine })?;
        Ok(motions)
    }

    /// The program.
    pub(crate) fn program(&self) -> &Program {
        &self.program
    }

    /// The line of a motion.
    pub(crate) fn line(&self, index: usize) -> u32 {
        self.program.moves().get(index).map_or(0, Move::line)
    }

    fn frame(&self, index: usize) -> &Frame {
        &self.frames[self.section(index).frame as usize]
    }

    fn section(&self, index: usize) -> &Section {
        let after = self.sections.partition_point(|section| section.first as usize <= index);
        // The first section begins at the first move.
        &self.sections[after.saturating_sub(1)]
    }

    /// The motion of the axis between two moves' ends, each with its frame.
    fn turning(&self, [(start, before), (end, frame)]: [(&Move, &Frame); 2]) -> Turning {
        if self.orientation == Some(OrientationName::Vector) {
            return Turning::GreatCircle;
        }
        let words = |step: &Move| match step.orientation() {
            Orientation::Rotary { phi1, phi2 } => Some([phi1, phi2]),
            Orientation::Vector(_) => None,
        };
        let (Some(start), Some(end)) = (words(start), words(end)) else { return Turning::GreatCircle };
        if self.hold_rotary {
            let turned = |[phi1, phi2]: [f64; 2], frame: &Frame| [phi1, phi2 + frame.azimuth()];
            return Turning::Held { start: turned(start, before), end: turned(end, frame) };
        }
        // In another frame, the axis before the move has other words.
        if before.rotation == frame.rotation {
            Turning::Angles { start, end, frame: frame.rotation }
        } else {
            Turning::GreatCircle
        }
    }

    fn curve(&self, end: &Move, frame: &Frame) -> Curve {
        self.program.arc(end).map_or(Curve::Line, |arc| Curve::Arc {
            centre: frame.point(arc.centre()),
            normal: frame.direction(arc.normal()),
            sweep: arc.sweep(),
        })
    }
}

impl Motions for ProgramMotions {
    fn count(&self) -> usize {
        self.program.moves().len()
    }

    fn motion(&self, index: usize) -> Motion {
        let section = self.section(index);
        let frame = &self.frames[section.frame as usize];
        let moves = self.program.moves();
        let end = &moves[index];
        let position = ToolPosition { tip: frame.point(end.tip()), axis: frame.direction(end.axis()) };
        let (kind, curve, turning) = match index.checked_sub(1) {
            Some(before) if section.first as usize != index => {
                (moving(end), self.curve(end, frame), self.turning([(&moves[before], frame), (end, frame)]))
            }
            Some(before) if section.by.keeps_joints(end.kind()) => {
                (moving(end), Curve::Line, self.turning([(&moves[before], self.frame(before)), (end, frame)]))
            }
            _ => (MotionKind::Arrive, Curve::Line, self.turning([(end, frame); 2])),
        };
        Motion { kind, end: position, curve, turning, tool_length: section.tool_length }
    }
}

fn moving(step: &Move) -> MotionKind {
    match step.kind() {
        MoveKind::Feed => MotionKind::Feed,
        MoveKind::Rapid => MotionKind::Rapid,
    }
}

#[cfg(test)]
#[allow(clippy::panic, clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

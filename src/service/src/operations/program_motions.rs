//! The motions of a program in the part frame, as the planner reads them. They are made one by one from the program's
//! moves: a second list of a million motions would take more memory than the program.

pub(crate) mod check;
pub(crate) mod frame;
pub(crate) mod sections;
pub(crate) mod tool_lengths;

use std::sync::Arc;

use verne_program::{Move, MoveKind, Orientation, Program, ProgramErrors};
use verne_solver::Machine;
use verne_solver::toolpath::{Curve, Motion, MotionKind, Motions, ToolPosition, Turning};

use crate::operations::program_motions::check::check_motions;
use crate::operations::program_motions::frame::Frame;
use crate::operations::program_motions::sections::{Begins, Section, Sections};
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::program::WarningObject;
use crate::wire::toolpath::OrientationName;

/// The motions of a program with its set-up and its tools.
pub(crate) struct ProgramMotions {
    program: Arc<Program>,
    sections: Vec<Section>,
    frames: Vec<Frame>,
    orientation: Option<OrientationName>,
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
        let motions = Self { program, sections, frames, orientation: request.orientation, warnings };
        check_motions(&motions.program, &motions, request.orientation, machine)?;
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

    fn section(&self, index: usize) -> &Section {
        let after = self.sections.partition_point(|section| section.first as usize <= index);
        // The first section begins at the first move.
        &self.sections[after.saturating_sub(1)]
    }

    fn turning(&self, start: &Move, end: &Move, frame: &Frame) -> Turning {
        if self.orientation == Some(OrientationName::Vector) {
            return Turning::GreatCircle;
        }
        match (start.orientation(), end.orientation()) {
            (Orientation::Rotary { phi1: start1, phi2: start2 }, Orientation::Rotary { phi1, phi2 }) => {
                Turning::Angles { start: [start1, start2], end: [phi1, phi2], frame: frame.rotation }
            }
            _ => Turning::GreatCircle,
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
        let end = &self.program.moves()[index];
        let before = index.checked_sub(1).map(|before| &self.program.moves()[before]);
        let is_feed = end.kind() == MoveKind::Feed;
        let arrives = section.first as usize == index
            && match section.begins {
                Begins::Anywhere => true,
                // A rapid ends a cut by itself.
                Begins::AfterCut => is_feed,
            };
        let position = ToolPosition { tip: frame.point(end.tip()), axis: frame.direction(end.axis()) };
        let (kind, curve, turning) = match before {
            Some(start) if !arrives => {
                let kind = if is_feed { MotionKind::Feed } else { MotionKind::Rapid };
                (kind, self.curve(end, frame), self.turning(start, end, frame))
            }
            _ => (MotionKind::Arrive, Curve::Line, Turning::GreatCircle),
        };
        Motion { kind, end: position, curve, turning, tool_length: section.tool_length }
    }
}

#[cfg(test)]
#[allow(clippy::panic, clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

//! A program whose set-up may change.

use std::sync::Arc;

use verne_solver::toolpath::{AdjustableProgram, Motions, SetUp};

use crate::operations::program_motions::ProgramMotions;
use crate::operations::program_motions::frame::Frame;
use crate::operations::program_motions::sections::Section;
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::toolpath::Setup;

/// The index of the frame that `setup` states.
const SETUP: u32 = 0;
/// Digits after the point of lengths, mm, and of angles, degrees, as powers of ten.
const LENGTH_DIGITS: f64 = 1e6;
const ANGLE_DIGITS: f64 = 1e7;

/// A program whose `setup` and tool may change.
pub(crate) struct AdjustableMotions {
    given: ProgramMotions,
    setup: Setup,
    /// The stated length of the tool, mm; 0 if the program has several lengths.
    tool_length: f64,
}

impl AdjustableMotions {
    /// A program in a given set-up.
    pub(crate) fn new(given: ProgramMotions, setup: Setup, tool_length: Option<f64>) -> Self {
        Self { given, setup, tool_length: tool_length.unwrap_or_default() }
    }

    /// The motions in the given set-up.
    pub(crate) fn given(&self) -> &ProgramMotions {
        &self.given
    }

    /// The given set-up.
    pub(crate) fn set_up(&self) -> SetUp {
        let Setup { x, y, z, c, .. } = self.setup;
        SetUp { origin: [x, y, z], turn: from_degrees(c), tool_length: self.tool_length }
    }

    /// A set-up as the wire states it: `setup`, and the length of the tool, mm.
    pub(crate) fn stated_setup(&self, set_up: &SetUp) -> (Setup, f64) {
        let rounded = |number: f64, digits: f64| (number * digits).round() / digits + 0.0;
        // A number that has not changed keeps all its digits.
        let kept = |number: f64, given: f64, digits: f64| {
            if number.to_bits() == given.to_bits() { given } else { rounded(number, digits) }
        };
        let given = self.set_up();
        let [x, y, z]: [f64; 3] =
            std::array::from_fn(|i| kept(set_up.origin[i], given.origin[i], LENGTH_DIGITS));
        let c = if set_up.turn.to_bits() == given.turn.to_bits() {
            self.setup.c
        } else {
            rounded(to_degrees(set_up.turn), ANGLE_DIGITS)
        };
        let tool_length = kept(set_up.tool_length, given.tool_length, LENGTH_DIGITS);
        (Setup { x, y, z, c, ..self.setup }, tool_length)
    }

    /// The motions in another set-up.
    pub(crate) fn with_setup(&self, setup: &Setup, tool_length: f64) -> ProgramMotions {
        let longer = tool_length - self.tool_length;
        let mut frames = self.given.frames.clone();
        frames[SETUP as usize] = Frame::of(setup);
        let section = |section: &Section| Section { tool_length: section.tool_length + longer, ..*section };
        ProgramMotions {
            program: Arc::clone(&self.given.program),
            sections: self.given.sections.iter().map(section).collect(),
            frames,
            warnings: Vec::new(),
            ..self.given
        }
    }
}

impl AdjustableProgram for AdjustableMotions {
    fn motions(&self, set_up: &SetUp) -> Box<dyn Motions + '_> {
        let (setup, tool_length) = self.stated_setup(set_up);
        Box::new(self.with_setup(&setup, tool_length))
    }

    fn is_adjusted(&self, index: usize) -> bool {
        self.given.section(index).frame == SETUP
    }

    fn stated(&self, set_up: &SetUp) -> SetUp {
        let (Setup { x, y, z, c, .. }, tool_length) = self.stated_setup(set_up);
        SetUp { origin: [x, y, z], turn: from_degrees(c), tool_length }
    }
}

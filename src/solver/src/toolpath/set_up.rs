//! The set-up of a program: where its frame is in the part frame, and the length of the tool.

use super::motion::Motions;
use crate::pose::Point;

/// The numbers of a set-up that a change of clamping or tool changes. Lengths are millimetres, angles radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SetUp {
    /// The origin of the program's frame in the part frame.
    pub origin: Point,
    /// The rotation of the program's frame about z of the part frame; rotations about x and y precede it and stay.
    pub turn: f64,
    /// The length of the tool.
    pub tool_length: f64,
}

impl SetUp {
    /// Number of parameters.
    pub const PARAMETERS: usize = 5;

    /// The parameters: x, y, z of the origin, turn, and tool length.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::toolpath::SetUp;
    ///
    /// let set_up = SetUp { origin: [1.0, 2.0, 3.0], turn: 0.5, tool_length: 100.0 };
    /// assert_eq!(set_up.parameters(), [1.0, 2.0, 3.0, 0.5, 100.0]);
    /// assert_eq!(SetUp::of_parameters(set_up.parameters()), set_up);
    /// ```
    pub fn parameters(&self) -> [f64; Self::PARAMETERS] {
        let [x, y, z] = self.origin;
        [x, y, z, self.turn, self.tool_length]
    }

    /// The set-up with these [`Self::parameters`].
    pub fn of_parameters([x, y, z, turn, tool_length]: [f64; Self::PARAMETERS]) -> Self {
        Self { origin: [x, y, z], turn, tool_length }
    }
}

/// A program whose set-up may change.
pub trait AdjustableProgram: Sync {
    /// The program's motions with another set-up.
    fn motions(&self, set_up: &SetUp) -> Box<dyn Motions + '_>;

    /// Whether the set-up is the frame of a motion. The motions of other work offsets stay; the tool's length counts
    /// for all.
    fn is_adjusted(&self, index: usize) -> bool;

    /// The set-up with the digits that an answer states: [`Self::motions`] has the same motions for both.
    fn stated(&self, set_up: &SetUp) -> SetUp;
}

//! Writer of joint programs: rows of joints become blocks of G-code for a controller that interpolates the joints.
//!
//! A block has one word for each of five axes. The program knows nothing of the tool: tool lengths, set-up and
//! tool-centre-point control are already in the joints, and the first block switches the controller's own off. The
//! controller's work offsets must be zero, or those that the axes' offsets state.
//!
//! - Positions are absolute and in millimetres and degrees. A word that equals the last one written is left out.
//! - A row of which all words equal the last ones makes no block: its duration counts in the next one. So inverse time
//!   never divides by zero.
//! - In inverse time every G1 block has an F word: one over its duration in minutes. Per minute, F is the speed of the
//!   tip in mm/min; where the tip stands still, that of the rotary axes in deg/min.
//! - Events stand before the block that they stand before in the program. The block after an event is complete.
//! - Of the texts for the controller (INSERT) only M, S and T words are passed on, and none that ends the program or
//!   calls another one. Every other text is a comment: it could move the axes, or change what the words mean.
//! - Texts cannot end a comment: parentheses become brackets, and what is not printable ASCII is replaced.

mod error;
mod event_lines;
mod numbers;
mod options;
mod text;
mod words;
mod writer;

pub use error::{JointProgramError, OptionsError};
pub use options::{FeedWord, JointAxis, JointProgramOptions, RapidWord};
pub use writer::JointProgramWriter;

/// One row: the joints to which the machine moves, all of them linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRow {
    /// The index of the program's move that the row belongs to: events that stand before this move come first.
    pub step: usize,
    /// The line of the program that states the move, from 1.
    pub line: u32,
    /// Whether the row is a place of a rapid, which may be G0.
    pub rapid: bool,
    /// rho1, rho2, rho3 in mm, theta1, theta2 in radians.
    pub joints: [f64; 5],
    /// The tip in the part frame, mm.
    pub tip: [f64; 3],
    /// The time from the row before to this one, s.
    pub duration: Option<f64>,
}

/// The size of a written program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct JointProgramSummary {
    /// Number of G0 and G1 blocks.
    pub blocks: u64,
    /// Number of rows without a block, since all their words equal the last ones.
    pub merged: u64,
    /// Number of blocks whose duration needs a greater F than is allowed; they take longer. A comment counts them.
    pub limited: u64,
}

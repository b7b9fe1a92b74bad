//! Why there is no joint program.

use std::fmt;
use std::io;

/// An option that cannot be met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OptionsError {
    /// The field of [`JointProgramOptions`](super::JointProgramOptions).
    pub option: &'static str,
    /// The values that would be accepted.
    pub detail: String,
}

impl fmt::Display for OptionsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.option, self.detail)
    }
}

impl std::error::Error for OptionsError {}

/// Why a joint program cannot be written.
#[derive(Debug)]
pub enum JointProgramError {
    /// An option cannot be met.
    Options(OptionsError),
    /// A feed row has no duration: neither a feed nor the drives decide.
    NoDuration {
        /// The line of the program that states the move.
        line: u32,
    },
    /// A word has more digits than a number can hold.
    OutOfRange {
        /// The line of the program that states the move.
        line: u32,
        /// The letter of the word.
        letter: char,
    },
    /// The program cannot be written to its destination.
    Write(io::Error),
}

impl fmt::Display for JointProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Options(error) => error.fmt(f),
            Self::NoDuration { line } => write!(
                f,
                "line {line}: the move has no duration, so there is no F word; state a feed in the program, or the \
                 drives of the machine"
            ),
            Self::OutOfRange { line, letter } => {
                write!(f, "line {line}: the word {letter} is too large to be written; state fewer decimals")
            }
            Self::Write(error) => write!(f, "cannot write the joint program: {error}"),
        }
    }
}

impl std::error::Error for JointProgramError {}

impl From<OptionsError> for JointProgramError {
    fn from(error: OptionsError) -> Self {
        Self::Options(error)
    }
}

impl From<io::Error> for JointProgramError {
    fn from(error: io::Error) -> Self {
        Self::Write(error)
    }
}

//! The reports of a reader: faults that refuse a program, and warnings that do not.

use std::fmt;
use std::io;

use serde::{Deserialize, Serialize};

/// One fault of a program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProgramError {
    /// The physical line, from 1. Blank lines and comments count.
    pub line: u32,
    /// The byte in the line where the word begins, from 1.
    pub column: u32,
    /// The word that is at fault, at most 64 characters of it.
    pub word: String,
    /// The fault, and what would be accepted.
    pub detail: String,
}

impl fmt::Display for ProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, word, detail } = self;
        if word.is_empty() {
            write!(f, "line {line}, column {column}: {detail}")
        } else {
            write!(f, "line {line}, column {column}, \"{word}\": {detail}")
        }
    }
}

impl std::error::Error for ProgramError {}

/// Why a program is refused: its faults, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProgramErrors {
    /// At least one and at most 20 faults.
    pub errors: Vec<ProgramError>,
    /// Whether the reader reached the end of the program. It stops at the 20th fault, and at data that is no text.
    pub complete: bool,
}

impl fmt::Display for ProgramErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.errors.iter().enumerate() {
            let separator = if i == 0 { "" } else { "; " };
            write!(f, "{separator}{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for ProgramErrors {}

/// The reason why a source gives no program.
#[derive(Debug)]
pub enum ReadError {
    /// The source cannot be read.
    Source(io::Error),
    /// The program has faults.
    Program(ProgramErrors),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Source(error) => write!(f, "cannot read the program: {error}"),
            Self::Program(errors) => errors.fmt(f),
        }
    }
}

impl std::error::Error for ReadError {}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        Self::Source(error)
    }
}

impl From<ProgramErrors> for ReadError {
    fn from(errors: ProgramErrors) -> Self {
        Self::Program(errors)
    }
}

/// Something in a program that its author should know. Equal warnings are listed once.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warning {
    /// The first line that it concerns, from 1.
    pub line: u32,
    /// The word that it concerns, at most 64 characters of it.
    pub word: String,
    /// The reader's action.
    pub detail: String,
    /// How many lines it concerns.
    pub occurrences: u32,
}

/// The warnings of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warnings {
    /// At most 100 different warnings, in the order of their first lines.
    pub list: Vec<Warning>,
    /// The number of all occurrences, also of those that are not in the list.
    pub total: u64,
}

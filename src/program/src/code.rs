//! G and M codes.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::numerals::tenths;

/// A G or M code, with at most one digit after the point: `M428`, `G43.4`.
///
/// ```
/// use verne_program::Code;
///
/// let code: Code = "g43.4".parse()?;
/// assert_eq!(code.to_string(), "G43.4");
/// assert_eq!("M08".parse::<Code>()?.to_string(), "M8");
/// assert!("X1".parse::<Code>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Code {
    kind: CodeKind,
    tenths: u32,
}

/// The letter of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum CodeKind {
    G,
    M,
}

impl Code {
    /// A code with the number `tenths / 10`.
    pub(crate) fn new(kind: CodeKind, tenths: u32) -> Self {
        Self { kind, tenths }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letter = match self.kind {
            CodeKind::G => 'G',
            CodeKind::M => 'M',
        };
        write!(f, "{letter}{}", self.tenths / 10)?;
        match self.tenths % 10 {
            0 => Ok(()),
            tenth => write!(f, ".{tenth}"),
        }
    }
}

impl FromStr for Code {
    type Err = String;

    /// Reads a code: G or M with a number.
    ///
    /// # Errors
    ///
    /// A sentence that says what is accepted.
    fn from_str(text: &str) -> Result<Self, String> {
        let accepted =
            || "a code is G or M and a number up to 99999 with at most one decimal, as M428 or G43.4";
        let kind = match text.as_bytes().first() {
            Some(b'G' | b'g') => CodeKind::G,
            Some(b'M' | b'm') => CodeKind::M,
            _ => return Err(accepted().to_owned()),
        };
        tenths(&text[1..]).map(|tenths| Self { kind, tenths }).ok_or_else(|| accepted().to_owned())
    }
}

impl TryFrom<String> for Code {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Code> for String {
    fn from(code: Code) -> Self {
        code.to_string()
    }
}

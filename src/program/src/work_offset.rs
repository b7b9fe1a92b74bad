//! Work offsets: the origins G54 to G59.3.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The names in the order of their numbers.
const NAMES: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];

/// A work offset: one of the nine origins that a program can call.
///
/// ```
/// use verne_program::WorkOffset;
///
/// let offset: WorkOffset = "G59.1".parse()?;
/// assert_eq!((offset.number(), offset.name()), (7, "G59.1"));
/// assert_eq!(WorkOffset::default().name(), "G54");
/// assert!("G60".parse::<WorkOffset>().is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct WorkOffset(u8);

impl WorkOffset {
    /// The offset of a number from 1 (G54) to 9 (G59.3).
    pub fn new(number: u8) -> Option<Self> {
        let offset = Self(number.checked_sub(1)?);
        offset.is_valid().then_some(offset)
    }

    /// From 1 (G54) to 9 (G59.3).
    pub fn number(self) -> u8 {
        self.0 + 1
    }

    /// From `G54` to `G59.3`.
    pub fn name(self) -> &'static str {
        NAMES.get(usize::from(self.0)).copied().unwrap_or_default()
    }

    /// Whether there is an offset of this number; bytes from elsewhere may have others.
    pub(crate) fn is_valid(self) -> bool {
        usize::from(self.0) < NAMES.len()
    }
}

impl fmt::Display for WorkOffset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for WorkOffset {
    type Err = String;

    /// Reads a name from `G54` to `G59.3`.
    ///
    /// # Errors
    ///
    /// A sentence that says what is accepted.
    fn from_str(name: &str) -> Result<Self, String> {
        (0..)
            .zip(NAMES)
            .find(|(_, known)| known.eq_ignore_ascii_case(name))
            .map(|(index, _)| Self(index))
            .ok_or_else(|| "work offsets are G54 to G59, G59.1, G59.2 and G59.3".to_owned())
    }
}

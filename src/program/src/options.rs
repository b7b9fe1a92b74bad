//! What a request says about reading.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The unit of lengths in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Units {
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetres,
    /// Inches of 25.4 mm.
    #[serde(rename = "inch")]
    Inches,
}

impl Units {
    /// The length of one unit in millimetres.
    ///
    /// ```
    /// assert_eq!(verne_program::Units::Inches.millimetres(), 25.4);
    /// ```
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Millimetres => 1.0,
            Self::Inches => 25.4,
        }
    }
}

impl fmt::Display for Units {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Millimetres => "mm",
            Self::Inches => "inch",
        })
    }
}

impl FromStr for Units {
    type Err = String;

    /// Reads `mm` or `inch`.
    ///
    /// # Errors
    ///
    /// A sentence that says what is accepted.
    ///
    /// ```
    /// use verne_program::Units;
    ///
    /// assert_eq!("inch".parse(), Ok(Units::Inches));
    /// assert!("furlong".parse::<Units>().is_err());
    /// ```
    fn from_str(text: &str) -> Result<Self, String> {
        match text.to_ascii_lowercase().as_str() {
            "mm" => Ok(Self::Millimetres),
            "inch" => Ok(Self::Inches),
            _ => Err("units are mm or inch".to_owned()),
        }
    }
}

/// What to do with cutter radius compensation (CUTCOM). The points of a program are the tool's path either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compensation {
    /// It is a warning.
    #[default]
    Accept,
    /// It is a fault.
    Refuse,
}

/// How a program is read. Its serialised form, which is part of the ids of programs, is what a client can choose: it
/// leaves out the limit.
///
/// ```
/// use verne_program::{ReadOptions, Units};
///
/// let options = ReadOptions { units: Some(Units::Inches), ..ReadOptions::default() };
/// assert_eq!(options.most_moves, 10_000_000);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ReadOptions {
    /// The unit of lengths if the program states none. CL text without either is refused; rows are then millimetres.
    pub units: Option<Units>,
    /// What to do with cutter radius compensation.
    pub compensation: Compensation,
    /// The most moves that a program may have. A move takes 72 bytes of memory, an arc 56 more.
    #[serde(skip)]
    pub most_moves: usize,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { units: None, compensation: Compensation::default(), most_moves: 10_000_000 }
    }
}

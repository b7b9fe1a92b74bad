//! The options of a request for reading.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::code::Code;

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

/// The treatment of cutter radius compensation (CUTCOM). The points of a program are the tool's path either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compensation {
    /// It is a warning.
    #[default]
    Accept,
    /// It is a fault.
    Refuse,
}

/// The sense in which a program counts the words A, B and C.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RotarySense {
    /// The words turn the tool relative to the work (ISO 841).
    #[default]
    Tool,
    /// The words turn the table, the other way.
    Table,
}

/// How a program is read. Its serialised form, which is part of the ids of programs, is what a client can choose: it
/// leaves out the limit.
///
/// ```
/// use verne_program::{ReadOptions, Units};
///
/// let options = ReadOptions { units: Some(Units::Inches), ..ReadOptions::default() };
/// assert_eq!(options.most_moves, 10_000_000);
/// let text = r#"{"units": "inch", "tcp_on": ["M428"], "tcp_off": ["M429"], "rotary_sense": "table"}"#;
/// let options: ReadOptions = serde_json::from_str(text)?;
/// assert_eq!(options.tcp_on[0].to_string(), "M428");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReadOptions {
    /// The unit of lengths if the program states none. CL text without either is refused; G-code and rows are then
    /// millimetres.
    pub units: Option<Units>,
    /// The treatment of cutter radius compensation.
    pub compensation: Compensation,
    /// G-code: the tool centre point is controlled throughout, whatever the program states.
    pub tcp: bool,
    /// G-code: further codes that begin control of the tool centre point. A code that is also in `tcp_off` ends the
    /// control if it is on, and begins it otherwise.
    pub tcp_on: Vec<Code>,
    /// G-code: further codes that end control of the tool centre point.
    pub tcp_off: Vec<Code>,
    /// G-code: moves with at least this feed in mm/min are rapids.
    pub rapid_feed: Option<f64>,
    /// G-code: the sense of the words A, B and C.
    pub rotary_sense: RotarySense,
    /// The most moves that a program may have. A move takes 72 bytes of memory, an arc 56 more.
    #[serde(skip)]
    pub most_moves: usize,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self {
            units: None,
            compensation: Compensation::default(),
            tcp: false,
            tcp_on: Vec::new(),
            tcp_off: Vec::new(),
            rapid_feed: None,
            rotary_sense: RotarySense::default(),
            most_moves: 10_000_000,
        }
    }
}

//! How a joint program is written.

use super::error::OptionsError;
use super::text::is_line;

/// The letters of axes.
const LETTERS: &str = "ABCUVWXYZ";
/// The most decimals of a word.
const MOST_DECIMALS: u8 = 8;
/// The most lines of head or foot.
const MOST_LINES: usize = 100;
/// The largest step of block numbers, and the largest block number.
pub(super) const LARGEST_NUMBER: u32 = 99_999;

/// The axis of a controller that moves a joint: its word is `sign` · joint + `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAxis {
    /// One of A, B, C, U, V, W, X, Y, Z.
    pub letter: char,
    /// Whether the axis counts against the joint.
    pub negative: bool,
    /// The word where the joint is zero: mm for a slider, radians for an angle of the table.
    pub offset: f64,
}

impl JointAxis {
    /// An axis that counts as the joint does, from the same zero.
    ///
    /// ```
    /// let axis = verne_program::joint_program::JointAxis::new('Z');
    /// assert_eq!((axis.letter, axis.negative, axis.offset), ('Z', false, 0.0));
    /// ```
    pub fn new(letter: char) -> Self {
        Self { letter, negative: false, offset: 0.0 }
    }
}

/// The meaning of F words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedWord {
    /// G93: one over the duration of the block, 1/min. It means the same to every controller.
    InverseTime,
    /// G94: speed of the tip in the part, mm/min; of the rotary axes, deg/min, where the tip stands still. A controller
    /// that takes F as the speed of X, Y and Z moves with another speed.
    PerMinute,
}

/// The word of rapids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RapidWord {
    /// G0. The controller decides whether the joints move linearly.
    G0,
    /// G1 with the row's duration. A rapid without a duration, such as the first position, is G0.
    G1,
}

/// How a joint program is written.
///
/// ```
/// use verne_program::joint_program::{JointAxis, JointProgramOptions};
///
/// let mut options = JointProgramOptions::default();
/// assert!(options.check().is_ok());
/// options.axes[4] = JointAxis::new('A');
/// let error = options.check().unwrap_err();
/// assert_eq!(error.to_string(), "axes: the letter A stands for two axes; state five different letters");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct JointProgramOptions {
    /// The axes of rho1, rho2, rho3, theta1 and theta2.
    pub axes: [JointAxis; 5],
    /// Decimals of words in mm, 0 to 8.
    pub length_decimals: u8,
    /// Decimals of words in degrees, 0 to 8.
    pub angle_decimals: u8,
    /// The meaning of F.
    pub feed: FeedWord,
    /// The greatest F.
    pub greatest_feed: f64,
    /// The word of rapids.
    pub rapids: RapidWord,
    /// The step of block numbers, 1 to 99999; without it blocks have no numbers. After 99999 they start again.
    pub numbers: Option<u32>,
    /// Lines before all others, as they are.
    pub head: Vec<String>,
    /// Comments at the head: what the program was made from.
    pub comments: Vec<String>,
    /// The last lines, as they are. They end the program.
    pub foot: Vec<String>,
    /// Whether a comment names the source line where it changes.
    pub source_lines: bool,
}

impl Default for JointProgramOptions {
    fn default() -> Self {
        Self {
            axes: ['X', 'Y', 'Z', 'A', 'C'].map(JointAxis::new),
            length_decimals: 4,
            angle_decimals: 5,
            feed: FeedWord::InverseTime,
            greatest_feed: 99_999.0,
            rapids: RapidWord::G0,
            numbers: None,
            head: Vec::new(),
            comments: Vec::new(),
            foot: vec!["M30".to_owned()],
            source_lines: false,
        }
    }
}

impl JointProgramOptions {
    /// The most by which a word differs from its joint: mm, and radians. It adds to the deviation of the tool path.
    ///
    /// ```
    /// let [length, angle] = verne_program::joint_program::JointProgramOptions::default().rounding();
    /// assert_eq!((length, angle.to_degrees()), (5e-5, 5e-6));
    /// ```
    pub fn rounding(&self) -> [f64; 2] {
        let half = |decimals: u8| 0.5 / 10_f64.powi(i32::from(decimals));
        [half(self.length_decimals), half(self.angle_decimals).to_radians()]
    }

    /// Whether the options can be met.
    pub fn check(&self) -> Result<(), OptionsError> {
        self.check_axes()?;
        for (option, decimals) in
            [("length_decimals", self.length_decimals), ("angle_decimals", self.angle_decimals)]
        {
            if decimals > MOST_DECIMALS {
                return Err(refused(option, format!("a word has 0 to {MOST_DECIMALS} decimals")));
            }
        }
        if !(self.greatest_feed.is_finite() && self.greatest_feed >= 1e-3) {
            return Err(refused("greatest_feed", "the greatest F is a number from 0.001".to_owned()));
        }
        if self.numbers.is_some_and(|step| !(1..=LARGEST_NUMBER).contains(&step)) {
            return Err(refused("numbers", format!("the step of block numbers is 1 to {LARGEST_NUMBER}")));
        }
        for (option, lines) in [("head", &self.head), ("foot", &self.foot)] {
            if lines.len() > MOST_LINES || !lines.iter().all(|line| is_line(line)) {
                let detail =
                    format!("at most {MOST_LINES} lines of at most 200 printable ASCII characters each");
                return Err(refused(option, detail));
            }
        }
        Ok(())
    }

    fn check_axes(&self) -> Result<(), OptionsError> {
        let letters = self.axes.map(|axis| axis.letter);
        for (index, letter) in letters.into_iter().enumerate() {
            if !LETTERS.contains(letter) {
                let detail = format!("{letter:?} is no axis; accepted are the letters {LETTERS}");
                return Err(refused("axes", detail));
            }
            if letters[..index].contains(&letter) {
                let detail = format!("the letter {letter} stands for two axes; state five different letters");
                return Err(refused("axes", detail));
            }
        }
        if self.axes.iter().any(|axis| axis.offset.is_nan() || axis.offset.abs() > 1e6) {
            return Err(refused("axes", "an offset is a number from -1000000 to 1000000".to_owned()));
        }
        Ok(())
    }
}

fn refused(option: &'static str, detail: String) -> OptionsError {
    OptionsError { option, detail }
}

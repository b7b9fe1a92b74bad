//! How a joint program is written: parameters of `GET /toolpath/{id}/program`, and flags of `verne toolpath`.

use clap::{Args, ValueEnum};
use serde::Deserialize;
use utoipa::{IntoParams, ToSchema};
use verne_program::joint_program::{FeedWord, JointAxis, JointProgramOptions, OptionsError, RapidWord};

use crate::wire::degrees::from_degrees;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::fixed_array::JointList;

/// The letters of the axes.
const AXES: &str = "X,Y,Z,A,C";

/// The last line.
const FOOT: &str = "M30";

/// Parameters of GET /toolpath/{id}/program.
#[derive(Debug, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct JointProgramQuery {
    /// The axes of the controller that move rho1, rho2, rho3, theta1 and theta2: five different letters of ABCUVWXYZ,
    /// separated by commas. A minus before a letter says that the axis counts against the joint.
    #[serde(default = "default_axes")]
    #[arg(long, default_value = AXES, allow_hyphen_values = true)]
    #[param(default = "X,Y,Z,A,C")]
    pub axes: String,
    /// The words of the axes where their joints are zero: three numbers in mm, and perhaps two in degrees. The default
    /// is zero.
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub axis_offsets: Option<JointList>,
    /// Decimals of words in mm. Half of the last one adds to the deviation of the sliders;
    /// it may not exceed the tip's tolerance of the tool path.
    #[serde(default = "default_length_decimals")]
    #[arg(long, default_value_t = default_length_decimals())]
    #[param(minimum = 0, maximum = 8, default = 4)]
    pub length_decimals: u8,
    /// Decimals of words in degrees. Half of the last one adds to the deviation of the table;
    /// it may not exceed the axis's tolerance of the tool path.
    #[serde(default = "default_angle_decimals")]
    #[arg(long, default_value_t = default_angle_decimals())]
    #[param(minimum = 0, maximum = 8, default = 5)]
    pub angle_decimals: u8,
    /// The meaning of F.
    #[serde(default)]
    #[arg(long, default_value = "inverse_time")]
    #[param(inline)]
    pub feed_word: FeedWordName,
    /// The greatest F. A comment at the end of the program counts the blocks that need more; they take longer.
    #[serde(default = "default_greatest_feed")]
    #[arg(long, default_value_t = default_greatest_feed())]
    #[param(minimum = 0.001, default = 99_999.0)]
    pub greatest_feed: f64,
    /// The word of rapids.
    #[serde(default)]
    #[arg(long, default_value = "g0")]
    #[param(inline)]
    pub rapid_word: RapidWordName,
    /// The step of block numbers (N). Without it, blocks have no numbers.
    #[arg(long, value_name = "STEP")]
    #[param(minimum = 1, maximum = 99_999, nullable = false)]
    pub numbers: Option<u32>,
    /// Lines before all others, such as `%` and the number of the program.
    #[arg(long, value_name = "LINES")]
    #[param(nullable = false)]
    pub head: Option<String>,
    /// The last lines. They end the program.
    #[serde(default = "default_foot")]
    #[arg(long, value_name = "LINES", default_value = FOOT)]
    #[param(default = "M30")]
    pub foot: String,
    /// Whether a comment names the line of the program where it changes.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub source_lines: bool,
}

/// The meaning of F: `inverse_time`, one over the duration of the block in minutes (G93), which means the same to every
/// controller; `per_minute`, the speed of the tip in the part, mm/min, and of the table, deg/min, where the tip stands
/// still (G94).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[value(rename_all = "snake_case")]
#[schema(default = "inverse_time")]
pub(crate) enum FeedWordName {
    /// One over the duration of the block in minutes: G93.
    #[default]
    InverseTime,
    /// Speed of the tip, or of the table where the tip stands still: G94.
    PerMinute,
}

/// The word of rapids: `g0`, in which the controller decides whether the joints move linearly; `g1`, with the duration
/// of the row, which needs the drives of the machine. The first position is G0. Retracts, rewinds and approaches that
/// have a duration are G1 in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(default = "g0")]
pub(crate) enum RapidWordName {
    /// The controller decides whether the joints move linearly.
    #[default]
    G0,
    /// With the duration of the row.
    G1,
}

fn default_axes() -> String {
    AXES.to_owned()
}

fn default_length_decimals() -> u8 {
    JointProgramOptions::default().length_decimals
}

fn default_angle_decimals() -> u8 {
    JointProgramOptions::default().angle_decimals
}

fn default_greatest_feed() -> f64 {
    JointProgramOptions::default().greatest_feed
}

fn default_foot() -> String {
    FOOT.to_owned()
}

impl JointProgramQuery {
    /// The checked options, without comments.
    ///
    /// # Errors
    ///
    /// The parameter that cannot be used, and what would be accepted.
    pub(crate) fn into_options(self) -> Result<JointProgramOptions, OperationError> {
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        let options = JointProgramOptions {
            axes: self.axes()?,
            length_decimals: self.length_decimals,
            angle_decimals: self.angle_decimals,
            feed: match self.feed_word {
                FeedWordName::InverseTime => FeedWord::InverseTime,
                FeedWordName::PerMinute => FeedWord::PerMinute,
            },
            greatest_feed: self.greatest_feed,
            rapids: match self.rapid_word {
                RapidWordName::G0 => RapidWord::G0,
                RapidWordName::G1 => RapidWord::G1,
            },
            numbers: self.numbers,
            head: self.head.as_deref().map(lines).unwrap_or_default(),
            comments: Vec::new(),
            foot: lines(&self.foot),
            source_lines: self.source_lines,
        };
        match options.check() {
            Ok(()) => Ok(options),
            Err(OptionsError { option, detail }) => Err(refused(option, detail)),
        }
    }

    fn axes(&self) -> Result<[JointAxis; 5], OperationError> {
        let axes: Vec<JointAxis> = self.axes.split(',').filter_map(|axis| read_axis(axis.trim())).collect();
        let axes = <[JointAxis; 5]>::try_from(axes).ok().filter(|_| self.axes.matches(',').count() == 4);
        let mut axes = axes.ok_or_else(|| {
            refused("axes", "must be five letters separated by commas, such as X,Y,-Z,A,C".to_owned())
        })?;
        if let Some(offsets) = &self.axis_offsets {
            let table = [0, 1].map(|index| from_degrees(offsets.optional(index).unwrap_or(0.0)));
            for (axis, offset) in axes.iter_mut().zip(offsets.first.0.into_iter().chain(table)) {
                axis.offset = offset;
            }
        }
        Ok(axes)
    }
}

fn read_axis(text: &str) -> Option<JointAxis> {
    let (negative, letter) = text.strip_prefix('-').map_or((false, text), |letter| (true, letter));
    let mut letters = letter.chars();
    let letter = letters.next()?;
    letters.next().is_none().then_some(JointAxis { negative, ..JointAxis::new(letter) })
}

fn refused(parameter: &str, detail: String) -> OperationError {
    OperationError::Fields(vec![FieldError::new(format!("/query/{parameter}"), detail)])
}

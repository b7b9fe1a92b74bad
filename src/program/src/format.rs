//! The format of a program: stated, or recognised by file name and media type.

use std::fmt;
use std::str::FromStr;

/// A format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// CL text.
    Apt,
    /// G-code: RS-274/NGC and Fanuc.
    Gcode,
    /// Rows below a row of names; commas, semicolons or tabs separate the columns.
    Csv,
    /// Rows as one JSON object or array per line.
    Ndjson,
    /// A stream of Apache Arrow: a row is a row of its record batches.
    Arrow,
}

/// The reason why a format cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FormatError {
    /// Nothing tells the format.
    Undetermined,
    /// No format has this name.
    Unknown(String),
    /// Programs of this controller are not read.
    Refused(&'static str),
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Undetermined => {
                write!(f, "neither file name nor media type tells the format; state format=")?;
            }
            Self::Unknown(name) => write!(f, "there is no format \"{name}\"")?,
            Self::Refused(controller) => {
                write!(f, "{controller} programs are not read; post the tool path as CL text")?;
            }
        }
        f.write_str("; accepted are apt, gcode, csv, ndjson and arrow")
    }
}

impl std::error::Error for FormatError {}

/// The format of a name, or why it cannot be read.
type Known = Result<Format, FormatError>;

impl Format {
    /// The name in `format=`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Apt => "apt",
            Self::Gcode => "gcode",
            Self::Csv => "csv",
            Self::Ndjson => "ndjson",
            Self::Arrow => "arrow",
        }
    }

    /// The format that is stated, or else that of the file's extension, or else that of the media type.
    ///
    /// # Errors
    ///
    /// - [`FormatError::Unknown`]: no format has the stated name.
    /// - [`FormatError::Refused`]: the program is one of Heidenhain (`.h`) or Siemens (`.mpf`).
    /// - [`FormatError::Undetermined`]: nothing is stated, and neither extension nor media type is known.
    ///
    /// ```
    /// use verne_program::{Format, FormatError};
    ///
    /// let form = Some("application/x-www-form-urlencoded");
    /// assert_eq!(Format::detect(Some("apt"), Some("part.txt"), form), Ok(Format::Apt));
    /// assert_eq!(Format::detect(None, Some("part.ncl.3"), form), Ok(Format::Apt));
    /// assert_eq!(Format::detect(None, None, Some("text/csv; charset=utf-8")), Ok(Format::Csv));
    /// assert_eq!(Format::detect(None, None, form), Err(FormatError::Undetermined));
    /// assert_eq!(Format::detect(None, Some("PART.H"), None), Err(FormatError::Refused("Heidenhain")));
    /// ```
    pub fn detect(
        stated: Option<&str>,
        file_name: Option<&str>,
        media_type: Option<&str>,
    ) -> Result<Self, FormatError> {
        if let Some(name) = stated {
            return name.parse();
        }
        file_name
            .and_then(by_extension)
            .or_else(|| media_type.and_then(by_media_type))
            .unwrap_or(Err(FormatError::Undetermined))
    }
}

impl FromStr for Format {
    type Err = FormatError;

    /// Reads the name of a format, as in `format=`.
    fn from_str(name: &str) -> Result<Self, FormatError> {
        let unknown = || Err(FormatError::Unknown(name.chars().take(64).collect()));
        by_name(&name.to_ascii_lowercase()).unwrap_or_else(unknown)
    }
}

fn by_name(name: &str) -> Option<Known> {
    Some(match name {
        "apt" => Ok(Format::Apt),
        "gcode" => Ok(Format::Gcode),
        "csv" => Ok(Format::Csv),
        "ndjson" => Ok(Format::Ndjson),
        "arrow" => Ok(Format::Arrow),
        "heidenhain" => Err(FormatError::Refused("Heidenhain")),
        "siemens" => Err(FormatError::Refused("Siemens")),
        _ => return None,
    })
}

fn by_extension(file_name: &str) -> Option<Known> {
    let mut name = file_name;
    // Creo numbers the versions of a file: part.ncl.3.
    while let Some((stem, version)) = name.rsplit_once('.')
        && !version.is_empty()
        && version.bytes().all(|byte| byte.is_ascii_digit())
    {
        name = stem;
    }
    let (_, extension) = name.rsplit_once('.')?;
    match extension.to_ascii_lowercase().as_str() {
        "apt" | "cls" | "cl" | "clt" | "ncl" | "aptsource" => by_name("apt"),
        "nc" | "ngc" | "tap" | "gcode" | "cnc" => by_name("gcode"),
        "csv" => by_name("csv"),
        "ndjson" | "jsonl" => by_name("ndjson"),
        "arrow" => by_name("arrow"),
        "h" => by_name("heidenhain"),
        "mpf" => by_name("siemens"),
        _ => None,
    }
}

fn by_media_type(media_type: &str) -> Option<Known> {
    let essence = media_type.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
    match essence.as_str() {
        "text/csv" => by_name("csv"),
        "application/x-ndjson" | "application/ndjson" | "application/jsonl" => by_name("ndjson"),
        "application/vnd.apache.arrow.stream" => by_name("arrow"),
        "text/x-gcode" | "text/x.gcode" => by_name("gcode"),
        _ => None,
    }
}

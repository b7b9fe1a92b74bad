//! Parameters of /programs in query strings.

use clap::Args;
use serde::de::value::Error as ValueError;
use serde::de::{DeserializeOwned, Error, IntoDeserializer};
use serde::{Deserialize, Deserializer};
use utoipa::IntoParams;
use utoipa::openapi::schema::{Object, ObjectBuilder, Type};
use verne_program::{Code, Compensation, Format, FormatError, ReadOptions, RotarySense, Units};

use crate::wire::code_list::CodeList;
use crate::wire::error::{FieldError, OperationError};

/// Most moves of a program. They take 72 bytes each while the program is planned, and arcs 56 more.
const MOST_MOVES: usize = 2_000_000;

/// How a program is read.
#[derive(Debug, Default, Deserialize, IntoParams, Args)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct ProgramQuery {
    /// Format of the program: `apt` (CL text), `gcode`, `csv`, `ndjson` or `arrow`. With it the service accepts any
    /// Content-Type. Without it Content-Type must tell the format.
    #[arg(long)]
    #[param(nullable = false)]
    pub format: Option<String>,
    /// Unit of the lengths, if the program states none: CL text without a unit is refused, G-code and rows are then
    /// millimetres.
    #[arg(long, value_parser = read_name::<Units>)]
    #[param(nullable = false, schema_with = units)]
    pub units: Option<Units>,
    /// CL text and G-code: how the reader takes cutter radius compensation (CUTCOM, G41). `accept` makes it a warning,
    /// because the points of a program are the tool's path; `refuse` makes it a fault.
    #[serde(default)]
    #[arg(long, default_value = "accept", value_parser = read_name::<Compensation>)]
    #[param(schema_with = compensation)]
    pub compensation: Compensation,
    /// G-code: control of the tool centre point is always on. Otherwise G43.4 and G43.5 begin it, G43 and G49 end it.
    #[serde(default)]
    #[arg(long)]
    #[param(default = false)]
    pub tcp: bool,
    /// G-code: further codes that begin control of the tool centre point, such as `M428`, separated by commas. A code
    /// that is in both lists begins and ends it in turn.
    #[serde(default)]
    #[arg(long, value_name = "CODES")]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub tcp_on: Option<CodeList>,
    /// G-code: further codes that end control of the tool centre point, such as `M429`, separated by commas.
    #[serde(default)]
    #[arg(long, value_name = "CODES")]
    #[param(inline, style = Form, explode = false, nullable = false)]
    pub tcp_off: Option<CodeList>,
    /// G-code: moves with this feed or a greater one are rapids, mm/min. Some programs write rapids as G1 F9999.
    #[serde(default, deserialize_with = "rapid_feed")]
    #[arg(long, value_name = "MM/MIN", value_parser = read_rapid_feed)]
    #[param(exclusive_minimum = 0, maximum = 1e9, nullable = false)]
    pub rapid_feed: Option<f64>,
    /// G-code: the sense of A, B and C. `tool`: they turn the tool relative to the work (ISO 841). `table`: they turn
    /// the table, the other way.
    #[serde(default)]
    #[arg(long, default_value = "tool", value_parser = read_name::<RotarySense>)]
    #[param(schema_with = rotary_sense)]
    pub rotary_sense: RotarySense,
}

impl ProgramQuery {
    /// The options for the reader of a format.
    ///
    /// # Errors
    ///
    /// The parameters that this format does not use.
    pub(crate) fn options(&self, format: Format) -> Result<ReadOptions, OperationError> {
        self.check_uses(format)?;
        Ok(ReadOptions {
            units: self.units,
            compensation: self.compensation,
            tcp: self.tcp,
            tcp_on: codes(self.tcp_on.as_ref()),
            tcp_off: codes(self.tcp_off.as_ref()),
            rapid_feed: self.rapid_feed,
            rotary_sense: self.rotary_sense,
            most_moves: MOST_MOVES,
        })
    }

    fn check_uses(&self, format: Format) -> Result<(), OperationError> {
        let gcode: &[Format] = &[Format::Gcode];
        let stated = [
            ("compensation", self.compensation != Compensation::default(), &[Format::Apt, Format::Gcode][..]),
            ("tcp", self.tcp, gcode),
            ("tcp_on", self.tcp_on.is_some(), gcode),
            ("tcp_off", self.tcp_off.is_some(), gcode),
            ("rapid_feed", self.rapid_feed.is_some(), gcode),
            ("rotary_sense", self.rotary_sense != RotarySense::default(), gcode),
        ];
        let unused = stated.into_iter().filter(|(_, stated, formats)| *stated && !formats.contains(&format));
        let faults: Vec<_> = unused
            .map(|(parameter, _, formats)| {
                let names: Vec<_> = formats.iter().map(|format| format.name()).collect();
                let detail = format!(
                    "is for the format {}; a program in the format {} does not use it",
                    names.join(" or "),
                    format.name()
                );
                FieldError::new(format!("/query/{parameter}"), detail)
            })
            .collect();
        if faults.is_empty() { Ok(()) } else { Err(OperationError::Fields(faults)) }
    }

    /// The format, stated here or by the media type of the body.
    pub(crate) fn format(&self, media_type: Option<&str>) -> Result<Format, OperationError> {
        Format::detect(self.format.as_deref(), None, media_type).map_err(|error| format_fault(&error))
    }
}

/// The fault of the parameter `format`.
fn format_fault(error: &FormatError) -> OperationError {
    let detail = match error {
        FormatError::Undetermined => {
            let names = "apt, gcode, csv or ndjson";
            format!("Content-Type does not tell the format of the program; state format=, which is {names}")
        }
        stated => stated.to_string(),
    };
    OperationError::Fields(vec![FieldError::new("/query/format", detail)])
}

/// Reads one of several names on the command line.
fn read_name<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    T::deserialize(text.into_deserializer()).map_err(|error: ValueError| error.to_string())
}

fn codes(list: Option<&CodeList>) -> Vec<Code> {
    list.map(|list| list.0.clone()).unwrap_or_default()
}

fn names(names: [&str; 2]) -> ObjectBuilder {
    ObjectBuilder::new().schema_type(Type::String).enum_values(Some(names))
}

/// The schema of a unit.
pub(crate) fn units() -> Object {
    names(["mm", "inch"]).build()
}

fn compensation() -> Object {
    names(["accept", "refuse"]).default(Some("accept".into())).build()
}

fn rotary_sense() -> Object {
    names(["tool", "table"]).default(Some("tool".into())).build()
}

/// A feed that bounds those of cuts.
fn rapid_feed<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    checked_feed(f64::deserialize(deserializer)?).map(Some).map_err(D::Error::custom)
}

/// The same on the command line.
fn read_rapid_feed(text: &str) -> Result<f64, String> {
    checked_feed(text.parse().map_err(|_| "must be a number".to_owned())?).map_err(str::to_owned)
}

fn checked_feed(feed: f64) -> Result<f64, &'static str> {
    if feed > 0.0 && feed <= 1e9 { Ok(feed) } else { Err("must be greater than 0 and at most 1000000000") }
}

//! Parameters of /programs in query strings.

use serde::de::Error;
use serde::{Deserialize, Deserializer};
use utoipa::IntoParams;
use utoipa::openapi::schema::{Object, ObjectBuilder, Type};
use verne_program::{Compensation, Format, FormatError, ReadOptions, RotarySense, Units};

use crate::wire::code_list::CodeList;
use crate::wire::error::{FieldError, OperationError};

/// Most moves of a program. They take 72 bytes each while the program is planned, and arcs 56 more.
const MOST_MOVES: usize = 2_000_000;

/// How a program is read.
#[derive(Debug, Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct ProgramQuery {
    /// Format of the program: `apt` (CL text), `gcode`, `csv` or `ndjson`. With it any Content-Type is accepted.
    /// Without it Content-Type must tell the format.
    #[param(nullable = false)]
    pub format: Option<String>,
    /// Unit of the lengths, if the program states none: CL text without a unit is refused, G-code and rows are then
    /// millimetres.
    #[param(nullable = false, schema_with = units)]
    pub units: Option<Units>,
    /// What to do with cutter radius compensation (CUTCOM, G41): `accept` makes it a warning, because the points of a
    /// program are the tool's path; `refuse` makes it a fault.
    #[serde(default)]
    #[param(schema_with = compensation)]
    pub compensation: Compensation,
    /// G-code: control of the tool centre point is always on. Otherwise G43.4 and G43.5 begin it, and G43 and G49 end
    /// it.
    #[serde(default)]
    #[param(default = false)]
    pub tcp: bool,
    /// G-code: further codes that begin control of the tool centre point, such as `M428`, separated by commas. A code
    /// that is in both lists begins and ends it in turn.
    #[serde(default)]
    #[param(inline, style = Form, explode = false)]
    pub tcp_on: CodeList,
    /// G-code: further codes that end control of the tool centre point, such as `M429`, separated by commas.
    #[serde(default)]
    #[param(inline, style = Form, explode = false)]
    pub tcp_off: CodeList,
    /// G-code: moves with this feed or a greater one are rapids, mm/min. Some programs write rapids as G1 F9999.
    #[serde(default, deserialize_with = "rapid_feed")]
    #[param(exclusive_minimum = 0, maximum = 1e9, nullable = false)]
    pub rapid_feed: Option<f64>,
    /// G-code: the sense of A, B and C. `tool`: they turn the tool relative to the work (ISO 841). `table`: they turn
    /// the table, the other way.
    #[serde(default)]
    #[param(schema_with = rotary_sense)]
    pub rotary_sense: RotarySense,
}

impl ProgramQuery {
    /// The options for the reader.
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            units: self.units,
            compensation: self.compensation,
            tcp: self.tcp,
            tcp_on: self.tcp_on.0.clone(),
            tcp_off: self.tcp_off.0.clone(),
            rapid_feed: self.rapid_feed,
            rotary_sense: self.rotary_sense,
            most_moves: MOST_MOVES,
        }
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
    let feed = f64::deserialize(deserializer)?;
    if feed > 0.0 && feed <= 1e9 {
        Ok(Some(feed))
    } else {
        Err(D::Error::custom("must be greater than 0 and at most 1000000000"))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "what a test cannot prepare has failed it")]
mod tests {
    use verne_program::RotarySense;

    use super::ProgramQuery;
    use crate::wire::error::OperationError;
    use crate::wire::query_string::parse_query;

    #[test]
    fn options_of_g_code_come_from_the_query() {
        let others = "format=gcode&tcp=true&rapid_feed=5000&rotary_sense=table";
        for codes in ["tcp_on=M428&tcp_off=m429,M999", "tcp_on=[%22M428%22]&tcp_off=M429&tcp_off=M999"] {
            let query: ProgramQuery = parse_query(&format!("{others}&{codes}")).unwrap();
            let options = query.options();
            assert_eq!(options.tcp_on, ["M428".parse().unwrap()]);
            assert_eq!(options.tcp_off, ["M429".parse().unwrap(), "M999".parse().unwrap()]);
            assert_eq!((options.tcp, options.rapid_feed), (true, Some(5000.0)));
            assert_eq!(options.rotary_sense, RotarySense::Table);
        }
        let options = parse_query::<ProgramQuery>("").unwrap().options();
        assert_eq!((options.tcp, options.tcp_on.len(), options.rapid_feed), (false, 0, None));
    }

    #[test]
    fn options_that_are_none_are_refused_with_what_would_be_accepted() {
        for (query, detail) in [
            ("tcp_on=X428", "a code is G or M"),
            ("tcp_off=", "a code is G or M"),
            ("rapid_feed=0", "greater than 0"),
            ("rapid_feed=NaN", "greater than 0"),
            ("rotary_sense=left", "`table`"),
            ("tcp=yes", "true"),
        ] {
            let error = parse_query::<ProgramQuery>(query).unwrap_err();
            let OperationError::Fields(fields) = &error else { panic!("{error:?}") };
            assert!(format!("{fields:?}").contains(detail), "{query}: {fields:?}");
        }
        let codes = vec!["M1"; 21].join(",");
        assert!(parse_query::<ProgramQuery>(&format!("tcp_on={codes}")).is_err());
    }
}

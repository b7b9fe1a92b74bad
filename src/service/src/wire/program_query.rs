//! Parameters of /programs in query strings.

use serde::Deserialize;
use utoipa::IntoParams;
use utoipa::openapi::schema::{Object, ObjectBuilder, Type};
use verne_program::{Compensation, Format, FormatError, ReadOptions, Units};

use crate::wire::error::{FieldError, OperationError};

/// Most moves of a program. They take 72 bytes each while the program is planned, and arcs 56 more.
const MOST_MOVES: usize = 2_000_000;

/// How a program is read.
#[derive(Debug, Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct ProgramQuery {
    /// Format of the program: `apt` (CL text), `csv` or `ndjson`. With it the service accepts any Content-Type. Without
    /// it Content-Type must tell the format.
    #[param(nullable = false)]
    pub format: Option<String>,
    /// Unit of the lengths, if the program states none: CL text without a unit is refused, rows are then millimetres.
    #[param(nullable = false, schema_with = units)]
    pub units: Option<Units>,
    /// What to do with cutter radius compensation (CUTCOM): `accept` makes it a warning, because the points of a
    /// program are the tool's path; `refuse` makes it a fault.
    #[serde(default)]
    #[param(schema_with = compensation)]
    pub compensation: Compensation,
}

impl ProgramQuery {
    /// The options for the reader.
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            units: self.units,
            compensation: self.compensation,
            most_moves: MOST_MOVES,
            ..ReadOptions::default()
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
            let names = "apt, csv or ndjson";
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

//! The formats of rows: their names in queries, as file extensions and as media types.

use clap::ValueEnum;
use serde::Deserialize;
use utoipa::ToSchema;
use verne_rows::Format;

/// Format of rows: `arrow`, the streaming format of Apache Arrow; `csv`, with the names of the columns in the first
/// line; `ndjson`, an object in each line; `json`, one document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RowFormat {
    /// A stream of Apache Arrow.
    Arrow,
    /// Comma-separated columns.
    Csv,
    /// A JSON object in each line.
    Ndjson,
    /// One JSON document.
    Json,
}

impl RowFormat {
    /// All of them; the first is preferred.
    pub(crate) const ALL: [Self; 4] = [Self::Json, Self::Ndjson, Self::Csv, Self::Arrow];

    /// The format of rows in columns; `None` for a JSON document.
    pub(crate) fn columns(self) -> Option<Format> {
        match self {
            Self::Arrow => Some(Format::Arrow),
            Self::Csv => Some(Format::Csv),
            Self::Ndjson => Some(Format::Ndjson),
            Self::Json => None,
        }
    }

    /// The media type.
    pub(crate) fn media(self) -> &'static str {
        self.columns().map_or("application/json", Format::media)
    }

    /// The name, which is also the extension.
    pub(crate) fn name(self) -> &'static str {
        self.columns().map_or("json", Format::name)
    }
}

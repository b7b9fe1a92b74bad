//! The formats: their names and media types.

/// A format of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The streaming format of Apache Arrow.
    Arrow,
    /// Comma-separated values below a row of names.
    Csv,
    /// A JSON object in each line.
    Ndjson,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Arrow, Self::Csv, Self::Ndjson];

    /// The name, which is also the extension of a file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arrow => "arrow",
            Self::Csv => "csv",
            Self::Ndjson => "ndjson",
        }
    }

    /// The media type.
    pub const fn media(self) -> &'static str {
        match self {
            Self::Arrow => "application/vnd.apache.arrow.stream",
            Self::Csv => "text/csv",
            Self::Ndjson => "application/x-ndjson",
        }
    }

    /// The format of a file by its extension, in letters of either case.
    ///
    /// ```
    /// use verne_rows::Format;
    ///
    /// assert_eq!(Format::of_extension("CSV"), Some(Format::Csv));
    /// assert_eq!(Format::of_extension("jsonl"), Some(Format::Ndjson));
    /// assert_eq!(Format::of_extension("json"), None);
    /// ```
    pub fn of_extension(extension: &str) -> Option<Self> {
        let extension = extension.to_ascii_lowercase();
        match extension.as_str() {
            "jsonl" => Some(Self::Ndjson),
            name => Self::ALL.into_iter().find(|format| format.name() == name),
        }
    }

    /// The format of a media type; parameters such as `charset` are ignored.
    ///
    /// ```
    /// use verne_rows::Format;
    ///
    /// assert_eq!(Format::of_media("Text/CSV; charset=utf-8"), Some(Format::Csv));
    /// assert_eq!(Format::of_media("application/json"), None);
    /// ```
    pub fn of_media(media: &str) -> Option<Self> {
        let essence = media.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
        match essence.as_str() {
            "application/vnd.apache.arrow.stream" => Some(Self::Arrow),
            "text/csv" => Some(Self::Csv),
            "application/x-ndjson" | "application/ndjson" | "application/jsonl" => Some(Self::Ndjson),
            _ => None,
        }
    }
}

//! Why rows cannot be read or written.

use arrow_schema::ArrowError;
use thiserror::Error;

/// Why no further row can be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ReadError {
    /// A column cannot be used.
    #[error("the column {name:?} {detail}")]
    Column {
        /// The name of the column.
        name: String,
        /// The reason, which follows the name.
        detail: String,
    },
    /// The bytes are not of the format, or the rows end too early.
    #[error("{0}")]
    Malformed(String),
}

impl ReadError {
    pub(crate) fn column(name: impl Into<String>, detail: impl Into<String>) -> Self {
        Self::Column { name: name.into(), detail: detail.into() }
    }
}

impl From<ArrowError> for ReadError {
    fn from(error: ArrowError) -> Self {
        Self::Malformed(format!("the Arrow stream cannot be read: {error}"))
    }
}

/// Why rows cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum WriteError {
    /// The format has no text for the values of a column.
    #[error(
        "the column {name:?} has the type {kind}, for which the format has no text; Arrow can pass it on"
    )]
    NoText {
        /// The name of the column.
        name: String,
        /// The Arrow type.
        kind: String,
    },
    /// Two columns have one name.
    #[error("two columns have the name {0:?}")]
    Twice(String),
    /// The texts of so many rows are too long to be in memory.
    #[error("the texts of {0} rows are too long; Arrow can pass them on")]
    TooLong(usize),
    /// The columns do not fit together: a defect of the caller.
    #[error("{0}")]
    Columns(String),
}

impl From<ArrowError> for WriteError {
    fn from(error: ArrowError) -> Self {
        Self::Columns(error.to_string())
    }
}

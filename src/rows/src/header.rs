//! The names of the columns, and which of them are numbers.

use crate::error::ReadError;
use crate::limits::MOST_COLUMNS;

/// The columns of a text, in their order.
#[derive(Debug)]
pub(crate) struct Header {
    pub(crate) names: Vec<HeaderName>,
}

/// A column of a text.
#[derive(Debug)]
pub(crate) struct HeaderName {
    pub(crate) name: String,
    pub(crate) is_number: bool,
}

impl Header {
    /// Checks the names; `numbers` are those of the columns of numbers.
    pub(crate) fn new(names: impl IntoIterator<Item = String>, numbers: &[&str]) -> Result<Self, ReadError> {
        let mut known: Vec<HeaderName> = Vec::new();
        for name in names {
            if name.is_empty() {
                return Err(ReadError::Malformed(format!("column {} has no name", known.len() + 1)));
            }
            if known.iter().any(|other| other.name == name) {
                return Err(ReadError::column(name, "occurs twice"));
            }
            if known.len() == MOST_COLUMNS {
                return Err(ReadError::Malformed(format!("there are more than {MOST_COLUMNS} columns")));
            }
            let is_number = numbers.contains(&name.as_str());
            known.push(HeaderName { name, is_number });
        }
        if known.is_empty() {
            // Rows without columns cannot be written.
            return Err(ReadError::Malformed("there is no column".to_owned()));
        }
        Ok(Self { names: known })
    }

    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }
}

//! The error of an invalid field in a machine's data.

use std::fmt;

/// An invalid field of a machine's data, and the values that would be accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineError {
    /// Path of the field with `/` between its parts, such as `limits/stroke/0`.
    pub field: String,
    /// The reason, and the values that would be accepted.
    pub detail: String,
}

impl MachineError {
    /// The error of one field.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::MachineError;
    ///
    /// let error = MachineError::new("table/da", "must be finite");
    /// assert_eq!(error.to_string(), "table/da: must be finite");
    /// ```
    pub fn new(field: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { field: field.into(), detail: detail.into() }
    }
}

impl fmt::Display for MachineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.field, self.detail)
    }
}

impl std::error::Error for MachineError {}

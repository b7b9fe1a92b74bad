//! Faults of a machine's data.

use std::fmt;

/// One fault of a machine's data: the field, and the values that would be accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineFault {
    /// Path of the field with `/` between its parts, such as `limits/stroke/0`.
    pub field: String,
    /// The fault, and the values that would be accepted.
    pub detail: String,
}

impl MachineFault {
    /// A fault of one field.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::MachineFault;
    ///
    /// let fault = MachineFault::new("table/da", "must be finite");
    /// assert_eq!(fault.to_string(), "table/da: must be finite");
    /// ```
    pub fn new(field: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { field: field.into(), detail: detail.into() }
    }
}

impl fmt::Display for MachineFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.field, self.detail)
    }
}

impl std::error::Error for MachineFault {}

//! Why an operation has no answer. The command line, jobs and HTTP share these errors; `http::problem` assigns
//! statuses.

use serde::{Deserialize, Serialize};
use thiserror::Error;
use utoipa::ToSchema;
use verne_program::ProgramErrors;

/// One invalid field.
#[derive(Clone, Debug, PartialEq, Eq, Error, Serialize, Deserialize, ToSchema)]
#[error("{}", self.text())]
#[schema(as = FieldProblem)]
pub(crate) struct FieldError {
    /// JSON Pointer into the body, such as `/machine/limits/stroke/0`; `/query/<name>` for a query parameter,
    /// `/columns/<name>` for a column of rows.
    pub pointer: String,
    /// The error, and the accepted values.
    pub detail: String,
}

impl FieldError {
    /// An error of one field.
    pub(crate) fn new(pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), detail: detail.into() }
    }

    /// A required field is missing.
    pub(crate) fn missing(pointer: String, name: &str) -> Self {
        Self::new(pointer, format!("`{name}` is missing"))
    }

    fn text(&self) -> String {
        let Self { pointer, detail } = self;
        // A detail that begins with the field's name needs no pointer before it.
        if pointer.is_empty() || detail.starts_with('`') {
            detail.clone()
        } else {
            format!("{pointer}: {detail}")
        }
    }
}

/// Why an operation has no answer. The record of a failed job states it as JSON.
#[derive(Clone, Debug, PartialEq, Eq, Error, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum OperationError {
    #[error("The body is not JSON: {0}.")]
    Syntax(String),
    /// The body is not of its format of rows, or ends too early.
    #[error("The rows cannot be read: {0}.")]
    Rows(String),
    /// The request is well formed, but these fields are invalid.
    #[error("{}", fields(.0))]
    Fields(Vec<FieldError>),
    #[error("The batch has {rows} rows; the limit is {limit}.")]
    TooManyRows { rows: usize, limit: usize },
    /// The program has faults: the reader, or those who fit it to the machine, refuse these lines.
    #[error("{}", faults(.0))]
    ProgramFaults(ProgramErrors),
    #[error(
        "The service has no program with the id {0:?}, or has evicted it. Send the program to POST /programs again; \
         the id stays the same."
    )]
    ProgramNotFound(String),
    #[error("The program is larger than the whole storage for results. Split it into several programs.")]
    ProgramTooLarge,
    #[error("There is no joint program: {0}.")]
    NoJointProgram(String),
    /// Measurements that determine no machine: a clause.
    #[error("No machine was found: {0}.")]
    NoFit(String),
    #[error("The computation was cancelled.")]
    Cancelled,
    #[error(
        "A binary of another version, or for another target, created the job. Repeat the request for a new id."
    )]
    OtherVersion,
    #[error("The service cannot store results. Its log states the reason.")]
    StoreUnavailable,
    /// A defect of the service.
    #[error("The service has a defect; its log states this x-request-id.")]
    Internal,
}

fn faults(refused: &ProgramErrors) -> String {
    let end = if refused.complete { "" } else { " The reader stopped there." };
    match refused.errors.as_slice() {
        [] => "The program has faults.".to_owned(),
        [only] => format!("The program has a fault: {only}.{end}"),
        [first, rest @ ..] => {
            format!("The program has faults: {first}; `errors` lists {} more.{end}", rest.len())
        }
    }
}

fn fields(errors: &[FieldError]) -> String {
    match errors {
        [] => "A field is invalid.".to_owned(),
        [only] => format!("{only}."),
        [first, rest @ ..] => format!("{first}; `errors` lists {} more.", rest.len()),
    }
}

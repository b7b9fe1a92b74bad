//! Machines, answers and errors of the commands that compute.

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;

use serde::Serialize;

use crate::wire::error::{FieldError, OperationError};
use crate::wire::machine_ref::MachineRef;
use crate::wire::parse::parse_body;
use crate::wire::query::point_into_query;

/// The exit status if a question or a row has no answer, or if the machine cannot run a program.
const NO_ANSWER: u8 = 3;

/// The exit status of a command that has done its work.
pub(crate) fn exit_status(answered: bool) -> ExitCode {
    if answered { ExitCode::SUCCESS } else { ExitCode::from(NO_ANSWER) }
}

/// The JSON text of an answer, with line breaks if `pretty`.
pub(crate) fn to_json(answer: &impl Serialize, pretty: bool) -> Result<String, String> {
    let text = if pretty { serde_json::to_string_pretty(answer) } else { serde_json::to_string(answer) };
    text.map_err(|error| error.to_string())
}

/// The machine of the flag `--machine`: the name of a machine, or the path of its file.
pub(crate) fn machine(name: &str) -> Result<MachineRef, String> {
    let path = Path::new(name);
    if !path.is_file() && !name.contains(['/', '.']) {
        return Ok(MachineRef::Name(name.to_owned()));
    }
    let text = std::fs::read(path).map_err(|error| format!("--machine {name}: {error}"))?;
    parse_body(&text)
        .map(|object| MachineRef::Object(Box::new(object)))
        .map_err(|error| format!("--machine {name} is not a machine{}", list(error)))
}

/// An error of a request, with flags in place of fields.
pub(crate) fn with_flags(error: OperationError) -> String {
    flags_of_query(point_into_query(error))
}

/// An error of a query, with flags in place of parameters.
pub(crate) fn flags_of_query(error: OperationError) -> String {
    let OperationError::Fields(faults) = error else {
        return "internal error of this program".to_owned();
    };
    let flags = faults.into_iter().map(|FieldError { pointer, detail }| {
        let path = pointer.trim_start_matches("/query/");
        let (flag, inside) = path.split_once('/').unwrap_or((path, ""));
        let separator = if inside.is_empty() { "" } else { " " };
        FieldError::new(format!("--{}{separator}{inside}", flag.replace('_', "-")), detail)
    });
    format!("the request is invalid{}", list(OperationError::Fields(flags.collect())))
}

fn list(error: OperationError) -> String {
    let OperationError::Fields(faults) = error else { return format!(": {error}") };
    faults.into_iter().fold(String::new(), |mut text, fault| {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n  {}: {}", fault.pointer, fault.detail);
        text
    })
}

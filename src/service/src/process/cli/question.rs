//! `verne fk`, `verne ik` and `verne openapi`: answered without a server.

use std::fmt::Write;
use std::path::Path;

use clap::Subcommand;
use serde::Serialize;

use crate::http::router::document;
use crate::operations::forward::answer_fk;
use crate::operations::inverse::answer_ik;
use crate::operations::machine_registry::MachineRegistry;
use crate::wire::answer::Answer;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::machine_ref::MachineRef;
use crate::wire::parse::parse_body;
use crate::wire::query::{FkQuery, IkQuery, point_into_query};
use crate::wire::request::{FkRequest, IkRequest};

/// A question on the command line.
#[derive(Debug, Subcommand)]
pub(crate) enum Question {
    /// Solve the forward kinematics, like GET /fk.
    #[command(name = "fk")]
    Forward(FkQuery),
    /// Solve the inverse kinematics, like GET /ik.
    #[command(name = "ik")]
    Inverse(IkQuery),
    /// Print the OpenAPI document.
    Openapi,
}

impl Question {
    /// The JSON that HTTP would answer, with line breaks for people or without; or what is wrong.
    pub(crate) fn answer(self, pretty: bool) -> Result<String, String> {
        match self {
            Self::Forward(query) => written(&fk(query)?, pretty),
            Self::Inverse(query) => written(&ik(query)?, pretty),
            Self::Openapi => written(&document(), true),
        }
    }
}

/// JSON, with line breaks for people or without.
pub(crate) fn written(answer: &impl Serialize, pretty: bool) -> Result<String, String> {
    let text = if pretty { serde_json::to_string_pretty(answer) } else { serde_json::to_string(answer) };
    text.map_err(|error| error.to_string())
}

fn fk(query: FkQuery) -> Result<Answer, String> {
    let machine = machine(&query.machine)?;
    let answer = query
        .into_request()
        .map(|request| FkRequest { machine, ..request })
        .and_then(|request| answer_fk(&request, &MachineRegistry::default()));
    answer.map_err(in_flags)
}

fn ik(query: IkQuery) -> Result<Answer, String> {
    let machine = machine(&query.machine)?;
    let answer = query
        .into_request()
        .map(|request| IkRequest { machine, ..request })
        .and_then(|request| answer_ik(&request, &MachineRegistry::default()));
    answer.map_err(in_flags)
}

/// A machine's name, or the path of its file.
pub(crate) fn machine(name: &str) -> Result<MachineRef, String> {
    let path = Path::new(name);
    if !path.is_file() && !name.contains(['/', '.']) {
        return Ok(MachineRef::Name(name.to_owned()));
    }
    let text = std::fs::read(path).map_err(|error| format!("--machine {name}: {error}"))?;
    parse_body(&text)
        .map(|object| MachineRef::Object(Box::new(object)))
        .map_err(|error| format!("--machine {name} is not a machine{}", listed(error)))
}

/// An error in the words of the command line.
pub(crate) fn in_flags(error: OperationError) -> String {
    let OperationError::Fields(faults) = point_into_query(error) else {
        return "internal error of this program".to_owned();
    };
    let flags = faults.into_iter().map(|FieldError { pointer, detail }| {
        let path = pointer.trim_start_matches("/query/");
        let (flag, inside) = path.split_once('/').unwrap_or((path, ""));
        let separator = if inside.is_empty() { "" } else { " " };
        FieldError::new(format!("--{}{separator}{inside}", flag.replace('_', "-")), detail)
    });
    format!("the request is invalid{}", listed(OperationError::Fields(flags.collect())))
}

fn listed(error: OperationError) -> String {
    let OperationError::Fields(faults) = error else { return format!(": {error}") };
    faults.into_iter().fold(String::new(), |mut text, fault| {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n  {}: {}", fault.pointer, fault.detail);
        text
    })
}

//! `verne fk`, `verne ik` and `verne openapi`: the answers of the HTTP service without a server.

use clap::Subcommand;

use crate::http::router::document;
use crate::operations::forward::answer_fk;
use crate::operations::inverse::answer_ik;
use crate::operations::machine_registry::MachineRegistry;
use crate::process::cli::answer::{machine, to_json, with_flags};
use crate::wire::answer::Answer;
use crate::wire::query::{FkQuery, IkQuery};
use crate::wire::request::{FkRequest, IkRequest};

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum KinematicsCommand {
    /// Solve the forward kinematics, like GET /fk.
    #[command(name = "fk")]
    Forward(FkQuery),
    /// Solve the inverse kinematics, like GET /ik.
    #[command(name = "ik")]
    Inverse(IkQuery),
    /// Print the OpenAPI document.
    Openapi,
}

impl KinematicsCommand {
    /// The JSON that the HTTP service would answer, with line breaks if `pretty`.
    pub(crate) fn answer(self, pretty: bool) -> Result<String, String> {
        match self {
            Self::Forward(query) => to_json(&forward(query)?, pretty),
            Self::Inverse(query) => to_json(&inverse(query)?, pretty),
            Self::Openapi => to_json(&document(), true),
        }
    }
}

fn forward(query: FkQuery) -> Result<Answer, String> {
    let machine = machine(&query.machine)?;
    let request = query.into_request().map(|request| FkRequest { machine, ..request });
    request.and_then(|request| answer_fk(&request, &MachineRegistry::default())).map_err(with_flags)
}

fn inverse(query: IkQuery) -> Result<Answer, String> {
    let machine = machine(&query.machine)?;
    let request = query.into_request().map(|request| IkRequest { machine, ..request });
    request.and_then(|request| answer_ik(&request, &MachineRegistry::default())).map_err(with_flags)
}

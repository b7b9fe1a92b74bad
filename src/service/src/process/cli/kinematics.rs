//! `verne fk`, `verne ik` and `verne contains`: the answers of the HTTP service without a server.

use std::io::Write;
use std::process::ExitCode;

use clap::Subcommand;
use serde_json::Value;

use crate::operations::forward::answer_fk;
use crate::operations::inverse::answer_ik;
use crate::operations::machine_registry::MachineRegistry;
use crate::process::cli::answer::{exit_status, machine, with_flags};
use crate::process::cli::batch::BatchCommand;
use crate::process::cli::one_or_batch::OneOrBatch;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::page::Page;
use crate::process::cli::words::solutions;
use crate::wire::answer::Answer;
use crate::wire::query::{FkQuery, IkQuery};
use crate::wire::request::{FkRequest, IkRequest};
use crate::wire::row_query::{ContainsRowsQuery, FkRowsQuery, IkRowsQuery};

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum KinematicsCommand {
    /// Solve the forward kinematics, like GET /fk; with --batch for each row of a file.
    ///
    /// The columns of a file are rho1, rho2, rho3 and perhaps theta1 and theta2. The exit status is 3 if there is no
    /// solution, or if a row is not `ok`.
    #[command(name = "fk")]
    Forward(Box<OneOrBatch<FkQuery, FkRowsQuery>>),
    /// Solve the inverse kinematics, like GET /ik; with --batch for each row of a file.
    ///
    /// The columns of a file are x, y, z and phi1, phi2 or i, j, k. The exit status is 3 if there is no solution, or if
    /// a row is not `ok`.
    #[command(name = "ik")]
    Inverse(Box<OneOrBatch<IkQuery, IkRowsQuery>>),
    /// Test whether the points of a file belong to a workspace.
    ///
    /// The columns of the file are x, y and z. The exit status is 3 if a row is not a point.
    Contains(BatchCommand<ContainsRowsQuery>),
}

impl KinematicsCommand {
    /// Writes the answer of the HTTP service to `out`, or the answers to rows.
    pub(crate) fn run(
        self,
        out: &mut impl Write,
        err: &mut impl Write,
        terminal: Option<Terminal>,
    ) -> Result<ExitCode, String> {
        let (answer, format, words): (_, _, fn(&Value) -> Page) = match self {
            Self::Forward(command) => match *command {
                OneOrBatch::One(one) => (forward(one.query)?, one.format, solutions::forward),
                OneOrBatch::Batch(batch) => return batch.run(out, err, terminal.is_some()),
            },
            Self::Inverse(command) => match *command {
                OneOrBatch::One(one) => (inverse(one.query)?, one.format, solutions::inverse),
                OneOrBatch::Batch(batch) => return batch.run(out, err, terminal.is_some()),
            },
            Self::Contains(batch) => return batch.run(out, err, terminal.is_some()),
        };
        let json = serde_json::to_value(&answer).map_err(|error| error.to_string())?;
        format.write(&json, words, out, terminal)?;
        Ok(exit_status(!answer.solutions.is_empty()))
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

//! The command line.

mod question;

use std::io::{IsTerminal, Write, stderr, stdout};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde::Serialize;
use tracing_subscriber::EnvFilter;

use crate::app;
use crate::config::ServeConfig;
use crate::wire::query::{FkQuery, IkQuery};

/// Kinematics of the VERNE five-axis hybrid machine's architecture: every solution, over HTTP and here.
///
/// Without a command: serve. Lengths in mm, angles in degrees; z points down. The built-in machine `verne` has
/// invented dimensions that reproduce the counts printed in arXiv:0707.3507; they are not Fatronik's.
#[derive(Debug, Parser)]
#[command(name = "verne", version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    serve: ServeConfig,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Serve over HTTP.
    Serve(ServeConfig),
    /// Forward kinematics: what GET /fk answers.
    Fk(FkQuery),
    /// Inverse kinematics: what GET /ik answers.
    Ik(IkQuery),
    /// Print the OpenAPI document.
    Openapi,
}

impl Cli {
    /// Does what the command line says.
    pub fn run(self) -> ExitCode {
        match self.command.unwrap_or(Command::Serve(self.serve)) {
            Command::Serve(config) => serve(&config),
            Command::Fk(query) => print_or_fail(question::fk(query), stdout().is_terminal()),
            Command::Ik(query) => print_or_fail(question::ik(query), stdout().is_terminal()),
            Command::Openapi => print_or_fail(Ok(app::document()), true),
        }
    }
}

fn serve(config: &ServeConfig) -> ExitCode {
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("info"));
    tracing_subscriber::fmt().with_env_filter(filter).with_writer(stderr).init();
    let runtime = match tokio::runtime::Builder::new_multi_thread().enable_all().build() {
        Ok(runtime) => runtime,
        Err(error) => return fail(&format!("cannot start: {error}")),
    };
    match runtime.block_on(app::serve(config)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(&error.to_string()),
    }
}

fn print_or_fail(answer: Result<impl Serialize, String>, pretty: bool) -> ExitCode {
    let text = answer.and_then(|answer| {
        let text =
            if pretty { serde_json::to_string_pretty(&answer) } else { serde_json::to_string(&answer) };
        text.map_err(|error| error.to_string())
    });
    match text.and_then(|text| writeln!(stdout(), "{text}").map_err(|error| error.to_string())) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => fail(&message),
    }
}

fn fail(message: &str) -> ExitCode {
    // Nothing is left to tell where not even this can be written.
    drop(writeln!(stderr(), "error: {message}"));
    ExitCode::FAILURE
}

//! The command line.

pub(crate) mod health;
pub(crate) mod key;
pub(crate) mod progress;
pub(crate) mod question;
pub(crate) mod store;
pub(crate) mod workspace;

use crate::process::cli::health::HealthCommand;
use crate::process::cli::key::KeyCommand;
use crate::process::cli::question::Question;
use crate::process::cli::store::StoreCommand;
use crate::process::cli::workspace::WorkspaceCommand;

use std::ffi::OsString;
use std::io::Write;
use std::time::Duration;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::process::config::ServeConfig;
use crate::process::config::worker::WorkerConfig;
use crate::process::service::StartError;
use crate::process::{config, service, worker_process};
use crate::telemetry::TelemetryConfig;

/// Kinematics and workspaces of the VERNE five-axis hybrid machine's architecture, over HTTP and on the command line.
///
/// Without a command, verne serves over HTTP. Lengths are in mm and angles in degrees; z points down. The built-in
/// machine `verne` has invented dimensions that reproduce the solution counts printed in arXiv:0707.3507; they are not
/// Fatronik's dimensions.
#[derive(Debug, Parser)]
#[command(name = "verne", version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    serve: ServeConfig,
    /// The settings in force, where they are to be printed and nothing else.
    #[arg(skip)]
    settings: Option<String>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Serve over HTTP.
    Serve(Box<ServeConfig>),
    /// Run jobs from a broker (--broker) and write their results to a shared store (--store).
    Worker(WorkerConfig),
    /// Check whether a service is ready. The exit status is 0 if it is ready, otherwise 1.
    Health(HealthCommand),
    /// Create API keys for the --keys file.
    Key(KeyCommand),
    /// Prepare a directory for --store.
    Store(StoreCommand),
    /// Compute a workspace: its volume, its surface as a mesh (-o FILE), or a slice (--slice Z).
    Workspace(WorkspaceCommand),
    #[command(flatten)]
    Ask(Question),
}

impl Cli {
    /// Reads the words of a command line, the first of which names the program, and the file of settings that they or
    /// the environment name.
    pub fn read(words: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let words: Vec<OsString> = words.into_iter().collect();
        let read = config::sources::read(Self::command(), &words)?;
        Ok(Self { settings: read.printed, ..Self::from_arg_matches(&read.matches)? })
    }

    /// Serves, or writes the answer to `out`: with line breaks for people, or without. What is shown and no part of
    /// the answer goes to `aside`. The error is for people.
    pub fn run(self, out: &mut impl Write, aside: &mut impl Write, pretty: bool) -> Result<(), String> {
        if let Some(settings) = self.settings {
            return write!(out, "{settings}").map_err(|error| format!("cannot print the settings: {error}"));
        }
        match self.command.unwrap_or(Command::Serve(Box::new(self.serve))) {
            Command::Serve(config) => on_runtime(&config.telemetry, service::serve(&config)),
            Command::Worker(config) => on_runtime(&config.telemetry, worker_process::work(&config)),
            Command::Health(command) => command.run(),
            Command::Key(command) => command.run(out, aside),
            Command::Store(command) => command.run(out),
            Command::Workspace(command) => command.run(out, pretty),
            Command::Ask(question) => {
                let answer = question.answer(pretty)?;
                writeln!(out, "{answer}").map_err(|error| format!("cannot write the answer: {error}"))
            }
        }
    }
}

/// How long threads have to finish what blocks them after all else has ended.
const LAST: Duration = Duration::from_secs(5);

fn on_runtime(
    telemetry: &TelemetryConfig,
    service: impl Future<Output = Result<(), StartError>>,
) -> Result<(), String> {
    let _telemetry = telemetry.begin()?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|error| format!("cannot start: {error}"))?;
    let ended = runtime.block_on(service).map_err(|error| error.to_string());
    // A name that the system still looks up must not keep the process.
    runtime.shutdown_timeout(LAST);
    ended
}

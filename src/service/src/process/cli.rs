//! The command line: one module for each command except `serve`, `worker` and `openapi`, and what several of them use.

pub(crate) mod answer;
pub(crate) mod answer_format;
pub(crate) mod atlas;
pub(crate) mod batch;
pub(crate) mod calibrate;
pub(crate) mod dexterity;
pub(crate) mod error_budget;
pub(crate) mod error_map;
pub(crate) mod files;
pub(crate) mod health;
pub(crate) mod jobs;
pub(crate) mod key;
pub(crate) mod kinematics;
pub(crate) mod limit_words;
pub(crate) mod machine;
pub(crate) mod map_files;
pub(crate) mod one_or_batch;
pub(crate) mod program_arguments;
pub(crate) mod progress;
pub(crate) mod result_pipe;
pub(crate) mod service_address;
pub(crate) mod shell_help;
pub(crate) mod store;
pub(crate) mod terminal;
pub(crate) mod toolpath;
pub(crate) mod toolpath_origins;
pub(crate) mod toolpath_placement;
pub(crate) mod toolpath_window;
pub(crate) mod words;
pub(crate) mod workspace;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;
use std::time::Duration;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::http::router::document;
use crate::process::cli::answer::to_json;
use crate::process::cli::atlas::AtlasCommand;
use crate::process::cli::calibrate::CalibrateCommand;
use crate::process::cli::dexterity::DexterityCommand;
use crate::process::cli::error_budget::ErrorBudgetCommand;
use crate::process::cli::error_map::ErrorMapCommand;
use crate::process::cli::health::HealthCommand;
use crate::process::cli::jobs::JobsCommand;
use crate::process::cli::key::KeyCommand;
use crate::process::cli::kinematics::KinematicsCommand;
use crate::process::cli::machine::MachineCommand;
use crate::process::cli::result_pipe::ResultPipe;
use crate::process::cli::shell_help::{CompletionsCommand, ManCommand};
use crate::process::cli::store::StoreCommand;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::toolpath::ToolpathCommand;
use crate::process::cli::toolpath_origins::OriginsCommand;
use crate::process::cli::toolpath_placement::PlacementCommand;
use crate::process::cli::toolpath_window::WindowCommand;
use crate::process::cli::workspace::WorkspaceCommand;
use crate::process::config::ServeConfig;
use crate::process::config::worker::WorkerConfig;
use crate::process::start_error::StartError;
use crate::process::{config, service, worker_process};
use crate::telemetry::TelemetryConfig;
use crate::wire::result_id::BUILD;

/// Kinematics and workspaces of the VERNE five-axis hybrid machine's architecture, over HTTP and on the command line.
///
/// Without a command, verne serves over HTTP, with the options that `verne serve --help` lists. On a terminal it prints
/// answers as tables and words; into a file or a pipe, and with --json, as the JSON of the HTTP service. Lengths are in
/// mm and angles in degrees; z points down. The built-in machine `verne` has invented dimensions that reproduce the
/// solution counts printed in arXiv:0707.3507; they are not Fatronik's dimensions. `linear-delta` is a linear delta of
/// invented dimensions.
#[derive(Debug, Parser)]
#[command(name = "verne", version, long_version = BUILD, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    serve: ServeConfig,
    /// The effective settings, if `--print-config` asks for them.
    #[arg(skip)]
    printed_settings: Option<String>,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[command(flatten)]
    Kinematics(KinematicsCommand),
    /// Compute a workspace: its volume, its surface as a mesh (-o FILE), or a slice (--slice Z).
    Workspace(WorkspaceCommand),
    /// Compute a dexterity map: the inclinations that reach each point of the part.
    Dexterity(Box<DexterityCommand>),
    /// Compute how far the tool may be off at a pose for tolerances of the machine's parameters; with --batch for each
    /// row of a file.
    ///
    /// The columns of a file are x, y, z and phi1, phi2 or i, j, k. The exit status is 3 if the pose, or a row, is not
    /// `ok`.
    ErrorBudget(Box<ErrorBudgetCommand>),
    /// Compute how far the tool may be off over a workspace, for tolerances of the machine's parameters.
    ErrorMap(Box<ErrorMapCommand>),
    /// Compute an atlas: the numbers of solutions of the parallel module over a plane, as a drawing (-o FILE) or JSON.
    Atlas(Box<AtlasCommand>),
    /// Plan the joint motion of a program: its rows (-o FILE), and a report on the limits that it breaks.
    ///
    /// The exit status is 3 if the machine cannot run the program.
    Toolpath(Box<ToolpathCommand>),
    /// Find the set-up, and the tool length, in which a program keeps the greatest distance from the limits.
    ///
    /// The exit status is 3 if the machine cannot run the program in any set-up that was found.
    ToolpathPlacement(Box<PlacementCommand>),
    /// Compute the region of origins of a program: its volume, its surface as a mesh (-o FILE), or a slice (--slice Z).
    ToolpathOrigins(Box<OriginsCommand>),
    /// Find the values of the tool's length, or of a number of the set-up, with which the machine can run a program.
    ///
    /// The exit status is 3 if there is none.
    ToolpathWindow(Box<WindowCommand>),
    /// Determine a machine's parameters from measurements in a file: the machine (-o FILE), and how sure each parameter
    /// is.
    ///
    /// The columns of the file are rho1, rho2, rho3 and what --kind needs: x, y, z (tips, tracker), also theta1, theta2
    /// (part), length (ballbar), or to_rho1, to_rho2, to_rho3, distance (distances). Without the measured values the
    /// answer says what the poses would identify.
    Calibrate(Box<CalibrateCommand>),
    /// Print a machine as a JSON file, which every --machine accepts.
    Machine(MachineCommand),
    /// Serve over HTTP.
    Serve(Box<ServeConfig>),
    /// Run jobs from a broker (--broker) and write their results to a shared store (--store).
    Worker(WorkerConfig),
    /// Check whether a service is ready. The exit status is 0 if it is ready, otherwise 1.
    Health(HealthCommand),
    /// List or cancel the jobs of a running service.
    Jobs(JobsCommand),
    /// Create API keys for the --keys file.
    Key(KeyCommand),
    /// Prepare a directory for --store.
    Store(StoreCommand),
    /// Print the OpenAPI document.
    Openapi,
    /// Print the completions of the command line for a shell.
    Completions(CompletionsCommand),
    /// Print the manual page, or write the pages of all commands to a directory.
    Man(ManCommand),
}

impl Cli {
    /// Reads a command line, whose first word is the name of the program, and the settings file that it or the
    /// environment names.
    pub fn read(words: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let words: Vec<OsString> = words.into_iter().collect();
        let read = config::sources::read(Self::command_line(), &words)?;
        Ok(Self { printed_settings: read.printed, ..Self::from_arg_matches(&read.matches)? })
    }

    /// The commands and their arguments. The help of `verne` lists no options of `verne serve`.
    fn command_line() -> clap::Command {
        Self::command().mut_args(|arg| arg.hide(true))
    }

    /// Runs the command, and returns the exit status. Results go to `out`, as tables and words if that is a terminal;
    /// the key of `verne key new` and the summaries of tool paths and batches go to `err`. The error is a message for
    /// people.
    ///
    /// If the reader of `out` closes it early, as `head` does, the command stops without a message, and succeeds.
    pub fn run(
        self,
        out: &mut impl Write,
        err: &mut impl Write,
        terminal: Option<Terminal>,
    ) -> Result<ExitCode, String> {
        let mut out = ResultPipe::new(out);
        match self.execute(&mut out, err, terminal) {
            Err(_) if out.is_closed() => Ok(ExitCode::SUCCESS),
            done => done,
        }
    }

    fn execute(
        self,
        out: &mut impl Write,
        err: &mut impl Write,
        terminal: Option<Terminal>,
    ) -> Result<ExitCode, String> {
        if let Some(settings) = self.printed_settings {
            return match write!(out, "{settings}") {
                Ok(()) => Ok(ExitCode::SUCCESS),
                Err(error) => Err(format!("cannot print the settings: {error}")),
            };
        }
        let done = match self.command.unwrap_or(Command::Serve(Box::new(self.serve))) {
            Command::Serve(config) => on_runtime(&config.telemetry, service::serve(&config)),
            Command::Worker(config) => on_runtime(&config.telemetry, worker_process::run(&config)),
            Command::Health(command) => command.run(),
            Command::Key(command) => command.run(out, err),
            Command::Store(command) => command.run(out),
            Command::Workspace(command) => command.run(out, terminal),
            Command::Dexterity(command) => command.run(out, terminal),
            Command::Calibrate(command) => command.run(out, terminal),
            Command::ErrorMap(command) => command.run(out, terminal),
            Command::Atlas(command) => command.run(out, terminal),
            Command::Machine(command) => command.run(out, terminal),
            Command::Jobs(command) => command.run(out, terminal),
            Command::ToolpathOrigins(command) => command.run(out, terminal),
            Command::Openapi => {
                let document = to_json(&document(), true)?;
                writeln!(out, "{document}").map_err(|error| format!("cannot write the document: {error}"))
            }
            Command::Completions(command) => command.run(Self::command_line(), out),
            Command::Man(command) => command.run(Self::command_line(), out),
            Command::ErrorBudget(command) => return error_budget::run(*command, out, err, terminal),
            Command::Toolpath(command) => return command.run(out, err, terminal),
            Command::ToolpathWindow(command) => return command.run(out, terminal),
            Command::Kinematics(command) => return command.run(out, err, terminal),
            Command::ToolpathPlacement(command) => return command.run(out, terminal),
        };
        done.map(|()| ExitCode::SUCCESS)
    }
}

/// How long blocked threads may take to finish after everything else has ended.
const SHUTDOWN_TIMEOUT: Duration = Duration::from_secs(5);

fn on_runtime(
    telemetry: &TelemetryConfig,
    task: impl Future<Output = Result<(), StartError>>,
) -> Result<(), String> {
    let _telemetry = telemetry.start()?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|error| format!("cannot start: {error}"))?;
    let ended = runtime.block_on(task).map_err(|error| error.to_string());
    // A thread may wait for a name server.
    runtime.shutdown_timeout(SHUTDOWN_TIMEOUT);
    ended
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::ffi::OsString;
    use std::io::{self, ErrorKind, Write};
    use std::process::ExitCode;

    use super::Cli;

    /// A pipe whose reader is gone.
    struct Closed;

    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(ErrorKind::BrokenPipe.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn status(line: &str) -> (String, String) {
        let mut err = Vec::new();
        let cli = Cli::read(line.split_whitespace().map(OsString::from)).unwrap();
        let status = format!("{:?}", cli.run(&mut Closed, &mut err, None));
        (status, String::from_utf8(err).unwrap())
    }

    #[test]
    fn a_pipe_that_its_reader_closes_is_no_error() {
        let directory = tempfile::tempdir().unwrap();
        let toolpath = |name: &str, rows: &str| {
            let file = directory.path().join(name);
            std::fs::write(&file, format!("x,y,z\n{rows}")).unwrap();
            format!("verne toolpath {} --tool-length 100", file.display())
        };
        let rows = toolpath("part.csv", "-150,0,300\n150,0,300\n") + " -o -";
        let poses = directory.path().join("poses.csv");
        std::fs::write(&poses, "x,y,z\n0,0,300\n").unwrap();
        let batch = format!("verne contains --batch {}", poses.display());
        let success = format!("{:?}", Ok::<_, String>(ExitCode::SUCCESS));
        for line in ["verne fk --rho 674,685,250", &rows, &batch] {
            assert_eq!(status(line), (success.clone(), String::new()), "{line}");
        }
        // The report was not read, but the verdict is known.
        let (status, summary) = status(&toolpath("beyond.csv", "0,0,300\n9000,0,300\n"));
        assert_eq!(status, format!("{:?}", Ok::<_, String>(ExitCode::from(3))));
        assert!(summary.contains("cannot run the program"), "{summary}");
    }
}

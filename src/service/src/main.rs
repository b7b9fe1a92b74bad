//! `verne`: the service and its command line.

use std::io::{Write, stderr, stdout};
use std::process::ExitCode;

use verne_service::{Cli, Terminal};

fn main() -> ExitCode {
    let cli = Cli::read(std::env::args_os()).unwrap_or_else(|message| message.exit());
    match cli.run(&mut stdout(), &mut stderr(), Terminal::of_standard_output()) {
        Ok(status) => status,
        Err(message) => {
            // If standard error is closed, the exit status alone reports the failure.
            drop(writeln!(stderr(), "error: {message}"));
            ExitCode::FAILURE
        }
    }
}

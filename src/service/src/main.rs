//! `verne`: the service and its command line.

use std::process::ExitCode;

use clap::Parser;
use verne_service::cli::Cli;

fn main() -> ExitCode {
    Cli::parse().run()
}

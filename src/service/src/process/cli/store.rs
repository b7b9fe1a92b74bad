//! `verne store`: prepares directories as result stores.

use std::io::Write;

use clap::{Args, Subcommand};
use verne_store::Store;

/// Prepare a directory for --store.
#[derive(Debug, Args)]
pub(crate) struct StoreCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Prepare a directory as a result store: create the directory and the file `verne-store` in it. Run this once,
    /// while the file system is mounted. --store rejects a directory without this file, because its file system may not
    /// be mounted.
    Init {
        /// The directory, as file:///SHARED/DIRECTORY. A store on S3 needs no preparation.
        #[arg(value_name = "URL")]
        url: String,
    },
}

impl StoreCommand {
    /// Prepares the directory and confirms it on `out`.
    pub(crate) fn run(&self, out: &mut impl Write) -> Result<(), String> {
        let Command::Init { url } = &self.command;
        let created = Store::init_shared(url).map_err(|error| error.to_string())?;
        let outcome =
            if created { "is now a result store" } else { "is already a result store; nothing was changed" };
        writeln!(out, "{url} {outcome}").map_err(|error| format!("cannot write the answer: {error}"))
    }
}

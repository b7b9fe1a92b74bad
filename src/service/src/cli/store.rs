//! `verne store`: prepares stores of results.

use std::io::Write;

use clap::{Args, Subcommand};
use verne_store::Store;

/// A store of results that several processes share.
#[derive(Debug, Args)]
pub(super) struct StoreCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Prepare a directory as a store: make it, and the file `verne-store` in it. Needed once, while it is mounted.
    /// Without that file --store refuses the directory: it is a mount point whose file system is not mounted.
    Init {
        /// The directory: file:///SHARED/DIRECTORY. A store on S3 needs no preparation.
        #[arg(value_name = "URL")]
        url: String,
    },
}

impl StoreCommand {
    /// Prepares the store, and says so on `out`.
    pub(super) fn run(&self, out: &mut impl Write) -> Result<(), String> {
        let Command::Init { url } = &self.command;
        let made = Store::init_shared(url).map_err(|error| error.to_string())?;
        let told = if made {
            "is now a store of results"
        } else {
            "is a store of results already; nothing was changed"
        };
        writeln!(out, "{url} {told}").map_err(|error| format!("cannot write the answer: {error}"))
    }
}

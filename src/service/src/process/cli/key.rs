//! `verne key`: creates API keys.

use std::io::Write;

use clap::{Args, Subcommand};

use crate::limits::key::Key;
use crate::limits::keys_file::is_name;
use crate::wire::role::Role;

/// API keys.
#[derive(Debug, Args)]
pub(crate) struct KeyCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Create an API key. Standard output gets its entry for the --keys file, standard error gets the key. The entry
    /// contains only the hash of the key, so verne shows the key only once.
    New {
        /// Name of the client: 1 to 64 letters, digits or .-_, beginning with a letter. Two keys with the same name are
        /// one client.
        #[arg(long, value_parser = name)]
        name: String,
        /// Role of the key.
        #[arg(long, value_enum)]
        role: Role,
    },
}

impl KeyCommand {
    /// Writes the entry to `out`, which may be the --keys file itself, and the key to `err`.
    pub(crate) fn run(self, out: &mut impl Write, err: &mut impl Write) -> Result<(), String> {
        let Command::New { name, role } = self.command;
        let key = Key::generate().map_err(|error| format!("the system has no random numbers: {error}"))?;
        let hash = key.hash().to_hex();
        // The key first: without it the entry is useless.
        writeln!(err, "{key}")
            .and_then(|()| writeln!(out, "[[key]]\nname = \"{name}\"\nrole = \"{role}\"\nhash = \"{hash}\""))
            .map_err(|error| format!("cannot write the key: {error}"))
    }
}

fn name(text: &str) -> Result<String, &'static str> {
    if is_name(text) {
        Ok(text.to_owned())
    } else {
        Err("must be 1 to 64 letters, digits or .-_, letter first")
    }
}

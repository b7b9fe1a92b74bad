//! `verne key`: makes the keys of a service.

use std::io::Write;

use clap::{Args, Subcommand};

use crate::access::{Key, Role, is_name};

/// Keys of a service.
#[derive(Debug, Args)]
pub(super) struct KeyCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Print the entry of a fresh key, for the file of --keys, and on standard error the key. The entry has only its
    /// hash: the key is shown this once.
    New {
        /// Whose it is: 1 to 64 letters, digits or .-_, a letter first. Two keys of one name are one client.
        #[arg(long, value_parser = name)]
        name: String,
        /// What it is good for.
        #[arg(long, value_enum)]
        role: Role,
    },
}

impl KeyCommand {
    /// Writes the entry to `out`, which may be the file of keys itself, and the key to `aside`.
    pub(super) fn run(self, out: &mut impl Write, aside: &mut impl Write) -> Result<(), String> {
        let Command::New { name, role } = self.command;
        let key = Key::fresh().map_err(|error| format!("the system has no random numbers: {error}"))?;
        let hash = key.hash().to_hex();
        // The key first: an entry of a key that nobody has seen is of no use.
        writeln!(aside, "{key}")
            .and_then(|()| writeln!(out, "[[key]]\nname = \"{name}\"\nrole = \"{role}\"\nhash = \"{hash}\""))
            .map_err(|error| format!("cannot write the key: {error}"))
    }
}

fn name(text: &str) -> Result<String, &'static str> {
    if is_name(text) { Ok(text.to_owned()) } else { Err("1 to 64 letters, digits or .-_, a letter first") }
}

//! `verne key`: creates API keys.

use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::limits::key::Key;
use crate::limits::keys_file::{self, is_name};
use crate::wire::role::Role;

/// API keys.
#[derive(Debug, Args)]
pub(crate) struct KeyCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Create an API key. Standard output, or the file of --keys, gets its entry; standard error gets the key. The
    /// entry contains only the hash of the key, so verne shows the key only once.
    New {
        /// Name of the client: 1 to 64 letters, digits or .-_, beginning with a letter. Two keys with the same name are
        /// one client.
        #[arg(long, value_parser = name)]
        name: String,
        /// Role of the key.
        #[arg(long, value_enum)]
        role: Role,
        /// Append the entry to this file, which is created if it does not exist. A service that uses the file reads it
        /// again at SIGHUP.
        #[arg(long, value_name = "FILE")]
        keys: Option<PathBuf>,
    },
}

impl KeyCommand {
    /// Writes the entry to `out` or to the file, and the key to `err`.
    pub(crate) fn run(self, out: &mut impl Write, err: &mut impl Write) -> Result<(), String> {
        let Command::New { name, role, keys } = self.command;
        let key = Key::generate().map_err(|error| format!("the system has no random numbers: {error}"))?;
        let hash = key.hash().to_hex();
        let entry = format!("[[key]]\nname = \"{name}\"\nrole = \"{role}\"\nhash = \"{hash}\"\n");
        let extended = keys.map(|path| Ok::<_, String>((with_entry(&path, &entry)?, path))).transpose()?;
        let unwritable = |error| format!("cannot write the key: {error}");
        // The key first: without it the entry is useless.
        writeln!(err, "{key}").map_err(unwritable)?;
        match extended {
            Some((addition, path)) => append(&path, &addition),
            None => write!(out, "{entry}").map_err(unwritable),
        }
    }
}

/// The entry with the line breaks that separate it from the others in the file. Fails if the file would then be no file
/// of keys.
fn with_entry(path: &Path, entry: &str) -> Result<String, String> {
    let text = match fs::read_to_string(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
        read => read.map_err(|error| format!("{}: {error}", path.display()))?,
    };
    let separator = match text.as_str() {
        "" => "",
        text if text.ends_with('\n') => "\n",
        _ => "\n\n",
    };
    let addition = format!("{separator}{entry}");
    keys_file::parse(path, &(text + &addition), None).map_err(|error| error.to_string())?;
    Ok(addition)
}

fn append(path: &Path, text: &str) -> Result<(), String> {
    let file = OpenOptions::new().create(true).append(true).open(path);
    let written = file.and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|error| format!("{}: {error}", path.display()))
}

fn name(text: &str) -> Result<String, &'static str> {
    if is_name(text) {
        Ok(text.to_owned())
    } else {
        Err("must be 1 to 64 letters, digits or .-_, letter first")
    }
}

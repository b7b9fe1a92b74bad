//! `verne machine`: prints a machine as a file to start from.

use std::io::Write;

use clap::Args;

use crate::operations::machine_registry::MachineRegistry;
use crate::process::cli::answer::{machine, to_json, with_flags};
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::machines;
use crate::wire::machine::MachineObject;
use crate::wire::machine_ref::REFERENCE;

/// The machine.
#[derive(Debug, Args)]
pub(crate) struct MachineCommand {
    /// Name of the machine, or the path of a machine file, which is then checked.
    #[arg(default_value = REFERENCE)]
    machine: String,
    /// Print the file on a terminal, too. Into a file or a pipe verne always prints the file.
    #[arg(long)]
    json: bool,
}

impl MachineCommand {
    /// Writes the machine as JSON, which --machine reads, or as words on a terminal.
    pub(crate) fn run(&self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        let machine = MachineRegistry::default().resolve(&machine(&self.machine)?).map_err(with_flags)?;
        let definition = MachineObject::from(machine.data());
        let text = match terminal.filter(|_| !self.json) {
            Some(terminal) => {
                let definition = serde_json::to_value(&definition).map_err(|error| error.to_string())?;
                machines::machine(&definition).text(terminal)
            }
            None => to_json(&definition, true)? + "\n",
        };
        out.write_all(text.as_bytes()).map_err(|error| format!("cannot write the machine: {error}"))
    }
}

//! `verne machine`: prints a machine as a file to start from.

use std::io::Write;

use clap::Args;

use crate::operations::machine_registry::MachineRegistry;
use crate::process::cli::answer::{machine, to_json, with_flags};
use crate::wire::machine::MachineObject;
use crate::wire::machine_ref::REFERENCE;

/// The machine.
#[derive(Debug, Args)]
pub(crate) struct MachineCommand {
    /// Name of the machine, or the path of a machine file, which is then checked.
    #[arg(default_value = REFERENCE)]
    machine: String,
}

impl MachineCommand {
    /// Writes the machine as JSON, which --machine reads.
    pub(crate) fn run(&self, out: &mut impl Write) -> Result<(), String> {
        let machine = MachineRegistry::default().resolve(&machine(&self.machine)?).map_err(with_flags)?;
        let definition = MachineObject::from(machine.data());
        writeln!(out, "{}", to_json(&definition, true)?)
            .map_err(|error| format!("cannot write the machine: {error}"))
    }
}

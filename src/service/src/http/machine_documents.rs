//! The JSON of published machines.

use crate::http::error::LookupError;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::wire::machine::MachineObject;
use crate::wire::machine_list::{MachineAnswer, MachineEntry, MachineList};

/// The published machines with their descriptions.
pub(crate) fn machine_list(machines: &MachineRegistry) -> MachineList {
    let entry = |machine: &IdentifiedMachine| MachineEntry {
        id: machine.id.clone(),
        description: machine.data().description.clone(),
    };
    MachineList { machines: machines.iter().map(entry).collect() }
}

/// A published machine with its numbers.
pub(crate) fn machine_answer(machines: &MachineRegistry, name: &str) -> Result<MachineAnswer, LookupError> {
    let machine = machines.get(name).ok_or_else(|| LookupError::Machine(name.to_owned()))?;
    let definition = MachineObject::from(machine.data());
    Ok(MachineAnswer { machine: machine.id.clone(), definition })
}

//! Answers of `/machines`.

use serde::Serialize;
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::machine::MachineObject;

/// The published machines.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct MachineList {
    /// The machines, sorted by name.
    pub machines: Vec<MachineEntry>,
}

/// One published machine.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct MachineEntry {
    /// Name and hash.
    #[serde(flatten)]
    pub id: MachineId,
    /// Source of the numbers.
    pub description: String,
}

/// A published machine with its numbers.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct MachineAnswer {
    /// Name and hash.
    pub machine: MachineId,
    /// The complete machine object. Requests accept it.
    pub definition: MachineObject,
}

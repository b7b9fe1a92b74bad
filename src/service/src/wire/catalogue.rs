//! Answers of `/machines` and of the probes.

use serde::Serialize;
use utoipa::ToSchema;

use super::answer::MachineId;
use super::machine::MachineObject;

/// The published machines.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct MachineList {
    /// By name.
    pub machines: Vec<MachineEntry>,
}

/// One published machine.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct MachineEntry {
    /// Name and hash.
    #[serde(flatten)]
    pub id: MachineId,
    /// Where its numbers come from.
    pub description: String,
}

/// A published machine with its numbers.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct MachineAnswer {
    /// Name and hash.
    pub machine: MachineId,
    /// The whole machine, as a request may carry it.
    pub definition: MachineObject,
}

/// The state of the service.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct Health {
    /// Always `ok`: a service that is not answers nothing.
    #[schema(value_type = String, example = "ok")]
    pub status: &'static str,
}

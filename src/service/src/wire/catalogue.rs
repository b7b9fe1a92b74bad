//! Answers of `/machines` and of the probes.

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

/// The state of the service.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct Health {
    /// Whether all parts of the service work.
    pub status: Status,
    /// The shared parts of the service that do not respond.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    pub failing: Vec<Part>,
}

/// Status of the service.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
// Named for the document: a batch's rows have a status, too.
#[schema(as = HealthStatus)]
pub(crate) enum Status {
    /// All parts work.
    Ok,
    /// Some shared parts do not respond.
    Degraded,
}

/// A part that the processes of a service share.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Part {
    /// The broker of jobs.
    Broker,
    /// The store of results.
    Store,
}

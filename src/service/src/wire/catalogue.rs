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
    /// Whether all of it works.
    pub status: Status,
    /// What does not, of what the processes of a service share.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    pub failing: Vec<Part>,
}

/// Whether a service works.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
// Named for the document: a batch's rows have a status, too.
#[schema(as = HealthStatus)]
pub(crate) enum Status {
    /// Altogether.
    Ok,
    /// Some of it.
    Degraded,
}

/// What the processes of a service share.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Part {
    /// The broker of jobs.
    Broker,
    /// The store of results.
    Store,
}

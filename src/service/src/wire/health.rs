//! The answer of the probes `/livez` and `/readyz`.

use serde::Serialize;
use utoipa::ToSchema;

/// The state of the service.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct Health {
    /// Whether all parts of the service work.
    pub status: HealthStatus,
    /// The shared parts of the service that do not respond.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    pub failing: Vec<SharedPart>,
}

/// Status of the service.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HealthStatus {
    /// All parts work.
    Ok,
    /// Some shared parts do not respond.
    Degraded,
}

/// A part that the processes of a service share.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Part)]
pub(crate) enum SharedPart {
    /// The broker of jobs.
    Broker,
    /// The store of results.
    Store,
}

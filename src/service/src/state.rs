//! What every handler shares.

use std::sync::Arc;

use axum::body::Bytes;

use crate::registry::Registry;
use crate::results::Results;

/// The largest requests that are answered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RequestLimits {
    /// Bytes in a batch's body.
    pub body_bytes: usize,
    /// Rows in a batch.
    pub rows: usize,
}

/// Shared state; only the results change.
#[derive(Debug)]
pub(crate) struct State {
    /// The published machines.
    pub machines: Registry,
    /// The largest requests that are answered.
    pub limits: RequestLimits,
    /// The workspaces computed so far.
    pub results: Results,
    /// The OpenAPI document, as it is sent.
    pub openapi: Bytes,
}

/// A handle on the state.
pub(crate) type Shared = Arc<State>;

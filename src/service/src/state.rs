//! What every handler shares.

use std::sync::Arc;

use axum::body::Bytes;

use crate::registry::Registry;

/// The largest requests that are answered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RequestLimits {
    /// Bytes in a batch's body.
    pub body_bytes: usize,
    /// Rows in a batch.
    pub rows: usize,
}

/// Shared, immutable state.
#[derive(Debug)]
pub(crate) struct State {
    /// The published machines.
    pub machines: Registry,
    /// The largest requests that are answered.
    pub limits: RequestLimits,
    /// The OpenAPI document, as it is sent.
    pub openapi: Bytes,
}

/// A handle on the state.
pub(crate) type Shared = Arc<State>;

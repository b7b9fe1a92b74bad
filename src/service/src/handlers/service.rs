//! The OpenAPI document and the probes.

use axum::Json;
use axum::body::Bytes;
use axum::extract::State;
use axum::http::header::{CONTENT_TYPE, HeaderName};

use crate::error::Error;
use crate::openapi::problems::ServiceProblems;
use crate::state::Shared;
use crate::wire::catalogue::Health;

/// This document
///
/// OpenAPI 3.1, generated from the handlers. `/docs` shows it to people.
#[utoipa::path(
    get, path = "/openapi.json", operation_id = "openapi", tag = "service",
    responses((status = 200, description = "The document.", body = Object), ServiceProblems)
)]
pub(crate) async fn get_openapi(State(state): State<Shared>) -> ([(HeaderName, &'static str); 1], Bytes) {
    ([(CONTENT_TYPE, "application/json")], state.openapi.clone())
}

/// Liveness
///
/// The process answers.
#[utoipa::path(
    get, path = "/livez", operation_id = "livez", tag = "service",
    responses((status = 200, description = "It lives.", body = Health), ServiceProblems)
)]
pub(crate) async fn get_livez() -> Json<Health> {
    Json(Health { status: "ok" })
}

/// Readiness
///
/// The machines are loaded: questions are answered. Until then the port is closed.
#[utoipa::path(
    get, path = "/readyz", operation_id = "readyz", tag = "service",
    responses((status = 200, description = "It is ready.", body = Health), ServiceProblems)
)]
pub(crate) async fn get_readyz() -> Json<Health> {
    Json(Health { status: "ok" })
}

/// What is asked for where nothing lives.
pub(crate) async fn nothing_here() -> Error {
    Error::NoSuchPath
}

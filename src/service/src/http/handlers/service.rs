//! The OpenAPI document and the probes.

use std::borrow::Cow;

use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json};

use crate::http::error::HttpError;
use crate::http::openapi::binary::Text;
use crate::http::openapi::problems::{ReadyProblems, ServiceProblems};
use crate::http::proxy::BasePath;
use crate::http::request_head::Unreadable;
use crate::http::state::Shared;
use crate::http::static_content::Fixed;
use crate::limits::error::LimitError;
use crate::wire::health::{Health, HealthStatus};

/// The OpenAPI document as it is sent: the committed copy. The tests hold it equal to the generated one; its examples
/// are the solver's answers, which take too long to compute at every start.
const DOCUMENT: &str = include_str!("../../../../../openapi/openapi.json");

/// The document of a service that is published under a path.
pub(crate) fn document(base: &BasePath) -> Fixed {
    let text = match base.as_str() {
        "" => Cow::Borrowed(DOCUMENT),
        base => Cow::Owned(DOCUMENT.replacen(SERVER, &SERVER.replace('/', base), 1)),
    };
    let hash = blake3::hash(text.as_bytes()).into();
    Fixed::new(text.into_owned().into(), "application/json".to_owned(), hash)
}

/// Where the document names the service's address.
const SERVER: &str = "\"url\": \"/\"";

/// This document
///
/// OpenAPI 3.1, generated from the handlers. `/docs` displays it in a browser.
#[utoipa::path(
    get, path = "/openapi.json", operation_id = "openapi", tag = "service",
    responses((status = 200, description = "The document.", body = Object), ServiceProblems)
)]
pub(crate) async fn get_openapi(
    State(state): State<Shared>,
    headers: HeaderMap,
) -> Result<Response, HttpError> {
    Ok(state.document.answer(&headers, "no-cache").await?)
}

/// Liveness
///
/// The process is running.
#[utoipa::path(
    get, path = "/livez", operation_id = "livez", tag = "service",
    responses((status = 200, description = "The process is running.", body = Health), ServiceProblems)
)]
pub(crate) async fn get_livez() -> Json<Health> {
    Json(Health { status: HealthStatus::Ok, failing: Vec::new() })
}

/// Readiness
///
/// The service is ready if it answers requests, accepts jobs and stores results. It is not ready while it is stopping
/// or while its disk rejects writes. If a shared broker or result store does not respond, the answer names it and the
/// status stays 200; requests that need neither still work.
#[utoipa::path(
    get, path = "/readyz", operation_id = "readyz", tag = "service",
    responses((status = 200, description = "The service is ready.", body = Health), ReadyProblems)
)]
pub(crate) async fn get_readyz(State(state): State<Shared>) -> Result<Json<Health>, HttpError> {
    state.readiness.told().await
}

/// Metrics
///
/// Returns metrics in the text format of Prometheus: requests, use of every limit, jobs and results.
#[utoipa::path(
    get, path = "/metrics", operation_id = "metrics", tag = "service",
    responses((status = 200, description = "The metrics.", content((Text = "application/openmetrics-text"))),
        ServiceProblems)
)]
pub(crate) async fn get_metrics(State(state): State<Shared>) -> Result<impl IntoResponse, HttpError> {
    Ok(state.metrics.answer()?)
}

/// What is asked for when all connections are taken.
pub(crate) async fn no_place_here() -> HttpError {
    LimitError::Overloaded.into()
}

/// What is asked for where nothing lives, or in a way that cannot be read.
pub(crate) async fn nothing_here(unreadable: Option<Extension<Unreadable>>) -> HttpError {
    unreadable.map_or(HttpError::UnknownPath, |Extension(Unreadable(error))| error.into())
}

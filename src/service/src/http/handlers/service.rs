//! The service itself: OpenAPI document, probes, metrics, and the fallbacks for unknown paths and connections.

use axum::extract::State;
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json};

use crate::http::conditional_response::Conditions;
use crate::http::error::HttpError;
use crate::http::extractors::QueryString;
use crate::http::openapi::body_schemas::Text;
use crate::http::openapi::problem_responses::{CommonProblems, ReadyProblems};
use crate::http::request_head::InvalidHead;
use crate::http::state::SharedState;
use crate::limits::error::LimitError;
use crate::wire::health::{Health, HealthStatus};
use crate::wire::openapi_version::OpenapiQuery;

/// This document
///
/// OpenAPI 3.1, or 3.0.3 with `v=3.0`, generated from the handlers. `/docs` displays it in a browser.
#[utoipa::path(
    get, path = "/openapi.json", operation_id = "get_openapi", tag = "service", params(OpenapiQuery),
    responses((status = 200, description = "The document.", body = Object), CommonProblems)
)]
pub(crate) async fn get_openapi(
    State(state): State<SharedState>,
    QueryString(query): QueryString<OpenapiQuery>,
    conditions: Conditions,
    headers: HeaderMap,
) -> Result<Response, HttpError> {
    let document = state.documents.version(query.v).await?;
    Ok(document.respond(&headers, &conditions, "no-cache").await?)
}

/// Liveness
///
/// The process is running.
#[utoipa::path(
    get, path = "/livez", operation_id = "get_livez", tag = "service",
    responses((status = 200, description = "The process is running.", body = Health), CommonProblems)
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
    get, path = "/readyz", operation_id = "get_readyz", tag = "service",
    responses((status = 200, description = "The service is ready.", body = Health), ReadyProblems)
)]
pub(crate) async fn get_readyz(State(state): State<SharedState>) -> Result<Json<Health>, HttpError> {
    state.readiness.check().await
}

/// Metrics
///
/// Returns metrics in the text format of Prometheus: requests, use of every limit, jobs and results.
#[utoipa::path(
    get, path = "/metrics", operation_id = "get_metrics", tag = "service",
    responses((status = 200, description = "The metrics.", content((Text = "application/openmetrics-text"))),
        CommonProblems)
)]
pub(crate) async fn get_metrics(State(state): State<SharedState>) -> Result<impl IntoResponse, HttpError> {
    Ok(state.metrics.answer()?)
}

/// Fallback of connections beyond the limit.
pub(crate) async fn overloaded() -> HttpError {
    LimitError::Overloaded.into()
}

/// Fallback for unknown paths and for requests with an invalid head.
pub(crate) async fn unknown_path(invalid: Option<Extension<InvalidHead>>) -> HttpError {
    invalid.map_or(HttpError::UnknownPath, |Extension(InvalidHead(error))| error.into())
}

//! HTTP: routes, extractors, handlers, problem documents, caching, OpenAPI and the viewer's files.
//!
//! May import `operations`, `telemetry`, `limits` and `wire`.

pub(crate) mod allowed_origins;
pub(crate) mod base_path;
pub(crate) mod caller;
pub(crate) mod conditional_response;
pub(crate) mod content_coding;
pub(crate) mod error;
pub(crate) mod extract;
pub(crate) mod forwarded_for;
pub(crate) mod gate;
pub(crate) mod handlers;
pub(crate) mod job_document;
pub(crate) mod middleware;
pub(crate) mod negotiation;
pub(crate) mod openapi;
pub(crate) mod origin;
pub(crate) mod prefer;
pub(crate) mod problem;
pub(crate) mod proxy;
pub(crate) mod query_parameters;
pub(crate) mod readiness;
pub(crate) mod refusal_log;
pub(crate) mod request_head;
pub(crate) mod request_log;
pub(crate) mod result_or_job;
pub(crate) mod result_response;
pub(crate) mod router;
pub(crate) mod security_headers;
pub(crate) mod state;
pub(crate) mod static_content;
pub(crate) mod viewer;

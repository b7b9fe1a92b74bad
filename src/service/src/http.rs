//! HTTP: routes, extractors, handlers, problem documents, caching, OpenAPI and the viewer's files.
//!
//! May import `operations`, `telemetry`, `limits` and `wire`.
//!
//! - Add a route: `router`; a path for each format of a file: `format_paths`.
//! - 200 or 202: `result_or_job`; the wait before 202: `wait_policy`.
//! - Errors and their statuses: `error`, `problem::code`.
//! - What a request passes before its handler: `middleware`, then `access_control`.

pub(crate) mod access_control;
pub(crate) mod allowed_origins;
pub(crate) mod base_path;
pub(crate) mod client;
pub(crate) mod conditional_response;
pub(crate) mod content_coding;
pub(crate) mod embedded_files;
pub(crate) mod error;
pub(crate) mod extractors;
pub(crate) mod format_paths;
pub(crate) mod forwarded_for;
pub(crate) mod guide_files;
pub(crate) mod handlers;
pub(crate) mod job_document;
pub(crate) mod machine_documents;
pub(crate) mod middleware;
pub(crate) mod negotiation;
pub(crate) mod openapi;
pub(crate) mod origin;
pub(crate) mod problem;
pub(crate) mod program_body;
pub(crate) mod program_source;
pub(crate) mod proxy;
pub(crate) mod read_ahead;
pub(crate) mod readiness;
pub(crate) mod request_head;
pub(crate) mod request_log;
pub(crate) mod result_or_job;
pub(crate) mod result_representation;
pub(crate) mod router;
pub(crate) mod row_stream;
pub(crate) mod security_headers;
pub(crate) mod state;
pub(crate) mod static_content;
pub(crate) mod time_limit;
pub(crate) mod toolpath_body;
pub(crate) mod toolpath_rows;
pub(crate) mod unknown_parameters;
pub(crate) mod viewer_files;
pub(crate) mod wait_policy;

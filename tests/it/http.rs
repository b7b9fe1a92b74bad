//! The service through HTTP: requests pass the whole router with its middleware, without a socket.

mod admission;
mod atlas;
mod bad_input;
mod batch;
mod calibration;
mod certificates;
mod client_quotas;
mod continuous_batch;
mod cross_origin_requests;
mod dexterity;
mod documented_failures;
mod error_budget;
mod error_map;
mod etags_and_ranges;
mod guide;
mod jacobian;
mod job_fairness;
mod jobs;
mod jobs_cancelled;
mod jobs_events;
mod jobs_families;
mod jobs_listed;
mod jobs_refused;
mod key_files;
mod keys;
mod kinematics;
mod machines;
mod mesh_size_limit;
mod part_frame;
mod programs;
mod proxies;
mod query_parameters;
mod rate_limits;
mod request_bodies;
mod restart;
mod security_headers;
mod shutdown;
mod table;
mod table_workspaces;
mod toolpath;
mod toolpath_window;
mod transport;
mod viewer;
mod workspace;
mod workspace_contains;
mod workspace_files;
mod workspace_slices;

use std::path::PathBuf;

use axum::Router;
use axum::body::Body;
use axum::http::{HeaderMap, HeaderName, Method, Request, StatusCode, header};
use clap::{Args, Command, FromArgMatches};
use http_body_util::BodyExt;
use serde_json::Value;
use tower::ServiceExt;
use verne_service::{ServeConfig, Service};

/// An answer, its body parsed where it is JSON.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: StatusCode,
    pub(crate) headers: HeaderMap,
    pub(crate) bytes: Vec<u8>,
    pub(crate) json: Value,
}

/// The default settings, with machines of a directory if there is one.
pub(crate) fn config(machines: Option<PathBuf>) -> ServeConfig {
    ServeConfig {
        machines,
        max_body_bytes: 1024 * 1024,
        max_program_bytes: 4 * 1024 * 1024,
        max_rows: 2_000,
        memory_only: true,
        cache_bytes: 64 * 1024 * 1024,
        disk_bytes: 64 * 1024 * 1024,
        job_limit: 600,
        wait: 20,
        drain: 5,
        ..settings("--listen 127.0.0.1:0")
    }
}

/// The settings that flags give.
pub(crate) fn settings(flags: &str) -> ServeConfig {
    let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
    ServeConfig::from_arg_matches(&command.get_matches_from(flags.split_whitespace())).unwrap()
}

/// The service.
pub(crate) async fn service() -> Router {
    opened(&config(None)).await
}

/// The service with settings.
pub(crate) async fn opened(config: &ServeConfig) -> Router {
    Service::open(config).await.unwrap().router
}

/// Sends a request to a fresh service.
pub(crate) async fn send(request: Request<Body>) -> Reply {
    send_to(service().await, request).await
}

/// Sends a request.
pub(crate) async fn send_to(service: Router, request: Request<Body>) -> Reply {
    let (method, path) = (request.method().clone(), request.uri().path().to_owned());
    let (parts, body) = service.oneshot(request).await.unwrap().into_parts();
    let bytes = body.collect().await.unwrap().to_bytes().to_vec();
    let json = serde_json::from_slice(&bytes).unwrap_or(Value::Null);
    let reply = Reply { status: parts.status, headers: parts.headers, bytes, json };
    documented_failures::assert_documented(&method, &path, &reply);
    reply
}

/// GET.
pub(crate) async fn get(uri: &str) -> Reply {
    send(Request::get(uri).body(Body::empty()).unwrap()).await
}

/// POST of a JSON text, which may be no JSON at all.
pub(crate) async fn post(uri: &str, body: impl ToString) -> Reply {
    send(json_request(Method::POST, uri, body)).await
}

/// GET of a service, with headers.
pub(crate) async fn get_from(service: &Router, uri: &str, headers: &[(HeaderName, &str)]) -> Reply {
    let mut request = Request::get(uri);
    for (name, value) in headers {
        request = request.header(name, *value);
    }
    send_to(service.clone(), request.body(Body::empty()).unwrap()).await
}

/// A request with a JSON body.
#[allow(clippy::needless_pass_by_value, reason = "callers build the body in place")]
pub(crate) fn json_request(method: Method, uri: &str, body: impl ToString) -> Request<Body> {
    Request::builder()
        .method(method)
        .uri(uri)
        .header(header::CONTENT_TYPE, "application/json")
        .body(Body::from(body.to_string()))
        .unwrap()
}

impl Reply {
    /// The solutions of a 200.
    pub(crate) fn solutions(&self) -> &Vec<Value> {
        assert_eq!(self.status, StatusCode::OK, "{}", self.json);
        self.json["solutions"].as_array().unwrap()
    }

    /// Asserts a problem document with this status and code.
    #[track_caller]
    pub(crate) fn assert_problem(&self, status: u16, code: &str) {
        assert_eq!(self.status.as_u16(), status, "{}", self.json);
        assert_eq!(self.headers[header::CONTENT_TYPE], "application/problem+json");
        assert_eq!(self.json["code"], code, "{}", self.json);
        assert_eq!(self.json["status"], status);
        assert_eq!(self.json["type"], "about:blank");
        assert!(self.json["detail"].as_str().is_some_and(|detail| !detail.is_empty()));
    }

    /// Asserts a 422 whose only bad field is this one.
    #[track_caller]
    pub(crate) fn assert_bad_field(&self, pointer: &str) {
        self.assert_problem(422, "invalid_request");
        let errors = self.json["errors"].as_array().unwrap();
        assert_eq!(errors.len(), 1, "{}", self.json);
        assert_eq!(errors[0]["pointer"], pointer, "{}", self.json);
        assert!(errors[0]["detail"].as_str().is_some_and(|detail| !detail.is_empty()));
    }
}

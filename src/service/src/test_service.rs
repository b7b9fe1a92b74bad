//! A service in memory, for the tests inside the crate.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use axum::body::{Body, Bytes, to_bytes};
use axum::http::{HeaderMap, Request, StatusCode};
use clap::{Args, Command, FromArgMatches};
use tower::ServiceExt;

use crate::process::config::ServeConfig;
use crate::process::service::Service;

/// The settings that flags give to a service in memory.
pub(crate) fn settings(flags: &str) -> ServeConfig {
    let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
    let flags = flags.split_whitespace().chain(["--memory-only"]);
    ServeConfig::from_arg_matches(&command.get_matches_from(flags)).unwrap()
}

/// A service in memory with these flags.
pub(crate) async fn service(flags: &str) -> Service {
    Service::open(&settings(flags)).await.unwrap()
}

/// The answer to a request: status, headers and body.
pub(crate) async fn send(service: &Service, request: Request<Body>) -> (StatusCode, HeaderMap, Bytes) {
    let (head, body) = service.router.clone().oneshot(request).await.unwrap().into_parts();
    (head.status, head.headers, to_bytes(body, usize::MAX).await.unwrap())
}

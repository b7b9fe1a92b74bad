//! Tests of the service as its users see it, and readers of files that others wrote.
//!
//! | module | content |
//! |---|---|
//! | [`http`] | requests through the whole router, without a socket: one module per operation or concern |
//! | [`connections`] | a service on a socket: slow and invalid clients, limits, TLS, HTTP/2, shutdown |
//! | [`cli`] | the command line |
//! | [`settings`] | settings from files, flags and the environment |
//! | [`openapi`] | the committed OpenAPI document and its examples |
//!
//! Tests of one crate are in that crate: kinematics against a brute-force oracle and the published reference sets,
//! workspaces and tool paths in `src/solver/tests`, jobs at a broker in `src/jobs/tests`. Scripts that need processes,
//! other programs or a browser are in `tests/python`, `tests/load`, `tests/gltf` and `tests/browser`.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod cli;
mod connections;
mod http;
mod openapi;
mod settings;

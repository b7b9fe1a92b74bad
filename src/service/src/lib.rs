//! The verne service: kinematics and workspaces of the VERNE machine's architecture over HTTP and on the command line.
//!
//! Its modules are five folders and `telemetry`. Each imports only from those before it:
//!
//! 1. `wire`: types of requests, answers and errors.
//! 2. `limits`: API keys, quotas and admission.
//! 3. `telemetry`: log, traces and metrics.
//! 4. `operations`: from a checked question to its answer.
//! 5. `http`: routes, handlers, problems, caching, OpenAPI, the viewer's files.
//! 6. `process`: command line, configuration, listeners, signals, storage, workers.

mod http;
mod limits;
mod operations;
mod process;
mod telemetry;
#[cfg(test)]
mod test_service;
mod wire;

pub use http::router::document;
pub use process::cli::Cli;
pub use process::cli::terminal::Terminal;
pub use process::config::ServeConfig;
pub use process::service::{Service, serve_on};

//! What users rely on, tested against outside truth.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod cli;
mod connections;
mod http;
mod machines;
mod openapi;
mod oracle;
mod reference;
mod settings;
mod solver;

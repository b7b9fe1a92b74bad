//! Tests of what users rely on, against independent sources: the published reference sets, a brute-force oracle, and
//! readers of files that others wrote.
//!
//! | module | content |
//! |---|---|
//! | [`http`] | requests through the whole router, without a socket: one module per operation or concern |
//! | [`connections`] | a service on a socket: slow and invalid clients, limits, TLS, HTTP/2, shutdown |
//! | [`cli`] | the command line |
//! | [`settings`] | settings from files, flags and the environment |
//! | [`openapi`] | the committed OpenAPI document and its examples |
//! | [`solver`] | kinematics through the solver's public functions: counts, coordinates, margins, velocities, refusals |
//! | [`oracle`] | all solutions by brute force, from the plain data of a machine, and tests of the oracle itself |
//! | [`reference_sets`] | the published reference sets of `tests/reference` |
//! | [`random_machines`] | random machines, poses and sliders from a seed |
//!
//! Tests of one crate's own types are in that crate; tests of workspaces are in `src/solver/tests`, tests of jobs at a
//! broker in `src/jobs/tests`. Scripts that need processes, other programs or a browser are in `tests/python`,
//! `tests/load`, `tests/gltf` and `tests/browser`.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod cli;
mod connections;
mod http;
mod openapi;
mod oracle;
mod random_machines;
mod reference_sets;
mod settings;
mod solver;

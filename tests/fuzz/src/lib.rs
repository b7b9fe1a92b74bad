//! Arbitrary bytes against every parser, and arbitrary numbers, finite or not, against the solver.
//!
//! A [`Target`] takes any bytes. It panics if the code under test panics, or if an answer contradicts the
//! documentation. `cargo test` runs each target on the inputs of `corpus/` and in a short campaign with a fixed seed. A
//! longer campaign has `VERNE_FUZZ` inputs for each target, different ones for each `VERNE_FUZZ_SEED`, and fails if an
//! input takes more than a second:
//!
//! ```sh
//! VERNE_FUZZ=1000000 cargo test --release -p verne-fuzz solver -- --nocapture
//! ```
//!
//! `corpus/` contains few inputs: each reaches code that the others do not, or once made a target panic. They were
//! chosen greedily by the source coverage (`-C instrument-coverage`) of the product.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::missing_panics_doc,
    reason = "a target stops at the first surprise"
)]

pub mod campaign;
mod client;
mod draw;
mod json;
mod keys;
#[path = "../../../src/solver/tests/support/lengths.rs"]
mod lengths;
mod machines;
mod mesh;
mod programs;
mod requests;
mod rows;
mod settings;
mod solver;
mod store;
mod workspaces;

/// A part of the product that takes arbitrary bytes.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The name of the target and of its directory in the corpus.
    pub name: &'static str,
    /// Runs the target on one input; panics if something is wrong.
    pub run: fn(&[u8]),
    /// The number of mutations that `cargo test` runs.
    pub default_inputs: u32,
}

/// All targets.
pub const TARGETS: [Target; 18] = [
    Target { name: "apt", run: programs::apt, default_inputs: 5_000 },
    Target { name: "body", run: requests::body, default_inputs: 500 },
    Target { name: "csv", run: programs::csv, default_inputs: 5_000 },
    Target { name: "gcode", run: programs::gcode, default_inputs: 5_000 },
    Target { name: "headers", run: requests::headers, default_inputs: 500 },
    Target { name: "keys", run: keys::keys, default_inputs: 200 },
    Target { name: "machine", run: requests::machine, default_inputs: 500 },
    Target { name: "mesh", run: mesh::mesh, default_inputs: 2_000 },
    Target { name: "ndjson", run: programs::ndjson, default_inputs: 5_000 },
    Target { name: "packed_program", run: programs::packed, default_inputs: 2_000 },
    Target { name: "query", run: requests::query, default_inputs: 500 },
    Target { name: "settings", run: settings::settings, default_inputs: 100 },
    Target { name: "solver", run: solver::solver, default_inputs: 20_000 },
    Target { name: "store", run: store::store, default_inputs: 200 },
    Target { name: "table_arrow", run: rows::arrow, default_inputs: 5_000 },
    Target { name: "table_csv", run: rows::csv, default_inputs: 5_000 },
    Target { name: "table_ndjson", run: rows::ndjson, default_inputs: 5_000 },
    Target { name: "workspaces", run: workspaces::workspaces, default_inputs: 50 },
];

/// The target of a name.
pub fn target(name: &str) -> Option<Target> {
    TARGETS.into_iter().find(|target| target.name == name)
}

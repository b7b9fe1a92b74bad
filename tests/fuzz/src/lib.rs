//! Arbitrary bytes against every parser, and arbitrary numbers, finite or not, against the solver.
//!
//! A [`Target`] takes any bytes and panics where the code under test does, or where what it answers is not what is
//! documented. `cargo test` gives each target the inputs of `corpus/` and a short campaign of a fixed seed; a longer one
//! has `VERNE_FUZZ` inputs for each target, other ones for each `VERNE_FUZZ_SEED`, and takes no input for sound that keeps
//! a target busy for more than a second:
//!
//! ```sh
//! VERNE_FUZZ=1000000 cargo test --release -p verne-fuzz solver -- --nocapture
//! ```

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
mod machines;
mod mesh;
mod programs;
mod requests;
mod settings;
mod solver;
mod store;
mod workspaces;

/// Something that takes any bytes.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, and that of its directory of the corpus.
    pub name: &'static str,
    /// Panics where something is wrong.
    pub run: fn(&[u8]),
    /// So many inputs are tried by `cargo test`.
    pub few: u32,
}

/// All of them.
pub const TARGETS: [Target; 14] = [
    Target { name: "apt", run: programs::apt, few: 5_000 },
    Target { name: "body", run: requests::body, few: 500 },
    Target { name: "csv", run: programs::csv, few: 5_000 },
    Target { name: "headers", run: requests::headers, few: 500 },
    Target { name: "keys", run: keys::keys, few: 200 },
    Target { name: "machine", run: requests::machine, few: 500 },
    Target { name: "mesh", run: mesh::mesh, few: 2_000 },
    Target { name: "ndjson", run: programs::ndjson, few: 5_000 },
    Target { name: "packed_program", run: programs::packed, few: 2_000 },
    Target { name: "query", run: requests::query, few: 500 },
    Target { name: "settings", run: settings::settings, few: 100 },
    Target { name: "solver", run: solver::solver, few: 20_000 },
    Target { name: "store", run: store::store, few: 200 },
    Target { name: "workspaces", run: workspaces::workspaces, few: 50 },
];

/// The target of a name.
pub fn target(name: &str) -> Option<Target> {
    TARGETS.into_iter().find(|target| target.name == name)
}

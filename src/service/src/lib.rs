//! The verne service: kinematics and workspaces of the VERNE machine's architecture over HTTP and on the command line.
//!
//! Dependencies point one way: main → cli → app → router → handlers → answers → wire, state, error.

mod access;
mod admission;
mod answers;
pub mod app;
mod browsers;
pub mod cli;
mod coding;
pub mod config;
mod delivery;
mod drawing;
mod error;
mod extract;
mod faults;
mod fixed;
mod handlers;
mod layers;
mod machine_hash;
mod metrics;
mod negotiation;
mod observe;
mod obtain;
mod openapi;
mod parameters;
mod prefer;
mod problem;
mod published;
mod readiness;
mod refusals;
mod registry;
mod result_id;
mod results;
mod router;
mod server;
mod signals;
mod state;
mod storage;
mod tasks;
mod telemetry;
mod viewer;
mod wire;
mod worker;
mod workers;

//! The process: command line, configuration, listeners, signals, storage and workers.
//!
//! May import all other modules.

pub(crate) mod cli;
pub(crate) mod config;
pub(crate) mod server;
pub(crate) mod service;
pub(crate) mod signals;
pub(crate) mod storage;
pub(crate) mod worker_process;

//! The process: command line, configuration, listeners, signals, storage and workers.
//!
//! May import all other modules.
//!
//! - `cli` reads the command line and runs one command; `config` reads the settings.
//! - `service` is `verne serve`; `worker_process` is `verne worker`.
//! - `storage` opens the result store and the job queue for both.
//! - `server` accepts and serves connections; `signals` tells when to stop;
//!   `start_error` says why a process does not start.

pub(crate) mod cli;
pub(crate) mod config;
pub(crate) mod server;
pub(crate) mod service;
pub(crate) mod signals;
pub(crate) mod start_error;
pub(crate) mod storage;
pub(crate) mod worker_process;

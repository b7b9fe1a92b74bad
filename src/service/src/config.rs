//! Settings of `verne serve`, from flags and environment.

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::Args;

use crate::state::RequestLimits;

/// Where and what to serve.
#[derive(Clone, Debug, Args)]
pub struct ServeConfig {
    /// Address to listen on.
    #[arg(long, env = "VERNE_LISTEN", default_value = "127.0.0.1:8080")]
    pub listen: SocketAddr,
    /// Directory whose *.json machines are published beside the built-in one.
    #[arg(long, env = "VERNE_MACHINES", value_name = "DIR")]
    pub machines: Option<PathBuf>,
    /// Most bytes in the body of a batch.
    #[arg(long, env = "VERNE_MAX_BODY_BYTES", default_value_t = 16 * 1024 * 1024)]
    pub max_body_bytes: usize,
    /// Most rows in a batch.
    #[arg(long, env = "VERNE_MAX_ROWS", default_value_t = 100_000)]
    pub max_rows: usize,
    /// Most bytes of workspaces, meshes included, that are kept in memory.
    #[arg(long, env = "VERNE_CACHE_BYTES", default_value_t = 256 * 1024 * 1024)]
    pub cache_bytes: u64,
    /// Seconds after which a request is given up.
    #[arg(long, env = "VERNE_TIMEOUT", default_value_t = 30, value_name = "SECONDS")]
    pub timeout: u64,
}

impl ServeConfig {
    pub(crate) fn limits(&self) -> RequestLimits {
        RequestLimits { body_bytes: self.max_body_bytes, rows: self.max_rows }
    }
}

//! Limits of what clients may use: API keys, rates, quotas and admission.
//!
//! May import `wire`.

pub(crate) mod admission;
pub(crate) mod client_address;
pub(crate) mod client_quota;
pub(crate) mod error;
pub(crate) mod key;
pub(crate) mod keys;
pub(crate) mod keys_file;
pub(crate) mod rate;
pub(crate) mod response_memory;
pub(crate) mod toml_error;
pub(crate) mod usage;

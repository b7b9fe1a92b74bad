//! Who may ask for what: API keys, their roles, and who is behind a request.

mod caller;
mod gate;
mod key;
mod keys;
mod keys_file;
mod pages;
mod proxies;
mod rate;
mod role;

pub(crate) use caller::Caller;
pub(crate) use gate::{Access, Gate};
pub(crate) use key::Key;
pub(crate) use keys_file::BadKeys;
pub(crate) use keys_file::is_name;
pub(crate) use proxies::client_behind;
pub(crate) use role::Role;

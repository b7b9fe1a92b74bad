//! Results kept under content keys: in memory, and on disk when there is one. What they are, and who asks
//! for them, is the caller's business.
//!
//! Both layers are bounded in bytes and forget what was used least recently. Memory answers many callers from
//! one buffer, and lets one of them work while the others wait. Disk keeps what it was given across restarts:
//! an object is written beside its place, flushed and moved there in one step; it names its key, its length
//! and its hash, and whatever does not agree with them when it is read is never served.
//!
//! ```text
//! directory/lock             held while a process has the store open
//!           index.sqlite3    key, size and last use of each object
//!           objects/ab/cd…   a header and the bytes, named by the key's 64 digits
//! ```
//!
//! The objects are the truth and the index a memo of it: a row and its object are reconciled when the store is
//! opened, so that a crash between the two loses nothing.
//!
//! It runs on tokio; files, the index and the hashing of what is large are left to its blocking threads.

mod content;
mod disk;
mod fault;
mod held;
mod index;
mod key;
mod memory;
mod object;
mod stats;
mod store;

pub use content::Content;
pub use fault::OpenError;
pub use key::Key;
pub use stats::Stats;
pub use store::{Config, Kept, Store};

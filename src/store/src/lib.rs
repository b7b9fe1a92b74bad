//! Results kept under content keys: in memory, and below it on a disk of the process's own or in a store that
//! many processes share. What they are, and who asks for them, is the caller's business.
//!
//! Memory is bounded in bytes and forgets what was used least recently. It answers many callers from one buffer,
//! and lets one of them work while the others wait. What lies below is an object a key: written beside its place
//! and moved there in one step, or uploaded and seen when it is complete. An object names its key and its length
//! and has a hash of every mebibyte. Whatever does not agree with them when it is read is never served, counts
//! as damaged and is removed: what it held is computed again. Objects of another version of the format are
//! treated so too.
//!
//! [`Store::get`] answers a content whole. [`Store::find`] answers one that is read as far as it is wanted: what
//! is in memory as a slice of it, what is of a mebibyte or less by way of memory, what is larger chunk by chunk
//! from below: a slow reader holds two chunks and not the content.
//!
//! # On disk
//!
//! One process at a time. What was given is kept across restarts; the disk is bounded in bytes too, and what was
//! used least recently goes.
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
//! # Shared
//!
//! `s3://bucket/prefix` or `file:///shared/directory`, opened by as many processes as there are:
//!
//! ```text
//! prefix/ab/cd…              the same objects
//!        verne-store         of a directory: its marker, made by Store::init_shared
//!        probe/…             a process tries whether it can write; removed at once
//! ```
//!
//! There is no index and no lock. Two writers of one key write the same bytes, so that it does not matter whose
//! stay; a reader sees an object whole or not at all. Large objects are sent to S3 in parts of 8 MiB, four at a
//! time. What the store refuses is asked again for up to 30 s, a single request to S3 ten times and for up to
//! 10 s; then a content that cannot be written is [`Kept::MemoryOnly`], and one that cannot be read is as if not
//! there. A request to S3 has 5 s to connect and 30 s in all (`AWS_CONNECT_TIMEOUT`, `AWS_TIMEOUT`).
//!
//! Nothing is evicted and [`Stats::disk_bytes`] is unknown: how long results are kept is the bucket's business.
//! A rule for a bucket, which also removes what is left of an upload when its process dies:
//!
//! ```json
//! {"Rules": [{
//!   "ID": "results", "Status": "Enabled", "Filter": {"Prefix": "prefix/"},
//!   "Expiration": {"Days": 30},
//!   "AbortIncompleteMultipartUpload": {"DaysAfterInitiation": 1}
//! }]}
//! ```
//!
//! The same for a directory, once a day on one of the machines; a file that was never finished (`…#1`) goes too:
//!
//! ```text
//! find /shared/directory -mindepth 2 -type f -mtime +30 -delete
//! ```
//!
//! A directory without its marker is not used: it is the mount point of a file system that is not mounted, and what one
//! process wrote there no other would find. Where the marker is missing when the store is opened, that is an error. Where it
//! goes later, questions wait for it as for a store that refuses.
//!
//! Both count from when a result was written, not from when it was read. A result that goes while it is read from
//! S3 breaks off with an error; from a directory it is read to the end, except where the file system is a
//! network's and says otherwise. A directory must have renames that are atomic for all its readers, as NFS and
//! CephFS have. What is not held: a damaged object may be removed just after another process wrote it anew, and
//! is then computed once more.
//!
//! It runs on tokio; files, the index and the hashing of what is large are left to its blocking threads.

mod below;
mod content;
mod disk;
mod fault;
mod found;
mod health;
mod held;
mod index;
mod key;
mod memory;
mod object;
mod objects;
mod shared;
mod stats;
mod store;

pub use content::Content;
pub use fault::OpenError;
pub use found::{Found, ReadFault};
pub use key::Key;
pub use object::Damage;
pub use stats::Stats;
pub use store::{Config, Kept, Store};

//! A bounded store of results under content keys: in memory, and in a backing store, which is a directory of this
//! process or a store that many processes share. The store knows nothing about the meaning of keys and contents.
//!
//! The memory cache is bounded in bytes and evicts the least recently used content. All callers share one buffer per
//! content. If several callers ask for a missing content at once, one of them works and the others wait.
//!
//! The backing store has one object per key. A writer writes a file beside its final place and renames it, or uploads
//! it and completes the upload: a reader sees a complete object or none. An object contains its key, its length and a
//! hash of every mebibyte. The store never serves bytes that disagree with them: it counts such an object as damaged
//! and removes it, and the caller computes the result again. The same holds for objects of another format version.
//!
//! [`Store::get`] returns a whole content. [`Store::reader`] returns a reader for parts of it: a slice of the buffer if
//! the content is in memory, the whole content by way of memory if it has at most 1 MiB, and otherwise chunk by chunk
//! from the backing store. A slow reader occupies two chunks of memory, not the content.
//!
//! # Directory of one process
//!
//! One process opens it at a time. Contents survive a restart. The objects are bounded in bytes; the least recently
//! used ones are evicted.
//!
//! ```text
//! directory/lock             locked while a process has the store open
//!           index.sqlite3    key, size and last use of each object
//!           objects/ab/cd…   a header and the bytes, named by the 64 digits of the key
//! ```
//!
//! The index repeats what the objects state. Opening the store reconciles the two, so a crash between the writing of
//! an object and the writing of its row loses nothing.
//!
//! # Shared store
//!
//! Any number of processes open `s3://bucket/prefix` or `file:///shared/directory`:
//!
//! ```text
//! prefix/ab/cd…              the same objects
//!        verne-store         in a directory: its marker, written by Store::init_shared
//!        probe/…             written and removed at once, to test whether the store is writable
//! ```
//!
//! There is no index and no lock. Two writers of one key write the same bytes, so either may win. Objects of more than
//! 8 MiB are uploaded to S3 in parts of 8 MiB, four at a time. An operation that the store refuses is repeated for up
//! to 30 s, and a single request to S3 ten times in up to 10 s. After that, a content that could not be written is
//! [`Durability::MemoryOnly`], and an object that could not be read counts as absent. A request to S3 may take 5 s to
//! connect and 30 s in all (`AWS_CONNECT_TIMEOUT`, `AWS_TIMEOUT`).
//!
//! The store evicts nothing, and [`Stats::disk_bytes`] is unknown: the operator decides how long results stay. A
//! lifecycle rule for a bucket, which also removes the parts of an upload whose process died:
//!
//! ```json
//! {"Rules": [{
//!   "ID": "results", "Status": "Enabled", "Filter": {"Prefix": "prefix/"},
//!   "Expiration": {"Days": 30},
//!   "AbortIncompleteMultipartUpload": {"DaysAfterInitiation": 1}
//! }]}
//! ```
//!
//! The same for a directory, once a day on one machine; it also removes unfinished files (`…#1`):
//!
//! ```text
//! find /shared/directory -mindepth 2 -type f -mtime +30 -delete
//! ```
//!
//! The store does not use a directory without a marker: such a directory is the mount point of a file system that is
//! not mounted, and other processes would not find the files. If the marker is missing at opening, that is an error. If
//! it disappears later, operations are repeated as for a store that refuses them.
//!
//! Both rules count from the writing of a result, not from its last use. If a result expires while it is read, the
//! reader of an S3 store gets an error; the reader of a local directory reads to the end, the reader of a network file
//! system perhaps not. A shared directory needs renames that are atomic for all readers, as NFS and CephFS have. One
//! race remains: a process may remove a damaged object just after another one has rewritten it. Then the result is
//! computed once more.
//!
//! The crate needs a tokio runtime. Files, the index and the hashing of large contents run on its blocking threads.

mod backing_store;
mod config;
mod content;
mod disk;
mod error;
mod format;
mod health;
mod index;
mod key;
mod live_buffers;
mod marker;
mod memory_cache;
mod object_io;
mod object_reader;
mod reader;
mod shared;
mod single_flight;
mod stats;
mod store;
mod upload;

pub use config::{Config, Durability};
pub use content::Content;
pub use error::OpenError;
pub use format::FormatError;
pub use key::Key;
pub use reader::{ContentReader, ReadError};
pub use stats::Stats;
pub use store::Store;

//! The guarantees of the store: one buffer and one computation per content, only intact contents, limits, and
//! durability.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

#[path = "store/controlled_objects.rs"]
mod controlled_objects;
#[path = "store/damage.rs"]
mod damage;
#[path = "store/directory.rs"]
mod directory;
#[path = "store/eviction.rs"]
mod eviction;
#[path = "store/failures.rs"]
mod failures;
#[path = "store/index.rs"]
mod index;
#[path = "store/memory.rs"]
mod memory;
#[path = "store/multipart_upload.rs"]
mod multipart_upload;
#[path = "store/reader.rs"]
mod reader;
#[path = "store/recording_objects.rs"]
mod recording_objects;
#[path = "store/restart.rs"]
mod restart;
#[path = "store/s3.rs"]
mod s3;
#[path = "store/shared.rs"]
mod shared;
#[path = "store/shared_buffers.rs"]
mod shared_buffers;

//! What a user of the store relies on: one buffer, one computation, nothing served that was not written, bounds
//! kept, and all of it there again after a restart.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

#[path = "store/damage.rs"]
mod damage;
#[path = "store/disk.rs"]
mod disk;
#[path = "store/eviction.rs"]
mod eviction;
#[path = "store/failures.rs"]
mod failures;
#[path = "store/found.rs"]
mod found;
#[path = "store/index.rs"]
mod index;
#[path = "store/memory.rs"]
mod memory;
#[path = "store/objects.rs"]
mod objects;
#[path = "store/parts.rs"]
mod parts;
#[path = "store/place.rs"]
mod place;
#[path = "store/s3.rs"]
mod s3;
#[path = "store/shared.rs"]
mod shared;
#[path = "store/sharing.rs"]
mod sharing;
#[path = "store/watched.rs"]
mod watched;

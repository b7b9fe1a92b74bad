//! Memory's bound is one of buffers alive, not of entries counted.
//!
//! A process of its own: what moka has evicted lives while any thread is at work in any cache.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use bytes::Bytes;
use verne_store::{Key, Store};

/// A buffer that is counted while it is alive.
struct Counted(Vec<u8>, Arc<AtomicU32>);

impl Counted {
    fn bytes(alive: &Arc<AtomicU32>) -> Bytes {
        alive.fetch_add(1, Ordering::SeqCst);
        Bytes::from_owner(Self(vec![0; 60 << 10], Arc::clone(alive)))
    }
}

impl AsRef<[u8]> for Counted {
    fn as_ref(&self) -> &[u8] {
        &self.0
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        self.1.fetch_sub(1, Ordering::SeqCst);
    }
}

#[tokio::test]
async fn what_memory_forgets_is_freed_at_once() {
    // Room for four contents, and for none.
    for (room, most) in [(250 << 10, 4), (50 << 10, 0)] {
        let (store, alive) = (Store::in_memory(room), Arc::new(AtomicU32::new(0)));
        for number in 0..40 {
            store.put(&Key::from([number; 32]), Counted::bytes(&alive)).await;
            assert!(alive.load(Ordering::SeqCst) <= most, "put {number}");
        }
        for number in 40..80 {
            let make = async { Ok::<_, String>(Counted::bytes(&alive)) };
            let made = store.get_or_make(&Key::from([number; 32]), make).await;
            assert!(made.is_ok());
            drop(made);
            assert!(alive.load(Ordering::SeqCst) <= most, "made {number}");
        }
    }
}

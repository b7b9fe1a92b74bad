//! The memory cache, and one computation for concurrent callers.

use std::future;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use bytes::Bytes;
use tokio::sync::Semaphore;
use tokio::task::JoinSet;
use verne_store::{Durability, Store};

use crate::directory::{TestDirectory, bytes, key};

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
async fn the_memory_limit_counts_live_buffers() {
    // Room for four contents, and for none.
    for (memory_bytes, most) in [(250 << 10, 4), (50 << 10, 0)] {
        let (store, alive) = (Store::in_memory(memory_bytes), Arc::new(AtomicU32::new(0)));
        for number in 0..40 {
            store.put(&key(number), Counted::bytes(&alive)).await;
            assert!(alive.load(Ordering::SeqCst) <= most, "put {number}");
        }
        for number in 40..80 {
            let make = async { Ok::<_, String>(Counted::bytes(&alive)) };
            let made = store.get_or_make(&key(number), make).await;
            assert!(made.is_ok());
            drop(made);
            assert!(alive.load(Ordering::SeqCst) <= most, "made {number}");
        }
    }
}

#[tokio::test]
async fn a_stored_content_is_returned_with_its_hash() {
    let store = Store::in_memory(1 << 20);
    assert_eq!(store.get(&key(1)).await, None);
    let (put, durability) = store.put(&key(1), bytes(1, 100_000)).await;
    assert_eq!(put.hash, blake3::hash(&bytes(1, 100_000)));
    assert_eq!(durability, Durability::MemoryOnly);
    let got = store.get(&key(1)).await.unwrap();
    assert_eq!(got.bytes, bytes(1, 100_000));
    assert_eq!(got.hash, put.hash);
    let stats = store.stats();
    assert_eq!((stats.memory_hits, stats.disk_hits, stats.misses), (1, 0, 1));
    assert_eq!(store.healthy().await, Ok(()));
}

#[tokio::test]
async fn a_second_content_replaces_the_first() {
    let store = Store::in_memory(1 << 20);
    let (old, _) = store.put(&key(1), bytes(1, 100)).await;
    store.put(&key(1), bytes(2, 100)).await;
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(2, 100));
    assert_eq!(old.bytes, bytes(1, 100), "the bytes of a content never change");
}

#[tokio::test]
async fn memory_evicts_the_least_recently_used_content_at_its_limit() {
    let store = Store::in_memory(400 << 10);
    for number in 1..=3 {
        store.put(&key(number), bytes(number, 100 << 10)).await;
    }
    assert!(store.get(&key(1)).await.is_some());
    store.put(&key(4), bytes(4, 100 << 10)).await;
    for number in [1, 3, 4] {
        assert!(store.get(&key(number)).await.is_some(), "{number}");
    }
    assert_eq!(store.get(&key(2)).await, None);
    assert!(store.stats().memory_bytes <= 400 << 10);
}

#[tokio::test]
async fn a_content_larger_than_the_memory_limit_is_not_cached() {
    let store = Store::in_memory(10 << 10);
    let (content, _) = store.put(&key(1), bytes(1, 20 << 10)).await;
    assert_eq!(store.stats().memory_bytes, 0);
    assert!(store.get(&key(1)).await.is_some(), "the buffer of the caller is found");
    drop(content);
    assert_eq!(store.get(&key(1)).await, None);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn a_thousand_concurrent_callers_cause_one_computation() {
    // The content is of 100 kB: memory has room for it, or not, or for nothing.
    for memory in [1 << 20, 50 << 10, 0] {
        let store = Store::in_memory(memory);
        let (made, asked, all_asked) =
            (Arc::new(AtomicU32::new(0)), Arc::new(AtomicU32::new(0)), Arc::new(Semaphore::new(0)));
        let mut callers = JoinSet::new();
        for _ in 0..1000 {
            let (store, made, asked, all_asked) =
                (store.clone(), Arc::clone(&made), Arc::clone(&asked), Arc::clone(&all_asked));
            callers.spawn(async move {
                if asked.fetch_add(1, Ordering::SeqCst) == 999 {
                    all_asked.add_permits(1);
                }
                let make = async {
                    made.fetch_add(1, Ordering::SeqCst);
                    all_asked.acquire().await.unwrap().forget();
                    Ok::<_, String>(bytes(1, 100_000))
                };
                store.get_or_make(&key(1), make).await.unwrap()
            });
        }
        let contents = callers.join_all().await;
        assert_eq!(made.load(Ordering::SeqCst), 1);
        assert!(contents.iter().all(|content| content.bytes.as_ptr() == contents[0].bytes.as_ptr()));
        let stats = store.stats();
        assert_eq!((stats.memory_hits, stats.misses), (999, 1));
    }
}

#[tokio::test]
async fn an_error_is_returned_and_not_stored() {
    let store = Store::in_memory(1 << 20);
    let failed = store.get_or_make(&key(1), future::ready(Err("no"))).await;
    assert_eq!(failed.unwrap_err(), "no");
    let made = store.get_or_make(&key(1), future::ready(Ok::<_, &str>(bytes(1, 10)))).await;
    assert_eq!(made.unwrap().bytes, bytes(1, 10));
    let durability = store.get_or_make(&key(1), future::ready(Err("not asked"))).await;
    assert_eq!(durability.unwrap().bytes, bytes(1, 10));
}

#[tokio::test(flavor = "multi_thread")]
async fn another_caller_takes_over_from_a_dropped_one() {
    let store = Store::in_memory(1 << 20);
    let began = Arc::new(Semaphore::new(0));
    let first = {
        let (store, began) = (store.clone(), Arc::clone(&began));
        tokio::spawn(async move {
            let never = async {
                began.add_permits(1);
                future::pending::<Result<Bytes, String>>().await
            };
            store.get_or_make(&key(1), never).await
        })
    };
    began.acquire().await.unwrap().forget();
    let second = {
        let store = store.clone();
        let make = future::ready(Ok::<_, String>(bytes(1, 10)));
        tokio::spawn(async move { store.get_or_make(&key(1), make).await })
    };
    first.abort();
    assert_eq!(second.await.unwrap().unwrap().bytes, bytes(1, 10));
}

#[tokio::test]
async fn a_content_that_is_not_cached_takes_no_memory_beside_a_disk() {
    let directory = TestDirectory::new();
    let store = directory.open().await;
    store.put(&key(1), bytes(1, 1000)).await;
    let (content, durability) = store.put_uncached(&key(1), bytes(2, 100_000)).await;
    assert_eq!((durability, store.stats().memory_bytes), (Durability::Durable, 0));
    assert_eq!(store.get(&key(1)).await, Some(content), "and not the old one");
    // Without a disk, memory is the only place.
    let store = Store::in_memory(1 << 20);
    store.put_uncached(&key(2), bytes(2, 1000)).await;
    assert_eq!(store.get(&key(2)).await.map(|content| content.bytes), Some(bytes(2, 1000)));
}

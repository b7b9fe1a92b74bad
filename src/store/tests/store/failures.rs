//! A disk that is full, read-only or broken: answers go on, and the fault is counted and told.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use verne_store::{Kept, OpenError, Store};

use crate::objects::Objects;
use crate::place::{HEADER, Place, bytes, key};

/// A store with memory, over objects that the test commands.
async fn store(place: &Place, disk_bytes: u64) -> (Store, Arc<Objects>) {
    let objects = place.objects();
    let store =
        Store::open_over(Arc::clone(&objects) as _, &place.path(), 1 << 20, disk_bytes).await.unwrap();
    (store, objects)
}

#[tokio::test]
async fn a_full_disk_is_counted_and_memory_answers() {
    let place = Place::new();
    let (store, objects) = store(&place, 1 << 30).await;
    objects.puts_fail.store(true, Ordering::Relaxed);
    let (put, kept) = store.put(&key(1), bytes(1, 1000)).await;
    assert_eq!(kept, Kept::MemoryOnly);
    assert_eq!(store.get(&key(1)).await, Some(put));
    let made = store.get_or_make(&key(2), async { Ok::<_, String>(bytes(2, 1000)) }).await.unwrap();
    assert_eq!(store.get(&key(2)).await, Some(made));
    assert_eq!((store.stats().write_failures, store.stats().disk_bytes), (2, Some(0)));

    objects.puts_fail.store(false, Ordering::Relaxed);
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Kept::Durable);
}

#[tokio::test]
async fn a_disk_that_takes_nothing_is_an_error_at_the_start() {
    let place = Place::new();
    let objects = place.objects();
    objects.puts_fail.store(true, Ordering::Relaxed);
    let opened = Store::open_over(objects, &place.path(), 0, 1 << 30).await;
    let Err(fault @ OpenError::Objects { .. }) = opened else { panic!("opened") };
    assert!(fault.to_string().contains("no space left"), "{fault}");
}

#[tokio::test]
async fn an_object_that_cannot_be_read_is_as_if_not_there_and_stays() {
    let place = Place::new();
    place.open().await.put(&key(1), bytes(1, 1000)).await;
    let (store, objects) = store(&place, 1 << 30).await;
    objects.gets_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.get(&key(1)).await, None);
    assert_eq!((store.stats().read_failures, store.stats().damaged), (1, 0));
    objects.gets_fail.store(false, Ordering::Relaxed);
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
}

#[tokio::test]
async fn where_nothing_can_be_removed_the_bound_is_kept_by_writing_nothing() {
    let place = Place::new();
    let (store, objects) = store(&place, 1500).await;
    store.put(&key(1), bytes(1, 1000)).await;
    objects.deletes_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.put(&key(2), bytes(2, 1000)).await.1, Kept::MemoryOnly);
    let stats = store.stats();
    assert_eq!((stats.write_failures, stats.evictions, stats.disk_bytes), (1, 0, Some(1000 + HEADER)));
    assert!(!place.file(key(2)).exists());
}

#[tokio::test]
async fn an_object_that_the_index_refuses_does_not_stay_uncounted() {
    let place = Place::new();
    let (store, _) = store(&place, 1 << 30).await;
    place.sql("CREATE TRIGGER refusal BEFORE INSERT ON objects BEGIN SELECT RAISE(ABORT, 'refused'); END");
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Kept::MemoryOnly);
    assert!(!place.file(key(1)).exists());
    assert_eq!((store.stats().write_failures, store.stats().disk_bytes), (1, Some(0)));
}

#[tokio::test(start_paused = true)]
async fn health_is_asked_of_the_disk_every_few_seconds() {
    let place = Place::new();
    let (store, objects) = store(&place, 1 << 30).await;
    assert_eq!(store.healthy().await, Ok(()));
    objects.puts_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.healthy().await, Ok(()), "believed for a while");
    tokio::time::advance(Duration::from_secs(6)).await;
    let fault = store.healthy().await.unwrap_err();
    assert!(fault.contains("no space left"), "{fault}");
    objects.puts_fail.store(false, Ordering::Relaxed);
    tokio::time::advance(Duration::from_secs(6)).await;
    assert_eq!(store.healthy().await, Ok(()));
}

//! A full, read-only or broken disk: memory answers, and the errors are counted and logged.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use verne_store::{Durability, OpenError, Store};

use crate::controlled_objects::ControlledObjects;
use crate::directory::{HEADER, TestDirectory, bytes, key};

/// A store with a memory cache over controlled objects.
async fn store(directory: &TestDirectory, disk_bytes: u64) -> (Store, Arc<ControlledObjects>) {
    let objects = directory.objects();
    let store =
        Store::open_over(Arc::clone(&objects) as _, &directory.path(), 1 << 20, disk_bytes).await.unwrap();
    (store, objects)
}

#[tokio::test]
async fn a_full_disk_is_counted_and_memory_answers() {
    let directory = TestDirectory::new();
    let (store, objects) = store(&directory, 1 << 30).await;
    objects.puts_fail.store(true, Ordering::Relaxed);
    let (put, durability) = store.put(&key(1), bytes(1, 1000)).await;
    assert_eq!(durability, Durability::MemoryOnly);
    assert_eq!(store.get(&key(1)).await, Some(put));
    let made = store.get_or_make(&key(2), async { Ok::<_, String>(bytes(2, 1000)) }).await.unwrap();
    assert_eq!(store.get(&key(2)).await, Some(made));
    assert_eq!((store.stats().write_failures, store.stats().disk_bytes), (2, Some(0)));

    objects.puts_fail.store(false, Ordering::Relaxed);
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Durability::Durable);
}

#[tokio::test]
async fn opening_a_full_disk_fails() {
    let directory = TestDirectory::new();
    let objects = directory.objects();
    objects.puts_fail.store(true, Ordering::Relaxed);
    let opened = Store::open_over(objects, &directory.path(), 0, 1 << 30).await;
    let Err(error @ OpenError::Objects { .. }) = opened else { panic!("opened") };
    assert!(error.to_string().contains("no space left"), "{error}");
}

#[tokio::test]
async fn an_unreadable_object_counts_as_absent_and_is_not_removed() {
    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 1000)).await;
    let (store, objects) = store(&directory, 1 << 30).await;
    objects.gets_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.get(&key(1)).await, None);
    assert_eq!((store.stats().read_failures, store.stats().damaged), (1, 0));
    objects.gets_fail.store(false, Ordering::Relaxed);
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
}

#[tokio::test]
async fn nothing_is_written_if_no_room_can_be_made() {
    let directory = TestDirectory::new();
    let (store, objects) = store(&directory, 1500).await;
    store.put(&key(1), bytes(1, 1000)).await;
    objects.deletes_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.put(&key(2), bytes(2, 1000)).await.1, Durability::MemoryOnly);
    let stats = store.stats();
    assert_eq!((stats.write_failures, stats.evictions, stats.disk_bytes), (1, 0, Some(1000 + HEADER)));
    assert!(!directory.file(key(2)).exists());
}

#[tokio::test]
async fn an_object_is_deleted_if_its_row_cannot_be_inserted() {
    let directory = TestDirectory::new();
    let (store, _) = store(&directory, 1 << 30).await;
    directory
        .sql("CREATE TRIGGER refusal BEFORE INSERT ON objects BEGIN SELECT RAISE(ABORT, 'refused'); END");
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Durability::MemoryOnly);
    assert!(!directory.file(key(1)).exists());
    assert_eq!((store.stats().write_failures, store.stats().disk_bytes), (1, Some(0)));
}

#[tokio::test(start_paused = true)]
async fn the_disk_is_probed_every_few_seconds() {
    let directory = TestDirectory::new();
    let (store, objects) = store(&directory, 1 << 30).await;
    assert_eq!(store.healthy().await, Ok(()));
    objects.puts_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.healthy().await, Ok(()), "the last outcome is reused");
    tokio::time::advance(Duration::from_secs(6)).await;
    let error = store.healthy().await.unwrap_err();
    assert!(error.contains("no space left"), "{error}");
    objects.puts_fail.store(false, Ordering::Relaxed);
    tokio::time::advance(Duration::from_secs(6)).await;
    assert_eq!(store.healthy().await, Ok(()));
}

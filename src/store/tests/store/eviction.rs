//! The limit on disk: which objects are evicted.

use verne_store::{Durability, Store};

use crate::directory::{HEADER, TestDirectory, bytes, key};

/// Room for three objects of 1000 bytes, and not for four.
const ROOM: u64 = 3 * (1000 + HEADER) + 500;

async fn put(store: &Store, numbers: impl IntoIterator<Item = u8>) {
    for number in numbers {
        store.put(&key(number), bytes(number, 1000)).await;
    }
}

/// Which of the numbers lie on disk.
fn on_disk(directory: &TestDirectory, numbers: impl IntoIterator<Item = u8>) -> Vec<u8> {
    numbers.into_iter().filter(|number| directory.file(key(*number)).exists()).collect()
}

#[tokio::test]
async fn the_least_recently_used_objects_are_evicted_at_the_limit() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(ROOM).await;
    for number in 1..=5 {
        put(&store, [number]).await;
        assert!(store.stats().disk_bytes.unwrap() <= ROOM);
    }
    assert_eq!(on_disk(&directory, 1..=5), [3, 4, 5]);
    assert_eq!(store.stats().evictions, 2);
}

#[tokio::test]
async fn a_read_from_memory_counts_as_a_use() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(ROOM).await;
    put(&store, 1..=3).await;
    assert!(store.get(&key(1)).await.is_some());
    assert_eq!(store.stats().memory_hits, 1);
    put(&store, [4]).await;
    assert_eq!(on_disk(&directory, 1..=4), [1, 3, 4]);
}

#[tokio::test]
async fn the_order_of_uses_survives_a_restart() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(ROOM).await;
    put(&store, 1..=3).await;
    assert!(store.get(&key(1)).await.is_some());
    drop(store);
    let store = directory.open_with_limit(ROOM).await;
    put(&store, [4]).await;
    assert_eq!(on_disk(&directory, 1..=4), [1, 3, 4]);
}

#[tokio::test]
async fn many_uses_between_two_writes_are_all_recorded() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(1 << 30).await;
    let keys: Vec<_> =
        (0..280_u16).map(|number| verne_store::Key::from(blake3::hash(&number.to_le_bytes()))).collect();
    for key in &keys {
        store.put(key, bytes(1, 1000)).await;
    }
    // All but the newest are used again, in the opposite order: the newest are now the oldest.
    for key in keys[..270].iter().rev() {
        store.get(key).await.unwrap();
    }
    drop(store);
    let store = directory.open_with_limit(270 * (1000 + HEADER)).await;
    assert_eq!(store.stats().evictions, 10);
    let mut gone = Vec::new();
    for (number, key) in keys.iter().enumerate() {
        if store.get(key).await.is_none() {
            gone.push(number);
        }
    }
    assert_eq!(gone, (270..280).collect::<Vec<_>>());
}

#[tokio::test]
async fn a_smaller_limit_applies_at_opening() {
    let directory = TestDirectory::new();
    put(&directory.open().await, 1..=5).await;
    let store = directory.open_with_limit(ROOM).await;
    assert_eq!(on_disk(&directory, 1..=5), [3, 4, 5]);
    assert_eq!(store.stats().disk_bytes, Some(3 * (1000 + HEADER)));
}

#[tokio::test]
async fn a_replaced_object_evicts_no_other_if_it_fits() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(ROOM).await;
    put(&store, 1..=3).await;
    store.put(&key(1), bytes(9, 1500)).await;
    assert_eq!(on_disk(&directory, 1..=3), [1, 2, 3]);
    store.put(&key(2), bytes(9, 2500)).await;
    assert_eq!(on_disk(&directory, 1..=3), [2], "never the written object itself");
}

#[tokio::test]
async fn a_content_larger_than_the_limit_is_not_written_and_evicts_nothing() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(ROOM).await;
    put(&store, 1..=3).await;
    let (content, durability) = store.put(&key(4), bytes(4, 4000)).await;
    assert_eq!(durability, Durability::MemoryOnly);
    assert_eq!(store.get(&key(4)).await, Some(content));
    assert_eq!(on_disk(&directory, 1..=4), [1, 2, 3]);
    assert_eq!(store.stats().write_failures, 0);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn concurrent_writers_and_readers_keep_the_limit_and_the_size() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(ROOM).await;
    let mut tasks = tokio::task::JoinSet::new();
    for number in 0..64 {
        let store = store.clone();
        tasks.spawn(async move {
            store.put(&key(number % 8), bytes(number % 8, 1000)).await;
            let asked = key(number % 5);
            let made = store.get_or_make(&asked, async { Ok::<_, String>(bytes(number % 5, 1000)) });
            assert_eq!(made.await.unwrap().bytes, bytes(number % 5, 1000));
        });
    }
    tasks.join_all().await;
    assert_eq!(store.stats().disk_bytes, Some(3 * (1000 + HEADER)));
    assert_eq!(on_disk(&directory, 0..8).len(), 3);
    assert_eq!((store.stats().damaged, store.stats().write_failures), (0, 0));
}

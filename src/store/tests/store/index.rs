//! The index after a crash, or after its loss, is reconciled with the objects.

use std::fs;

use tokio::runtime::Runtime;

use crate::directory::{HEADER, TestDirectory, bytes, key};

/// Three objects of 1000 bytes, written in the order of their numbers.
async fn three(directory: &TestDirectory) {
    let store = directory.open().await;
    for number in 1..=3 {
        store.put(&key(number), bytes(number, 1000)).await;
    }
}

#[tokio::test]
async fn an_object_without_a_row_is_entered_in_the_index() {
    let directory = TestDirectory::new();
    three(&directory).await;
    directory.sql(&format!("DELETE FROM objects WHERE key = x'{}'", key(2)));
    let store = directory.open().await;
    assert_eq!(store.stats().disk_bytes, Some(3 * (1000 + HEADER)));
    assert_eq!(store.get(&key(2)).await.unwrap().bytes, bytes(2, 1000));
}

#[tokio::test]
async fn a_row_without_an_object_is_deleted() {
    let directory = TestDirectory::new();
    three(&directory).await;
    fs::remove_file(directory.file(key(2))).unwrap();
    let store = directory.open().await;
    assert_eq!(store.stats().disk_bytes, Some(2 * (1000 + HEADER)));
    assert_eq!(store.get(&key(2)).await, None);
    assert_eq!(directory.rows(), 2);
}

#[tokio::test]
async fn a_lost_damaged_or_foreign_index_is_created_anew() {
    let lose = |directory: &TestDirectory| fs::remove_file(directory.path().join("index.sqlite3")).unwrap();
    let overwrite = |directory: &TestDirectory| {
        fs::write(directory.path().join("index.sqlite3"), "no data base").unwrap();
    };
    let shorten = |directory: &TestDirectory| {
        let index = fs::File::options().write(true).open(directory.path().join("index.sqlite3")).unwrap();
        index.set_len(5000).unwrap();
    };
    let of_later = |directory: &TestDirectory| directory.sql("PRAGMA user_version = 2");
    let without_table = |directory: &TestDirectory| directory.sql("DROP TABLE objects");
    let nonsense = |directory: &TestDirectory| directory.sql("UPDATE objects SET key = x'00' WHERE used = 1");
    let negative = |directory: &TestDirectory| directory.sql("UPDATE objects SET size = -5");
    let ways: [fn(&TestDirectory); 7] =
        [lose, overwrite, shorten, of_later, without_table, nonsense, negative];
    for (way, damage) in ways.into_iter().enumerate() {
        let directory = TestDirectory::new();
        three(&directory).await;
        damage(&directory);
        let store = directory.open().await;
        assert_eq!(store.stats().disk_bytes, Some(3 * (1000 + HEADER)), "way {way}");
        for number in 1..=3 {
            assert_eq!(store.get(&key(number)).await.unwrap().bytes, bytes(number, 1000), "way {way}");
        }
        assert_eq!(store.stats().damaged, 0, "way {way}");
    }
}

#[test]
fn a_crash_between_an_object_and_its_row_loses_nothing() {
    let directory = TestDirectory::new();
    let before = Runtime::new().unwrap();
    before.block_on(async {
        let objects = directory.objects();
        let store = directory.open_over(&objects, 1 << 30).await;
        objects.close_gate();
        tokio::spawn(async move { store.put(&key(1), bytes(1, 1000)).await });
        objects.arrival().await;
    });
    // The tasks end where they wait: the object is written, its row is not.
    drop(before);
    assert_eq!(directory.rows(), 0);
    Runtime::new().unwrap().block_on(async {
        let store = directory.open().await;
        assert_eq!(store.stats().disk_bytes, Some(1000 + HEADER));
        assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
    });
}

#[test]
fn a_crash_between_an_eviction_and_its_row_leaves_no_row() {
    let directory = TestDirectory::new();
    let before = Runtime::new().unwrap();
    before.block_on(async {
        let objects = directory.objects();
        let store = directory.open_over(&objects, 2000).await;
        store.put(&key(1), bytes(1, 1000)).await;
        objects.close_gate();
        tokio::spawn(async move { store.put(&key(2), bytes(2, 1000)).await });
        objects.arrival().await;
    });
    drop(before);
    assert!(!directory.file(key(1)).exists());
    assert_eq!(directory.rows(), 1);
    Runtime::new().unwrap().block_on(async {
        let store = directory.open_with_limit(2000).await;
        assert_eq!(store.stats().disk_bytes, Some(0));
        assert_eq!(store.get(&key(1)).await, None);
    });
}

#[test]
fn a_write_continues_after_its_caller_is_dropped() {
    let directory = TestDirectory::new();
    Runtime::new().unwrap().block_on(async {
        let objects = directory.objects();
        let store = directory.open_over(&objects, 1 << 30).await;
        objects.close_gate();
        let caller = {
            let store = store.clone();
            tokio::spawn(async move { store.put(&key(1), bytes(1, 1000)).await })
        };
        objects.arrival().await;
        caller.abort();
        assert!(caller.await.unwrap_err().is_cancelled());
        objects.open_gate();
        // Changes are serialized: after this one, the first is complete.
        store.put(&key(2), bytes(2, 1000)).await;
        assert_eq!(store.stats().disk_bytes, Some(2 * (1000 + HEADER)));
    });
}

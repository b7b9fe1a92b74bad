//! The index after a crash, and when it is lost: the objects say what it should.

use std::fs;

use tokio::runtime::Runtime;

use crate::place::{HEADER, Place, bytes, key};

/// Three objects of 1000 bytes, written in the order of their numbers.
async fn three(place: &Place) {
    let store = place.open().await;
    for number in 1..=3 {
        store.put(&key(number), bytes(number, 1000)).await;
    }
}

#[tokio::test]
async fn an_object_that_the_index_does_not_know_is_adopted() {
    let place = Place::new();
    three(&place).await;
    place.sql(&format!("DELETE FROM objects WHERE key = x'{}'", key(2)));
    let store = place.open().await;
    assert_eq!(store.stats().disk_bytes, Some(3 * (1000 + HEADER)));
    assert_eq!(store.get(&key(2)).await.unwrap().bytes, bytes(2, 1000));
}

#[tokio::test]
async fn a_row_whose_object_has_gone_is_struck_out() {
    let place = Place::new();
    three(&place).await;
    fs::remove_file(place.file(key(2))).unwrap();
    let store = place.open().await;
    assert_eq!(store.stats().disk_bytes, Some(2 * (1000 + HEADER)));
    assert_eq!(store.get(&key(2)).await, None);
    assert_eq!(place.rows(), 2);
}

#[tokio::test]
async fn an_index_that_is_lost_damaged_or_of_another_version_is_made_anew() {
    let lose = |place: &Place| fs::remove_file(place.path().join("index.sqlite3")).unwrap();
    let overwrite = |place: &Place| fs::write(place.path().join("index.sqlite3"), "no data base").unwrap();
    let shorten = |place: &Place| {
        let index = fs::File::options().write(true).open(place.path().join("index.sqlite3")).unwrap();
        index.set_len(5000).unwrap();
    };
    let of_later = |place: &Place| place.sql("PRAGMA user_version = 2");
    let without_table = |place: &Place| place.sql("DROP TABLE objects");
    let nonsense = |place: &Place| place.sql("UPDATE objects SET key = x'00' WHERE used = 1");
    let negative = |place: &Place| place.sql("UPDATE objects SET size = -5");
    let ways: [fn(&Place); 7] = [lose, overwrite, shorten, of_later, without_table, nonsense, negative];
    for (way, spoil) in ways.into_iter().enumerate() {
        let place = Place::new();
        three(&place).await;
        spoil(&place);
        let store = place.open().await;
        assert_eq!(store.stats().disk_bytes, Some(3 * (1000 + HEADER)), "way {way}");
        for number in 1..=3 {
            assert_eq!(store.get(&key(number)).await.unwrap().bytes, bytes(number, 1000), "way {way}");
        }
        assert_eq!(store.stats().damaged, 0, "way {way}");
    }
}

#[test]
fn a_crash_between_an_object_and_its_row_loses_nothing() {
    let place = Place::new();
    let before = Runtime::new().unwrap();
    before.block_on(async {
        let objects = place.objects();
        let store = place.open_over(&objects, 1 << 30).await;
        objects.close_gate();
        tokio::spawn(async move { store.put(&key(1), bytes(1, 1000)).await });
        objects.arrival().await;
    });
    // The tasks end where they wait: the object is written, the row is not.
    drop(before);
    assert_eq!(place.rows(), 0);
    Runtime::new().unwrap().block_on(async {
        let store = place.open().await;
        assert_eq!(store.stats().disk_bytes, Some(1000 + HEADER));
        assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
    });
}

#[test]
fn a_crash_between_an_eviction_and_its_row_leaves_no_ghost() {
    let place = Place::new();
    let before = Runtime::new().unwrap();
    before.block_on(async {
        let objects = place.objects();
        let store = place.open_over(&objects, 2000).await;
        store.put(&key(1), bytes(1, 1000)).await;
        objects.close_gate();
        tokio::spawn(async move { store.put(&key(2), bytes(2, 1000)).await });
        objects.arrival().await;
    });
    drop(before);
    assert!(!place.file(key(1)).exists());
    assert_eq!(place.rows(), 1);
    Runtime::new().unwrap().block_on(async {
        let store = place.open_bounded(2000).await;
        assert_eq!(store.stats().disk_bytes, Some(0));
        assert_eq!(store.get(&key(1)).await, None);
    });
}

#[test]
fn a_caller_that_goes_away_does_not_stop_the_writing() {
    let place = Place::new();
    Runtime::new().unwrap().block_on(async {
        let objects = place.objects();
        let store = place.open_over(&objects, 1 << 30).await;
        objects.close_gate();
        let caller = {
            let store = store.clone();
            tokio::spawn(async move { store.put(&key(1), bytes(1, 1000)).await })
        };
        objects.arrival().await;
        caller.abort();
        assert!(caller.await.unwrap_err().is_cancelled());
        objects.open_gate();
        // Writers take turns: after this one, the first is done.
        store.put(&key(2), bytes(2, 1000)).await;
        assert_eq!(store.stats().disk_bytes, Some(2 * (1000 + HEADER)));
    });
}

//! What is not the object that was written is never served, and gives way to what is computed again.

use std::fs;
use std::path::Path;

use verne_store::Store;

use crate::place::{Place, bytes, key};

/// Writes two objects, does something to the first one's file, and asks for it after a restart.
async fn asked_after(spoil: impl FnOnce(&Path, &Path)) -> (Place, Store) {
    let place = Place::new();
    let store = place.open().await;
    store.put(&key(1), bytes(1, 1000)).await;
    store.put(&key(2), bytes(2, 1000)).await;
    drop(store);
    spoil(&place.file(key(1)), &place.file(key(2)));
    let store = place.open().await;
    assert_eq!(store.get(&key(1)).await, None);
    assert_ne!(store.stats().damaged, 0);
    assert!(!place.file(key(1)).exists());
    assert_eq!(store.get(&key(2)).await.unwrap().bytes, bytes(2, 1000), "the other is as it was");
    (place, store)
}

/// Flips one bit.
fn flip(file: &Path, at: usize) {
    let mut object = fs::read(file).unwrap();
    object[at] ^= 1;
    fs::write(file, object).unwrap();
}

#[tokio::test]
async fn a_flipped_bit_anywhere_is_found() {
    // Magic, version, length, key, hash, the header's own hash, table, first and last byte.
    for at in [0, 8, 12, 20, 52, 84, 116, 148, 1147] {
        asked_after(|file, _| flip(file, at)).await;
    }
}

#[tokio::test]
async fn a_file_cut_short_or_grown_is_found() {
    for length in [0, 1, 115, 116, 148, 500, 1147, 1149] {
        asked_after(|file, _| {
            fs::File::options().write(true).open(file).unwrap().set_len(length).unwrap();
        })
        .await;
    }
}

#[tokio::test]
async fn another_keys_object_is_not_served() {
    asked_after(|file, other| assert_eq!(fs::copy(other, file).unwrap(), 1148)).await;
}

#[tokio::test]
async fn a_foreign_file_of_the_same_length_is_not_served() {
    asked_after(|file, _| fs::write(file, [b'x'; 1148]).unwrap()).await;
}

#[tokio::test]
async fn what_was_damaged_is_computed_again_and_kept() {
    let (place, store) = asked_after(|file, _| flip(file, 148)).await;
    let again = store.get_or_make(&key(1), async { Ok::<_, String>(bytes(1, 1000)) }).await;
    assert_eq!(again.unwrap().bytes, bytes(1, 1000));
    drop(store);
    let store = place.open().await;
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
    assert_eq!(store.stats().damaged, 0);
}

#[tokio::test]
async fn damage_while_the_store_is_open_is_found() {
    let place = Place::new();
    let store = place.open_without_memory().await;
    store.put(&key(1), bytes(1, 1000)).await;
    flip(&place.file(key(1)), 500);
    assert_eq!(store.get(&key(1)).await, None);
    assert_eq!((store.stats().damaged, store.stats().disk_bytes), (1, Some(0)));
}

#[tokio::test]
async fn a_file_larger_than_memory_is_not_read() {
    let place = Place::new();
    let store = place.open_bounded(10_000).await;
    let file = place.file(key(1));
    fs::create_dir_all(file.parent().unwrap()).unwrap();
    // A hole: as large as no memory is.
    fs::File::create(&file).unwrap().set_len(1 << 43).unwrap();
    assert_eq!(store.get(&key(1)).await, None);
    assert_eq!(store.stats().damaged, 1);
}

#[tokio::test]
async fn foreign_files_are_neither_counted_nor_removed() {
    let place = Place::new();
    place.open().await.put(&key(1), bytes(1, 1000)).await;
    let objects = place.path().join("objects");
    let foreign = [
        place.file(key(2)),
        objects.join("notes.txt"),
        objects.join("AB").join("f".repeat(62)),
        objects.join("ab/cd"),
    ];
    for file in &foreign {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, "not ours").unwrap();
    }
    let store = place.open_bounded(2000).await;
    assert_eq!(store.stats().disk_bytes, Some(1148));
    store.put(&key(4), bytes(4, 1000)).await;
    assert!(foreign.iter().all(|file| file.exists()), "eviction removes objects only");
    assert!(!place.file(key(1)).exists());
}

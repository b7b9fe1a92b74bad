//! A damaged object is never served; it is removed and its content computed again.

use std::fs;
use std::path::Path;

use verne_store::Store;

use crate::directory::{TestDirectory, bytes, key};

/// Writes two objects, damages the first one's file, and asks for it after a restart.
async fn open_after(damage: impl FnOnce(&Path, &Path)) -> (TestDirectory, Store) {
    let directory = TestDirectory::new();
    let store = directory.open().await;
    store.put(&key(1), bytes(1, 1000)).await;
    store.put(&key(2), bytes(2, 1000)).await;
    drop(store);
    damage(&directory.file(key(1)), &directory.file(key(2)));
    let store = directory.open().await;
    assert_eq!(store.get(&key(1)).await, None);
    assert_ne!(store.stats().damaged, 0);
    assert!(!directory.file(key(1)).exists());
    assert_eq!(store.get(&key(2)).await.unwrap().bytes, bytes(2, 1000), "the other is intact");
    (directory, store)
}

/// Flips one bit.
fn flip(file: &Path, at: usize) {
    let mut object = fs::read(file).unwrap();
    object[at] ^= 1;
    fs::write(file, object).unwrap();
}

#[tokio::test]
async fn a_flipped_bit_is_detected_everywhere() {
    // Magic, version, length, key, hash, the header's own hash, table, first and last byte.
    for at in [0, 8, 12, 20, 52, 84, 116, 148, 1147] {
        open_after(|file, _| flip(file, at)).await;
    }
}

#[tokio::test]
async fn a_truncated_or_extended_file_is_detected() {
    for length in [0, 1, 115, 116, 148, 500, 1147, 1149] {
        open_after(|file, _| {
            fs::File::options().write(true).open(file).unwrap().set_len(length).unwrap();
        })
        .await;
    }
}

#[tokio::test]
async fn the_object_of_another_key_is_not_served() {
    open_after(|file, other| assert_eq!(fs::copy(other, file).unwrap(), 1148)).await;
}

#[tokio::test]
async fn a_foreign_file_of_the_same_length_is_not_served() {
    open_after(|file, _| fs::write(file, [b'x'; 1148]).unwrap()).await;
}

#[tokio::test]
async fn a_damaged_content_is_computed_again_and_stored() {
    let (directory, store) = open_after(|file, _| flip(file, 148)).await;
    let again = store.get_or_make(&key(1), async { Ok::<_, String>(bytes(1, 1000)) }).await;
    assert_eq!(again.unwrap().bytes, bytes(1, 1000));
    drop(store);
    let store = directory.open().await;
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
    assert_eq!(store.stats().damaged, 0);
}

#[tokio::test]
async fn damage_is_detected_while_the_store_is_open() {
    let directory = TestDirectory::new();
    let store = directory.open_without_memory().await;
    store.put(&key(1), bytes(1, 1000)).await;
    flip(&directory.file(key(1)), 500);
    assert_eq!(store.get(&key(1)).await, None);
    assert_eq!((store.stats().damaged, store.stats().disk_bytes), (1, Some(0)));
}

#[tokio::test]
async fn a_file_larger_than_memory_is_not_read() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(10_000).await;
    let file = directory.file(key(1));
    fs::create_dir_all(file.parent().unwrap()).unwrap();
    // A hole, larger than any memory.
    fs::File::create(&file).unwrap().set_len(1 << 43).unwrap();
    assert_eq!(store.get(&key(1)).await, None);
    assert_eq!(store.stats().damaged, 1);
}

#[tokio::test]
async fn foreign_files_are_neither_counted_nor_removed() {
    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 1000)).await;
    let objects = directory.path().join("objects");
    let foreign = [
        directory.file(key(2)),
        objects.join("notes.txt"),
        objects.join("AB").join("f".repeat(62)),
        objects.join("ab/cd"),
    ];
    for file in &foreign {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, "not ours").unwrap();
    }
    let store = directory.open_with_limit(2000).await;
    assert_eq!(store.stats().disk_bytes, Some(1148));
    store.put(&key(4), bytes(4, 1000)).await;
    assert!(foreign.iter().all(|file| file.exists()), "eviction removes only objects");
    assert!(!directory.file(key(1)).exists());
}

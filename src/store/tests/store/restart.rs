//! The directory of a store after a restart.

use std::fs;
use std::path::Path;

use verne_store::{Durability, OpenError, Store};

use crate::directory::{EMPTY, HEADER, TestDirectory, bytes, key};

#[tokio::test]
async fn contents_survive_a_restart() {
    let directory = TestDirectory::new();
    let store = directory.open().await;
    let (put, durability) = store.put(&key(1), bytes(1, 100_000)).await;
    assert_eq!(durability, Durability::Durable);
    store.get_or_make(&key(2), async { Ok::<_, String>(bytes(2, 0)) }).await.unwrap();
    assert_eq!(store.stats().disk_bytes, Some(100_000 + HEADER + EMPTY));
    drop(store);

    let store = directory.open().await;
    assert_eq!(store.stats().disk_bytes, Some(100_000 + HEADER + EMPTY));
    assert_eq!(store.get(&key(1)).await, Some(put));
    let durability = store.get_or_make(&key(2), async { Err("it is there") }).await;
    assert_eq!(durability.unwrap().bytes, bytes(2, 0));
    let stats = store.stats();
    assert_eq!((stats.disk_hits, stats.misses, stats.damaged), (2, 0, 0));
}

#[tokio::test]
async fn a_replaced_object_is_counted_once() {
    let directory = TestDirectory::new();
    let store = directory.open().await;
    store.put(&key(1), bytes(1, 1000)).await;
    store.put(&key(1), bytes(2, 500)).await;
    assert_eq!(store.stats().disk_bytes, Some(500 + HEADER));
    drop(store);
    assert_eq!(directory.open().await.get(&key(1)).await.unwrap().bytes, bytes(2, 500));
}

#[tokio::test]
async fn a_second_store_cannot_open_the_directory_until_the_first_is_closed() {
    let directory = TestDirectory::new();
    let first = directory.open().await;
    let second = Store::open(&directory.config(1 << 30)).await;
    let Err(error @ OpenError::InUse { .. }) = second else { panic!("opened twice") };
    assert!(error.to_string().contains("in use"), "{error}");
    first.put(&key(1), bytes(1, 10)).await;
    drop(first);
    assert!(directory.open().await.get(&key(1)).await.is_some());
}

#[tokio::test]
async fn opening_a_file_as_directory_fails_with_its_path() {
    let directory = TestDirectory::new();
    fs::write(directory.path(), "a file").unwrap();
    let Err(error @ OpenError::Directory { .. }) = Store::open(&directory.config(1 << 30)).await else {
        panic!("opened a file")
    };
    assert!(error.to_string().contains(directory.path().to_str().unwrap()), "{error}");
}

#[cfg(unix)]
#[tokio::test]
async fn opening_a_read_only_directory_fails() {
    use std::os::unix::fs::PermissionsExt;

    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 10)).await;
    let may = |mode| fs::set_permissions(directory.path(), fs::Permissions::from_mode(mode)).unwrap();
    may(0o555);
    let privileged = fs::write(directory.path().join("root"), "").is_ok();
    let opened = Store::open(&directory.config(1 << 30)).await;
    may(0o755);
    // Nothing is read-only for root.
    assert_eq!(opened.is_ok(), privileged);
    drop(opened);
    let store = directory.open().await;
    assert!(store.get(&key(1)).await.is_some(), "its contents are not lost");
}

#[tokio::test]
async fn opening_removes_unfinished_files_and_no_others() {
    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 10)).await;
    let unfinished = directory.file(key(1)).with_extension("#1");
    let beside = |ending: &str| {
        let mut name = directory.file(key(1)).into_os_string();
        name.push(ending);
        name
    };
    let others = [unfinished.into_os_string(), beside("#a"), directory.path().join("objects/notes#1").into()];
    let remains = [beside("#1"), beside("#12"), directory.path().join("objects/probe#1").into()];
    for file in others.iter().chain(&remains) {
        fs::write(file, "half").unwrap();
    }
    let store = directory.open().await;
    assert!(remains.iter().all(|file| !Path::new(file).exists()));
    assert!(others.iter().all(|file| Path::new(file).exists()));
    assert!(store.get(&key(1)).await.is_some());
}

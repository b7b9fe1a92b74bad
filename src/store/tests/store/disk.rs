//! The layer on disk: what a restart finds.

use std::fs;
use std::path::Path;

use verne_store::{Kept, OpenError, Store};

use crate::place::{EMPTY, HEADER, Place, bytes, key};

#[tokio::test]
async fn a_restart_finds_what_was_put_and_what_was_made() {
    let place = Place::new();
    let store = place.open().await;
    let (put, kept) = store.put(&key(1), bytes(1, 100_000)).await;
    assert_eq!(kept, Kept::Durable);
    store.get_or_make(&key(2), async { Ok::<_, String>(bytes(2, 0)) }).await.unwrap();
    assert_eq!(store.stats().disk_bytes, Some(100_000 + HEADER + EMPTY));
    drop(store);

    let store = place.open().await;
    assert_eq!(store.stats().disk_bytes, Some(100_000 + HEADER + EMPTY));
    assert_eq!(store.get(&key(1)).await, Some(put));
    let kept = store.get_or_make(&key(2), async { Err("it is there") }).await;
    assert_eq!(kept.unwrap().bytes, bytes(2, 0));
    let stats = store.stats();
    assert_eq!((stats.disk_hits, stats.misses, stats.damaged), (2, 0, 0));
}

#[tokio::test]
async fn an_object_written_again_counts_once() {
    let place = Place::new();
    let store = place.open().await;
    store.put(&key(1), bytes(1, 1000)).await;
    store.put(&key(1), bytes(2, 500)).await;
    assert_eq!(store.stats().disk_bytes, Some(500 + HEADER));
    drop(store);
    assert_eq!(place.open().await.get(&key(1)).await.unwrap().bytes, bytes(2, 500));
}

#[tokio::test]
async fn a_second_store_on_one_directory_is_refused_until_the_first_is_closed() {
    let place = Place::new();
    let first = place.open().await;
    let second = Store::open(&place.config(1 << 30)).await;
    let Err(fault @ OpenError::InUse { .. }) = second else { panic!("opened twice") };
    assert!(fault.to_string().contains("in use"), "{fault}");
    first.put(&key(1), bytes(1, 10)).await;
    drop(first);
    assert!(place.open().await.get(&key(1)).await.is_some());
}

#[tokio::test]
async fn what_is_no_directory_is_an_error_that_names_it() {
    let place = Place::new();
    fs::write(place.path(), "a file").unwrap();
    let Err(fault @ OpenError::Directory { .. }) = Store::open(&place.config(1 << 30)).await else {
        panic!("opened a file")
    };
    assert!(fault.to_string().contains(place.path().to_str().unwrap()), "{fault}");
}

#[cfg(unix)]
#[tokio::test]
async fn a_read_only_directory_is_an_error() {
    use std::os::unix::fs::PermissionsExt;

    let place = Place::new();
    place.open().await.put(&key(1), bytes(1, 10)).await;
    let may = |mode| fs::set_permissions(place.path(), fs::Permissions::from_mode(mode)).unwrap();
    may(0o555);
    let privileged = fs::write(place.path().join("root"), "").is_ok();
    let opened = Store::open(&place.config(1 << 30)).await;
    may(0o755);
    // Nothing is read-only for root.
    assert_eq!(opened.is_ok(), privileged);
    drop(opened);
    let store = place.open().await;
    assert!(store.get(&key(1)).await.is_some(), "what lay there is not lost");
}

#[tokio::test]
async fn what_a_crash_left_half_written_is_removed_and_nothing_else() {
    let place = Place::new();
    place.open().await.put(&key(1), bytes(1, 10)).await;
    let unfinished = place.file(key(1)).with_extension("#1");
    let beside = |ending: &str| {
        let mut name = place.file(key(1)).into_os_string();
        name.push(ending);
        name
    };
    let others = [unfinished.into_os_string(), beside("#a"), place.path().join("objects/notes#1").into()];
    let remains = [beside("#1"), beside("#12"), place.path().join("objects/probe#1").into()];
    for file in others.iter().chain(&remains) {
        fs::write(file, "half").unwrap();
    }
    let store = place.open().await;
    assert!(remains.iter().all(|file| !Path::new(file).exists()));
    assert!(others.iter().all(|file| Path::new(file).exists()));
    assert!(store.get(&key(1)).await.is_some());
}

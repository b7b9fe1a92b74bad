//! A store that several processes share.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use tokio::task::JoinSet;
use verne_store::{Durability, OpenError, Store};

use crate::directory::{bytes, key};
use crate::recording_objects::RecordingObjects;

fn address(directory: &Path) -> String {
    format!("file://{}", directory.display())
}

/// Prepares the directory and opens it.
async fn open(directory: &Path) -> Store {
    Store::init_shared(&address(directory)).unwrap();
    Store::open_shared(&address(directory), 1 << 20).await.unwrap()
}

/// Every file in a directory and in those below it, but the marker.
fn files(directory: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    let files = entries.flat_map(|entry| if entry.is_dir() { files(&entry) } else { vec![entry] });
    files.filter(|file| !file.ends_with("verne-store")).collect()
}

#[tokio::test]
async fn two_stores_read_each_others_contents() {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path().join("made/when it is opened");
    let (first, second) = (open(&directory).await, open(&directory).await);
    assert_eq!(second.get(&key(1)).await, None);
    let (put, durability) = first.put(&key(1), bytes(1, 1000)).await;
    assert_eq!(durability, Durability::Durable);
    assert_eq!(second.get(&key(1)).await, Some(put));
    let made = second.get_or_make(&key(2), async { Ok::<_, String>(bytes(2, 3 << 20)) }).await.unwrap();
    assert_eq!(first.get(&key(2)).await, Some(made));
    assert_eq!((second.stats().disk_hits, second.stats().misses, second.stats().disk_bytes), (1, 2, None));
    drop((first, second));
    assert_eq!(open(&directory).await.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
    assert_eq!(files(&directory).len(), 2, "neither probes nor an index");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn many_stores_write_one_key_at_the_same_time() {
    let root = tempfile::tempdir().unwrap();
    let mut writers = JoinSet::new();
    for _ in 0..8 {
        let store = open(root.path()).await;
        writers.spawn(async move {
            for _ in 0..5 {
                assert_eq!(store.put(&key(1), bytes(1, 200_000)).await.1, Durability::Durable);
                let read = Store::get(&store, &key(1)).await.unwrap();
                assert_eq!(read.bytes, bytes(1, 200_000));
            }
            store.stats().damaged
        });
    }
    assert_eq!(writers.join_all().await.iter().sum::<u64>(), 0);
    assert_eq!(files(root.path()).len(), 1);
}

#[tokio::test]
async fn an_invalid_address_is_an_error_that_contains_it() {
    for address in [
        "results",
        "/shared/directory",
        "https://host/bucket",
        "s3://",
        "s3:///prefix",
        "s3://bucket:9000/prefix",
        "s3://key@bucket/prefix",
        "s3://bucket/prefix?region=here",
        "file://host/directory",
    ] {
        let Err(error @ OpenError::Address { .. }) = Store::open_shared(address, 0).await else {
            panic!("opened {address}")
        };
        assert!(error.to_string().contains(address), "{error}");
    }
}

#[tokio::test]
async fn an_unusable_directory_is_an_error_that_contains_its_path() {
    let root = tempfile::tempdir().unwrap();
    let file = root.path().join("a file");
    fs::write(&file, "").unwrap();
    for error in [
        Store::init_shared(&address(&file)).unwrap_err(),
        Store::open_shared(&address(&file), 0).await.map(drop).unwrap_err(),
    ] {
        assert!(error.to_string().contains("a file"), "{error}");
    }
    assert!(matches!(Store::init_shared("s3://bucket/prefix"), Err(OpenError::Address { .. })));
}

#[tokio::test]
async fn a_directory_without_a_marker_is_not_used() {
    let root = tempfile::tempdir().unwrap();
    let missing = root.path().join("missing");
    let mount_point = root.path().join("empty");
    fs::create_dir(&mount_point).unwrap();
    for directory in [&missing, &mount_point] {
        let Err(error @ OpenError::NoMarker { .. }) = Store::open_shared(&address(directory), 0).await else {
            panic!("opened {}", directory.display())
        };
        assert!(error.to_string().contains("verne store init"), "{error}");
    }
    assert!(!missing.exists() && fs::read_dir(&mount_point).unwrap().next().is_none());
    assert!(Store::init_shared(&address(&missing)).unwrap());
    assert!(!Store::init_shared(&address(&missing)).unwrap(), "a second time");
    assert_eq!(open(&missing).await.put(&key(1), bytes(1, 1000)).await.1, Durability::Durable);
}

/// The mount point is an empty directory while the file system is not mounted.
#[tokio::test(start_paused = true)]
async fn operations_fail_while_the_directory_is_not_mounted() {
    let root = tempfile::tempdir().unwrap();
    let (mounted, away) = (root.path().join("mounted"), root.path().join("away"));
    let store = open(&mounted).await;
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Durability::Durable);
    assert_eq!(store.healthy().await, Ok(()));

    fs::rename(&mounted, &away).unwrap();
    fs::create_dir(&mounted).unwrap();
    tokio::time::advance(Duration::from_secs(6)).await;
    assert!(store.healthy().await.is_err());
    assert_eq!(store.put(&key(2), bytes(2, 1000)).await.1, Durability::MemoryOnly);
    assert_eq!(store.get(&key(3)).await, None);
    assert_eq!((store.stats().write_failures, store.stats().read_failures), (1, 1));
    assert!(fs::read_dir(&mounted).unwrap().next().is_none(), "nothing is written to the mount point");

    fs::remove_dir(&mounted).unwrap();
    fs::rename(&away, &mounted).unwrap();
    tokio::time::advance(Duration::from_secs(6)).await;
    assert_eq!(store.put(&key(2), bytes(2, 1000)).await.1, Durability::Durable);
    assert_eq!(open(&mounted).await.get(&key(2)).await.unwrap().bytes, bytes(2, 1000));
    assert_eq!(store.healthy().await, Ok(()));
}

#[tokio::test(start_paused = true)]
async fn opening_a_shared_store_that_accepts_no_object_fails() {
    let objects = RecordingObjects::new();
    objects.record().all_fail.store(true, Ordering::Relaxed);
    let Err(error @ OpenError::Shared { .. }) = Store::open_shared_over(objects, 0).await else {
        panic!("opened")
    };
    assert!(error.to_string().contains("slow down"), "{error}");
}

#[tokio::test(start_paused = true)]
async fn nothing_is_lost_if_one_request_in_ten_is_refused() {
    let objects = RecordingObjects::new();
    objects.record().one_in.store(10, Ordering::Relaxed);
    let (writer, reader) = (objects.open().await, objects.open().await);
    for number in 0..100 {
        assert_eq!(writer.put(&key(number), bytes(number, 1000)).await.1, Durability::Durable);
    }
    let (_, durability) = writer.put(&key(100), bytes(100, 20 << 20)).await;
    assert_eq!(durability, Durability::Durable);
    for number in 0..100 {
        assert_eq!(reader.get(&key(number)).await.unwrap().bytes, bytes(number, 1000));
    }
    assert_eq!(reader.get(&key(100)).await.unwrap().bytes, bytes(100, 20 << 20));
    assert!(objects.record().refused.load(Ordering::Relaxed) > 20);
    let stats = (writer.stats().write_failures, reader.stats().read_failures);
    assert_eq!(stats, (0, 0));
}

#[tokio::test(start_paused = true)]
async fn a_content_that_the_shared_store_refuses_is_not_cached() {
    let objects = RecordingObjects::new();
    let store = Store::open_shared_over(Arc::clone(&objects) as _, 1 << 20).await.unwrap();
    objects.record().all_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Durability::MemoryOnly);
    assert_eq!((store.get(&key(1)).await, store.get(&key(2)).await), (None, None));
    assert_eq!((store.stats().write_failures, store.stats().read_failures), (1, 2));
    objects.record().all_fail.store(false, Ordering::Relaxed);
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Durability::Durable);
    let other = Store::open_shared_over(objects, 1 << 20).await.unwrap();
    assert_eq!(other.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
}

#[tokio::test(start_paused = true)]
async fn each_process_probes_a_shared_store_under_its_own_name() {
    let objects = RecordingObjects::new();
    let (first, second) = (objects.open().await, objects.open().await);
    let probes = std::mem::take(&mut *objects.record().put.lock().unwrap());
    assert_ne!(probes[0], probes[1]);
    assert_eq!(objects.locations().await, []);
    assert_eq!((first.healthy().await, second.healthy().await), (Ok(()), Ok(())));
    assert_eq!(*objects.record().put.lock().unwrap(), probes, "the name of a process does not change");

    objects.record().all_fail.store(true, Ordering::Relaxed);
    assert_eq!(first.healthy().await, Ok(()), "the last outcome is reused");
    tokio::time::advance(Duration::from_secs(6)).await;
    let error = first.healthy().await.unwrap_err();
    assert_eq!(error, "no answer within 500 ms", "the probe is still being repeated");
    tokio::time::advance(Duration::from_secs(5)).await;
    let error = first.healthy().await.unwrap_err();
    assert!(error.contains("slow down"), "{error}");
    objects.record().all_fail.store(false, Ordering::Relaxed);
    tokio::time::advance(Duration::from_secs(6)).await;
    assert_eq!(first.healthy().await, Ok(()));
}

//! A store that several processes have open at once: what one writes the others find.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use tokio::task::JoinSet;
use verne_store::{Kept, OpenError, Store};

use crate::place::{bytes, key};
use crate::watched::Watched;

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
async fn two_stores_over_one_directory_see_each_others_results() {
    let root = tempfile::tempdir().unwrap();
    let directory = root.path().join("made/when it is opened");
    let (first, second) = (open(&directory).await, open(&directory).await);
    assert_eq!(second.get(&key(1)).await, None);
    let (put, kept) = first.put(&key(1), bytes(1, 1000)).await;
    assert_eq!(kept, Kept::Durable);
    assert_eq!(second.get(&key(1)).await, Some(put));
    let made = second.get_or_make(&key(2), async { Ok::<_, String>(bytes(2, 3 << 20)) }).await.unwrap();
    assert_eq!(first.get(&key(2)).await, Some(made));
    assert_eq!((second.stats().disk_hits, second.stats().misses, second.stats().disk_bytes), (1, 2, None));
    drop((first, second));
    assert_eq!(open(&directory).await.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
    assert_eq!(files(&directory).len(), 2, "neither probes nor an index");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn many_may_write_one_key_at_once() {
    let root = tempfile::tempdir().unwrap();
    let mut writers = JoinSet::new();
    for _ in 0..8 {
        let store = open(root.path()).await;
        writers.spawn(async move {
            for _ in 0..5 {
                assert_eq!(store.put(&key(1), bytes(1, 200_000)).await.1, Kept::Durable);
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
async fn an_address_that_means_nothing_is_an_error_that_says_so() {
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
        let Err(fault @ OpenError::Address { .. }) = Store::open_shared(address, 0).await else {
            panic!("opened {address}")
        };
        assert!(fault.to_string().contains(address), "{fault}");
    }
}

#[tokio::test]
async fn a_directory_that_cannot_be_made_or_written_to_is_an_error_that_names_it() {
    let root = tempfile::tempdir().unwrap();
    let file = root.path().join("a file");
    fs::write(&file, "").unwrap();
    for fault in [
        Store::init_shared(&address(&file)).unwrap_err(),
        Store::open_shared(&address(&file), 0).await.map(drop).unwrap_err(),
    ] {
        assert!(fault.to_string().contains("a file"), "{fault}");
    }
    assert!(matches!(Store::init_shared("s3://bucket/prefix"), Err(OpenError::Address { .. })));
}

#[tokio::test]
async fn a_directory_that_was_not_prepared_is_left_alone() {
    let root = tempfile::tempdir().unwrap();
    let missing = root.path().join("missing");
    let mount_point = root.path().join("empty");
    fs::create_dir(&mount_point).unwrap();
    for directory in [&missing, &mount_point] {
        let Err(fault @ OpenError::NoMarker { .. }) = Store::open_shared(&address(directory), 0).await else {
            panic!("opened {}", directory.display())
        };
        assert!(fault.to_string().contains("verne store init"), "{fault}");
    }
    assert!(!missing.exists() && fs::read_dir(&mount_point).unwrap().next().is_none());
    assert!(Store::init_shared(&address(&missing)).unwrap());
    assert!(!Store::init_shared(&address(&missing)).unwrap(), "a second time");
    assert_eq!(open(&missing).await.put(&key(1), bytes(1, 1000)).await.1, Kept::Durable);
}

/// What is seen at the mount point while the file system is not mounted.
#[tokio::test(start_paused = true)]
async fn a_mount_that_disappears_is_waited_for_and_nothing_is_written_below_it() {
    let root = tempfile::tempdir().unwrap();
    let (mounted, away) = (root.path().join("mounted"), root.path().join("away"));
    let store = open(&mounted).await;
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Kept::Durable);
    assert_eq!(store.healthy().await, Ok(()));

    fs::rename(&mounted, &away).unwrap();
    fs::create_dir(&mounted).unwrap();
    tokio::time::advance(Duration::from_secs(6)).await;
    assert!(store.healthy().await.is_err());
    assert_eq!(store.put(&key(2), bytes(2, 1000)).await.1, Kept::MemoryOnly);
    assert_eq!(store.get(&key(3)).await, None);
    assert_eq!((store.stats().write_failures, store.stats().read_failures), (1, 1));
    assert!(fs::read_dir(&mounted).unwrap().next().is_none(), "nothing is written to the mount point");

    fs::remove_dir(&mounted).unwrap();
    fs::rename(&away, &mounted).unwrap();
    tokio::time::advance(Duration::from_secs(6)).await;
    assert_eq!(store.put(&key(2), bytes(2, 1000)).await.1, Kept::Durable);
    assert_eq!(open(&mounted).await.get(&key(2)).await.unwrap().bytes, bytes(2, 1000));
    assert_eq!(store.healthy().await, Ok(()));
}

#[tokio::test(start_paused = true)]
async fn a_store_that_takes_nothing_is_an_error_at_the_start() {
    let objects = Watched::new();
    objects.record().all_fail.store(true, Ordering::Relaxed);
    let Err(fault @ OpenError::Shared { .. }) = Store::open_shared_over(objects, 0).await else {
        panic!("opened")
    };
    assert!(fault.to_string().contains("slow down"), "{fault}");
}

#[tokio::test(start_paused = true)]
async fn a_store_that_refuses_a_tenth_of_what_it_is_asked_loses_nothing() {
    let objects = Watched::new();
    objects.record().one_in.store(10, Ordering::Relaxed);
    let (writer, reader) = (objects.open().await, objects.open().await);
    for number in 0..100 {
        assert_eq!(writer.put(&key(number), bytes(number, 1000)).await.1, Kept::Durable);
    }
    let (_, kept) = writer.put(&key(100), bytes(100, 20 << 20)).await;
    assert_eq!(kept, Kept::Durable);
    for number in 0..100 {
        assert_eq!(reader.get(&key(number)).await.unwrap().bytes, bytes(number, 1000));
    }
    assert_eq!(reader.get(&key(100)).await.unwrap().bytes, bytes(100, 20 << 20));
    assert!(objects.record().refused.load(Ordering::Relaxed) > 20);
    let stats = (writer.stats().write_failures, reader.stats().read_failures);
    assert_eq!(stats, (0, 0));
}

#[tokio::test(start_paused = true)]
async fn what_a_store_refuses_is_not_believed_to_be_there() {
    let objects = Watched::new();
    let store = Store::open_shared_over(Arc::clone(&objects) as _, 1 << 20).await.unwrap();
    objects.record().all_fail.store(true, Ordering::Relaxed);
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Kept::MemoryOnly);
    assert_eq!((store.get(&key(1)).await, store.get(&key(2)).await), (None, None));
    assert_eq!((store.stats().write_failures, store.stats().read_failures), (1, 2));
    objects.record().all_fail.store(false, Ordering::Relaxed);
    assert_eq!(store.put(&key(1), bytes(1, 1000)).await.1, Kept::Durable);
    let other = Store::open_shared_over(objects, 1 << 20).await.unwrap();
    assert_eq!(other.get(&key(1)).await.unwrap().bytes, bytes(1, 1000));
}

#[tokio::test(start_paused = true)]
async fn each_process_probes_under_a_name_of_its_own_every_few_seconds() {
    let objects = Watched::new();
    let (first, second) = (objects.open().await, objects.open().await);
    let probes = std::mem::take(&mut *objects.record().put.lock().unwrap());
    assert_ne!(probes[0], probes[1]);
    assert_eq!(objects.places().await, []);
    assert_eq!((first.healthy().await, second.healthy().await), (Ok(()), Ok(())));
    assert_eq!(*objects.record().put.lock().unwrap(), probes, "the names stay");

    objects.record().all_fail.store(true, Ordering::Relaxed);
    assert_eq!(first.healthy().await, Ok(()), "believed for a while");
    tokio::time::advance(Duration::from_secs(6)).await;
    let fault = first.healthy().await.unwrap_err();
    assert_eq!(fault, "no answer within 500 ms", "it is asked again and again meanwhile");
    tokio::time::advance(Duration::from_secs(5)).await;
    let fault = first.healthy().await.unwrap_err();
    assert!(fault.contains("slow down"), "{fault}");
    objects.record().all_fail.store(false, Ordering::Relaxed);
    tokio::time::advance(Duration::from_secs(6)).await;
    assert_eq!(first.healthy().await, Ok(()));
}

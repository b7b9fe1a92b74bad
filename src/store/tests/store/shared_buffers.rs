//! All readers of a content share one buffer.

use std::sync::atomic::Ordering;

use futures_util::poll;
use tokio::task::JoinSet;
use verne_store::{Content, Store};

use crate::directory::{TestDirectory, bytes, key};

fn same_buffer(a: &Content, b: &Content) -> bool {
    a.bytes.as_ptr() == b.bytes.as_ptr()
}

#[tokio::test]
async fn all_readers_share_the_buffer_that_was_stored() {
    let store = Store::in_memory(64 << 20);
    let given = bytes(1, 20 << 20);
    let (put, _) = store.put(&key(1), given.clone()).await;
    let got = store.get(&key(1)).await.unwrap();
    assert_eq!(put.bytes.as_ptr(), given.as_ptr());
    assert!(same_buffer(&put, &got));
}

#[tokio::test]
async fn readers_share_an_uncached_content_while_one_of_them_holds_it() {
    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 1 << 20)).await;
    let store = directory.open_without_memory().await;
    let first = store.get(&key(1)).await.unwrap();
    let second = store.get(&key(1)).await.unwrap();
    drop(first);
    let third = store.get(&key(1)).await.unwrap();
    assert!(same_buffer(&second, &third));
    assert_eq!(store.stats().disk_hits, 1);
    drop((second, third));
    assert_eq!(store.get(&key(1)).await.unwrap().bytes.len(), 1 << 20);
    assert_eq!(store.stats().disk_hits, 2, "the buffer ends with its readers");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn concurrent_first_readers_read_the_disk_once() {
    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 1 << 20)).await;
    let objects = directory.objects();
    let store = directory.open_over(&objects, 1 << 30).await;
    objects.close_gate();
    let mut readers = JoinSet::new();
    for number in 0..100 {
        let store = store.clone();
        readers.spawn(async move {
            if number % 2 == 0 {
                return store.get(&key(1)).await.unwrap();
            }
            store.get_or_make(&key(1), async { Err("it is there") }).await.unwrap()
        });
    }
    objects.arrival().await;
    objects.open_gate();
    let contents = readers.join_all().await;
    assert!(contents.iter().all(|content| same_buffer(content, &contents[0])));
    assert_eq!(objects.gets.load(Ordering::Relaxed), 1);
    assert_eq!(store.stats().disk_hits, 1);
}

#[tokio::test]
async fn a_waiting_reader_finds_a_buffer_that_came_alive_meanwhile() {
    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), bytes(1, 1000)).await;
    let objects = directory.objects();
    let (store, key) = (directory.open_over(&objects, 1 << 30).await, key(1));
    objects.close_gate();
    let mut first = Box::pin(store.get(&key));
    tokio::select! {
        _ = &mut first => panic!("the gate is closed"),
        () = objects.arrival() => {}
    }
    let mut second = Box::pin(store.get(&key));
    assert!(poll!(&mut second).is_pending(), "it waits for the first");
    let mut writer = Box::pin(store.put(&key, bytes(1, 1000)));
    tokio::select! {
        _ = &mut writer => panic!("the gate is closed"),
        () = objects.arrival() => {}
    }
    drop(first);
    objects.open_gate();
    let found = second.await.unwrap();
    assert_eq!(objects.gets.load(Ordering::Relaxed), 1, "that of the first reader");
    assert!(same_buffer(&found, &writer.await.0));
    assert_eq!(store.stats().memory_hits, 1);
}

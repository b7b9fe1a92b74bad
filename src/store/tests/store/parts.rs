//! Large objects are sent in parts, and seen whole or not at all.

use std::sync::atomic::Ordering;

use verne_store::Kept;

use crate::place::{HEADER, bytes, key};
use crate::watched::Watched;

const PART: usize = 8 << 20;

#[tokio::test]
async fn a_large_object_is_sent_in_parts_and_read_as_one() {
    let objects = Watched::new();
    let length = 2 * PART + 5;
    let (writer, reader) = (objects.open().await, objects.open().await);
    let (put, kept) = writer.put(&key(1), bytes(1, length)).await;
    assert_eq!(kept, Kept::Durable);
    let header = 116 + 32 * length.div_ceil(1 << 20);
    assert_eq!(*objects.record().parts.lock().unwrap(), [PART, PART, header + 5]);
    assert_eq!(reader.get(&key(1)).await, Some(put));
}

#[tokio::test]
async fn what_fits_in_a_part_is_sent_at_once() {
    let objects = Watched::new();
    let store = objects.open().await;
    store.put(&key(1), bytes(1, PART - 116 - 8 * 32)).await;
    store.put(&key(2), bytes(2, 1000)).await;
    assert_eq!(objects.record().parts.lock().unwrap().len(), 0);
    assert_eq!(objects.object(key(2)).await.len() as u64, 1000 + HEADER);
}

#[tokio::test(start_paused = true)]
async fn an_upload_that_fails_is_aborted_and_leaves_nothing_to_be_seen() {
    let objects = Watched::new();
    let (writer, reader) = (objects.open().await, objects.open().await);
    objects.record().last_part_fails.store(true, Ordering::Relaxed);
    let (content, kept) = writer.put(&key(1), bytes(1, 2 * PART)).await;
    assert_eq!(kept, Kept::MemoryOnly);
    assert_eq!(content.bytes, bytes(1, 2 * PART));
    let tried = objects.record().parts.lock().unwrap().iter().filter(|part| **part < PART).count();
    assert!(tried > 1, "tried again");
    assert_eq!(objects.record().aborted.load(Ordering::Relaxed), tried);
    assert_eq!(objects.places().await, []);
    assert!(reader.find(&key(1)).await.is_none());

    objects.record().last_part_fails.store(false, Ordering::Relaxed);
    assert_eq!(writer.put(&key(1), bytes(1, 2 * PART)).await.1, Kept::Durable);
    assert_eq!(reader.get(&key(1)).await, Some(content));
}

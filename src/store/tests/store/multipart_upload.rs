//! Large objects are uploaded in parts; readers see them complete or not at all.

use std::sync::atomic::Ordering;

use verne_store::Durability;

use crate::directory::{HEADER, bytes, key};
use crate::recording_objects::RecordingObjects;

const PART: usize = 8 << 20;

#[tokio::test]
async fn a_large_object_is_uploaded_in_parts_and_read_as_one() {
    let objects = RecordingObjects::new();
    let length = 2 * PART + 5;
    let (writer, reader) = (objects.open().await, objects.open().await);
    let (put, durability) = writer.put(&key(1), bytes(1, length)).await;
    assert_eq!(durability, Durability::Durable);
    let header = 116 + 32 * length.div_ceil(1 << 20);
    assert_eq!(*objects.record().parts.lock().unwrap(), [PART, PART, header + 5]);
    assert_eq!(reader.get(&key(1)).await, Some(put));
}

#[tokio::test]
async fn an_object_that_fits_in_one_part_is_sent_in_one_request() {
    let objects = RecordingObjects::new();
    let store = objects.open().await;
    store.put(&key(1), bytes(1, PART - 116 - 8 * 32)).await;
    store.put(&key(2), bytes(2, 1000)).await;
    assert_eq!(objects.record().parts.lock().unwrap().len(), 0);
    assert_eq!(objects.object(key(2)).await.len() as u64, 1000 + HEADER);
}

#[tokio::test(start_paused = true)]
async fn a_failed_upload_is_aborted_and_leaves_no_object() {
    let objects = RecordingObjects::new();
    let (writer, reader) = (objects.open().await, objects.open().await);
    objects.record().last_part_fails.store(true, Ordering::Relaxed);
    let (content, durability) = writer.put(&key(1), bytes(1, 2 * PART)).await;
    assert_eq!(durability, Durability::MemoryOnly);
    assert_eq!(content.bytes, bytes(1, 2 * PART));
    let tried = objects.record().parts.lock().unwrap().iter().filter(|part| **part < PART).count();
    assert!(tried > 1, "tried again");
    assert_eq!(objects.record().aborted.load(Ordering::Relaxed), tried);
    assert_eq!(objects.locations().await, []);
    assert!(reader.reader(&key(1)).await.is_none());

    objects.record().last_part_fails.store(false, Ordering::Relaxed);
    assert_eq!(writer.put(&key(1), bytes(1, 2 * PART)).await.1, Durability::Durable);
    assert_eq!(reader.get(&key(1)).await, Some(content));
}

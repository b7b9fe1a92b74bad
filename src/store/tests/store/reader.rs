//! Readers fetch only what is wanted, and return only bytes that were written.

use std::fs;
use std::ops::Range;
use std::sync::Arc;

use bytes::Bytes;
use futures_util::{StreamExt, TryStreamExt};
use tokio::task::JoinSet;
use verne_store::{ContentReader, FormatError, Key, ReadError, Store};

use crate::directory::{TestDirectory, bytes, key};
use crate::recording_objects::RecordingObjects;

const CHUNK: u64 = 1 << 20;
/// Three chunks and a half.
const LENGTH: u64 = 7 << 19;
const START: u64 = 116 + 4 * 32;
/// The bytes of an object that are fetched first.
const FIRST_BYTES: u64 = 64 << 10;

fn at(offset: u64) -> usize {
    usize::try_from(offset).unwrap()
}

fn content() -> Bytes {
    bytes(1, at(LENGTH))
}

/// Objects, one of which is large.
async fn large() -> Arc<RecordingObjects> {
    let objects = RecordingObjects::new();
    objects.open().await.put(&key(1), content()).await;
    objects
}

/// The bytes of a range before the first error, and that error.
async fn read(found: &ContentReader, range: Range<u64>) -> (Vec<u8>, Option<ReadError>) {
    let (mut all, mut stream) = (Vec::new(), Box::pin(found.stream(range)));
    while let Some(piece) = stream.next().await {
        match piece {
            Ok(piece) => all.extend_from_slice(&piece),
            Err(error) => {
                assert!(stream.next().await.is_none(), "nothing comes after an error");
                return (all, Some(error));
            }
        }
    }
    (all, None)
}

/// Ranges at and across the borders of chunks, and beyond the end.
fn ranges() -> [Range<u64>; 10] {
    [
        0..LENGTH,
        0..0,
        0..1,
        5..CHUNK,
        CHUNK - 1..CHUNK + 1,
        CHUNK..2 * CHUNK,
        CHUNK + 7..3 * CHUNK + 7,
        LENGTH - 1..LENGTH,
        LENGTH - 3..u64::MAX,
        LENGTH + 9..LENGTH + 12,
    ]
}

async fn reads_every_range(store: &Store, key: &Key) {
    let all = content();
    for range in ranges() {
        let found = store.reader(key).await.unwrap();
        assert_eq!((found.len(), found.hash()), (LENGTH, blake3::hash(&all)));
        let wanted = at(range.start.min(LENGTH))..at(range.end.min(LENGTH));
        let (read, error) = read(&found, range.clone()).await;
        assert!(error.is_none() && read == all[wanted], "{range:?}");
    }
}

#[tokio::test]
async fn memory_disk_and_shared_store_return_the_same_ranges() {
    let memory = Store::in_memory(64 << 20);
    memory.put(&key(1), content()).await;
    reads_every_range(&memory, &key(1)).await;

    let directory = TestDirectory::new();
    directory.open().await.put(&key(1), content()).await;
    let disk = directory.open_without_memory().await;
    reads_every_range(&disk, &key(1)).await;
    assert_eq!((disk.stats().memory_hits, disk.stats().disk_hits), (0, ranges().len() as u64));

    reads_every_range(&large().await.open().await, &key(1)).await;
}

#[tokio::test]
async fn a_reader_of_a_cached_content_returns_a_slice_of_its_buffer() {
    let store = Store::in_memory(64 << 20);
    let (put, _) = store.put(&key(1), content()).await;
    let found = store.reader(&key(1)).await.unwrap();
    let pieces: Vec<_> = found.stream(5..LENGTH).try_collect().await.unwrap();
    assert_eq!(pieces.len(), 1);
    assert_eq!(pieces[0].as_ptr(), put.bytes[5..].as_ptr());
}

#[tokio::test]
async fn a_range_fetches_only_the_chunks_that_it_overlaps() {
    let objects = large().await;
    let found = objects.open().await.reader(&key(1)).await.unwrap();
    assert_eq!(objects.record().take_fetched(), [(0, FIRST_BYTES)]);
    let (read, _) = read(&found, CHUNK + 5..2 * CHUNK + 1).await;
    assert_eq!(read.len() as u64, CHUNK - 4);
    let fetched = objects.record().take_fetched();
    assert_eq!(fetched, [(START + CHUNK, START + 2 * CHUNK), (START + 2 * CHUNK, START + 3 * CHUNK)]);
}

#[tokio::test]
async fn a_reader_fetches_at_most_one_chunk_ahead() {
    let objects = RecordingObjects::new();
    objects.open().await.put(&key(1), bytes(1, 20 << 20)).await;
    let found = objects.open().await.reader(&key(1)).await.unwrap();
    objects.record().take_fetched();
    let (mut fetched, mut read) = (0, 0);
    let mut stream = Box::pin(found.stream(0..found.len()));
    while let Some(piece) = stream.next().await {
        read += piece.unwrap().len() as u64;
        fetched += objects.record().take_fetched().iter().map(|(start, end)| end - start).sum::<u64>();
        assert!(fetched <= read + CHUNK, "{read} read, {fetched} fetched");
    }
    assert_eq!((read, fetched), (20 << 20, 20 << 20));
}

#[tokio::test]
async fn a_damaged_chunk_ends_the_stream_before_it() {
    for chunk in 0..4 {
        let objects = large().await;
        let store = objects.open().await;
        let mut object = objects.object(key(1)).await;
        object[at(START + chunk * CHUNK) + 77] ^= 1;
        objects.replace(key(1), object).await;

        let found = store.reader(&key(1)).await.unwrap();
        for other in (0..4).filter(|other| *other != chunk) {
            let (read, error) = read(&found, other * CHUNK..(other + 1) * CHUNK).await;
            assert!(error.is_none() && content()[at(other * CHUNK)..].starts_with(&read));
        }
        let (read, error) = read(&found, 0..LENGTH).await;
        assert!(matches!(error, Some(ReadError::Damaged(FormatError::Chunk))), "{error:?}");
        assert_eq!(read, content()[..at(chunk * CHUNK)]);
        assert_eq!(store.stats().damaged, 1);
        assert!(store.reader(&key(1)).await.is_none(), "it is removed");
        assert_eq!(objects.locations().await, []);
    }
}

#[tokio::test]
async fn an_object_with_a_damaged_header_counts_as_absent() {
    let objects = large().await;
    let store = objects.open().await;
    let sound = objects.object(key(1)).await;
    let hidden = async |key, object: Vec<u8>| {
        objects.replace(key, object).await;
        store.reader(&key).await.is_none()
    };
    for at in [0, 8, 12, 20, 52, 84, 116, 116 + 127] {
        let mut object = sound.clone();
        object[at] ^= 1;
        assert!(hidden(key(1), object).await, "byte {at}");
    }
    for length in [0, 1, 84, 116, at(START), at(LENGTH), sound.len() - 1] {
        assert!(hidden(key(1), sound[..length].to_vec()).await, "{length} bytes of it");
    }
    assert!(hidden(key(2), sound.clone()).await, "another key's object");
    assert_eq!((store.stats().damaged, objects.locations().await), (16, vec![]));
    assert!(!hidden(key(1), sound).await);
}

#[tokio::test]
async fn a_damaged_object_is_not_removed_after_it_was_rewritten() {
    let objects = large().await;
    let store = objects.open().await;
    let mut object = objects.object(key(1)).await;
    object[at(START)] ^= 1;
    objects.replace(key(1), object).await;
    let found = store.reader(&key(1)).await.unwrap();
    let mut stream = Box::pin(found.stream(0..1));
    // The reader has fetched the damaged chunk, and reports the damage after the object has been rewritten.
    let piece = futures_util::poll!(stream.next());
    assert!(piece.is_pending());
    let (_, durability) = store.put(&key(1), content()).await;
    assert_eq!(durability, verne_store::Durability::Durable);
    assert!(stream.next().await.unwrap().is_err());
    assert_eq!(objects.locations().await, [RecordingObjects::location(key(1))]);
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, content());
}

#[tokio::test]
async fn damage_on_disk_ends_the_stream_and_removes_the_object() {
    let directory = TestDirectory::new();
    let store = directory.open_without_memory().await;
    store.put(&key(1), content()).await;
    let mut object = fs::read(directory.file(key(1))).unwrap();
    object[at(START + CHUNK)] ^= 1;
    fs::write(directory.file(key(1)), object).unwrap();
    let found = store.reader(&key(1)).await.unwrap();
    let (read, error) = read(&found, 0..LENGTH).await;
    assert!(read == content()[..at(CHUNK)] && error.is_some());
    assert_eq!((store.stats().damaged, store.stats().disk_bytes), (1, Some(0)));
    assert!(!directory.file(key(1)).exists());
}

#[tokio::test]
async fn an_object_can_be_evicted_while_it_is_read() {
    let directory = TestDirectory::new();
    let store = directory.open_with_limit(5 << 20).await;
    store.put(&key(1), content()).await;
    drop(store);
    let store = directory.open_with_limit(5 << 20).await;
    let found = store.reader(&key(1)).await.unwrap();
    let mut stream = Box::pin(found.stream(0..LENGTH));
    let mut all = stream.next().await.unwrap().unwrap().to_vec();
    store.put(&key(2), bytes(2, 3 << 20)).await;
    assert!(!directory.file(key(1)).exists());
    while let Some(piece) = stream.next().await {
        all.extend_from_slice(&piece.unwrap());
    }
    assert_eq!(all, content());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn a_small_content_is_read_once_and_cached() {
    let objects = RecordingObjects::new();
    objects.open().await.put(&key(1), bytes(1, 10_000)).await;
    let store = Store::open_shared_over(Arc::clone(&objects) as _, 1 << 20).await.unwrap();
    let mut readers = JoinSet::new();
    for _ in 0..50 {
        let store = store.clone();
        readers.spawn(async move {
            let found = store.reader(&key(1)).await.unwrap();
            read(&found, 0..found.len()).await.0
        });
    }
    assert!(readers.join_all().await.iter().all(|read| *read == bytes(1, 10_000)));
    assert_eq!(objects.record().take_fetched(), [(0, 10_148)]);
    assert_eq!((store.stats().disk_hits, store.stats().memory_hits), (1, 49));
}

#[tokio::test]
async fn a_large_content_is_read_each_time_and_not_cached() {
    let objects = large().await;
    let store = Store::open_shared_over(Arc::clone(&objects) as _, 64 << 20).await.unwrap();
    for _ in 0..2 {
        let found = store.reader(&key(1)).await.unwrap();
        assert_eq!(read(&found, 0..LENGTH).await.0, content());
    }
    assert_eq!((store.stats().disk_hits, store.stats().memory_bytes), (2, 0));
    let whole = store.get(&key(1)).await.unwrap();
    objects.record().take_fetched();
    let found = store.reader(&key(1)).await.unwrap();
    assert_eq!(read(&found, 0..LENGTH).await.0, whole.bytes);
    assert_eq!(objects.record().take_fetched(), [], "a content that was read whole is in memory");
}

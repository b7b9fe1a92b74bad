//! What is found is read as far as it is wanted, and every byte that is handed on is one that was written.

use std::fs;
use std::ops::Range;
use std::sync::Arc;

use bytes::Bytes;
use futures_util::{StreamExt, TryStreamExt};
use tokio::task::JoinSet;
use verne_store::{Damage, Found, Key, ReadFault, Store};

use crate::place::{Place, bytes, key};
use crate::watched::Watched;

const CHUNK: u64 = 1 << 20;
/// Three chunks and a half.
const LENGTH: u64 = 7 << 19;
const START: u64 = 116 + 4 * 32;
/// What is fetched of an object to begin with.
const BEGINNING: u64 = 64 << 10;

fn at(place: u64) -> usize {
    usize::try_from(place).unwrap()
}

fn content() -> Bytes {
    bytes(1, at(LENGTH))
}

/// Objects with one large one among them.
async fn large() -> Arc<Watched> {
    let objects = Watched::new();
    objects.open().await.put(&key(1), content()).await;
    objects
}

/// What comes of a range before the first error, and that error.
async fn read(found: &Found, range: Range<u64>) -> (Vec<u8>, Option<ReadFault>) {
    let (mut all, mut stream) = (Vec::new(), Box::pin(found.stream(range)));
    while let Some(piece) = stream.next().await {
        match piece {
            Ok(piece) => all.extend_from_slice(&piece),
            Err(fault) => {
                assert!(stream.next().await.is_none(), "nothing comes after an error");
                return (all, Some(fault));
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
        let found = store.find(key).await.unwrap();
        assert_eq!((found.len(), found.hash()), (LENGTH, blake3::hash(&all)));
        let wanted = at(range.start.min(LENGTH))..at(range.end.min(LENGTH));
        let (read, fault) = read(&found, range.clone()).await;
        assert!(fault.is_none() && read == all[wanted], "{range:?}");
    }
}

#[tokio::test]
async fn ranges_from_memory_from_disk_and_from_a_shared_store_are_the_same() {
    let memory = Store::in_memory(64 << 20);
    memory.put(&key(1), content()).await;
    reads_every_range(&memory, &key(1)).await;

    let place = Place::new();
    place.open().await.put(&key(1), content()).await;
    let disk = place.open_without_memory().await;
    reads_every_range(&disk, &key(1)).await;
    assert_eq!((disk.stats().memory_hits, disk.stats().disk_hits), (0, ranges().len() as u64));

    reads_every_range(&large().await.open().await, &key(1)).await;
}

#[tokio::test]
async fn what_memory_holds_is_a_slice_of_it() {
    let store = Store::in_memory(64 << 20);
    let (put, _) = store.put(&key(1), content()).await;
    let found = store.find(&key(1)).await.unwrap();
    let pieces: Vec<_> = found.stream(5..LENGTH).try_collect().await.unwrap();
    assert_eq!(pieces.len(), 1);
    assert_eq!(pieces[0].as_ptr(), put.bytes[5..].as_ptr());
}

#[tokio::test]
async fn a_range_fetches_the_chunks_that_it_touches_and_no_others() {
    let objects = large().await;
    let found = objects.open().await.find(&key(1)).await.unwrap();
    assert_eq!(objects.record().take_fetched(), [(0, BEGINNING)]);
    let (read, _) = read(&found, CHUNK + 5..2 * CHUNK + 1).await;
    assert_eq!(read.len() as u64, CHUNK - 4);
    let fetched = objects.record().take_fetched();
    assert_eq!(fetched, [(START + CHUNK, START + 2 * CHUNK), (START + 2 * CHUNK, START + 3 * CHUNK)]);
}

#[tokio::test]
async fn a_reader_is_one_chunk_ahead_at_most() {
    let objects = Watched::new();
    objects.open().await.put(&key(1), bytes(1, 20 << 20)).await;
    let found = objects.open().await.find(&key(1)).await.unwrap();
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
async fn damage_in_any_chunk_ends_the_stream_before_it() {
    for chunk in 0..4 {
        let objects = large().await;
        let store = objects.open().await;
        let mut object = objects.object(key(1)).await;
        object[at(START + chunk * CHUNK) + 77] ^= 1;
        objects.replace(key(1), object).await;

        let found = store.find(&key(1)).await.unwrap();
        for other in (0..4).filter(|other| *other != chunk) {
            let (read, fault) = read(&found, other * CHUNK..(other + 1) * CHUNK).await;
            assert!(fault.is_none() && content()[at(other * CHUNK)..].starts_with(&read));
        }
        let (read, fault) = read(&found, 0..LENGTH).await;
        assert!(matches!(fault, Some(ReadFault::Damaged(Damage::Bytes))), "{fault:?}");
        assert_eq!(read, content()[..at(chunk * CHUNK)]);
        assert_eq!(store.stats().damaged, 1);
        assert!(store.find(&key(1)).await.is_none(), "it is removed");
        assert_eq!(objects.places().await, []);
    }
}

#[tokio::test]
async fn a_header_that_is_not_sound_hides_the_object() {
    let objects = large().await;
    let store = objects.open().await;
    let sound = objects.object(key(1)).await;
    let hidden = async |key, object: Vec<u8>| {
        objects.replace(key, object).await;
        store.find(&key).await.is_none()
    };
    for place in [0, 8, 12, 20, 52, 84, 116, 116 + 127] {
        let mut object = sound.clone();
        object[place] ^= 1;
        assert!(hidden(key(1), object).await, "byte {place}");
    }
    for length in [0, 1, 84, 116, at(START), at(LENGTH), sound.len() - 1] {
        assert!(hidden(key(1), sound[..length].to_vec()).await, "{length} bytes of it");
    }
    assert!(hidden(key(2), sound.clone()).await, "another key's object");
    assert_eq!((store.stats().damaged, objects.places().await), (16, vec![]));
    assert!(!hidden(key(1), sound).await);
}

#[tokio::test]
async fn a_damaged_object_that_was_written_anew_meanwhile_stays() {
    let objects = large().await;
    let store = objects.open().await;
    let mut object = objects.object(key(1)).await;
    object[at(START)] ^= 1;
    objects.replace(key(1), object).await;
    let found = store.find(&key(1)).await.unwrap();
    let mut stream = Box::pin(found.stream(0..1));
    // The chunk is fetched with the damage in it; that is told when the object is whole again.
    let piece = futures_util::poll!(stream.next());
    assert!(piece.is_pending());
    let (_, kept) = store.put(&key(1), content()).await;
    assert_eq!(kept, verne_store::Kept::Durable);
    assert!(stream.next().await.unwrap().is_err());
    assert_eq!(objects.places().await, [Watched::place(key(1))]);
    assert_eq!(store.get(&key(1)).await.unwrap().bytes, content());
}

#[tokio::test]
async fn damage_on_disk_ends_the_stream_and_frees_the_room() {
    let place = Place::new();
    let store = place.open_without_memory().await;
    store.put(&key(1), content()).await;
    let mut object = fs::read(place.file(key(1))).unwrap();
    object[at(START + CHUNK)] ^= 1;
    fs::write(place.file(key(1)), object).unwrap();
    let found = store.find(&key(1)).await.unwrap();
    let (read, fault) = read(&found, 0..LENGTH).await;
    assert!(read == content()[..at(CHUNK)] && fault.is_some());
    assert_eq!((store.stats().damaged, store.stats().disk_bytes), (1, Some(0)));
    assert!(!place.file(key(1)).exists());
}

#[tokio::test]
async fn what_is_being_read_from_disk_may_make_room_for_another() {
    let place = Place::new();
    let store = place.open_bounded(5 << 20).await;
    store.put(&key(1), content()).await;
    drop(store);
    let store = place.open_bounded(5 << 20).await;
    let found = store.find(&key(1)).await.unwrap();
    let mut stream = Box::pin(found.stream(0..LENGTH));
    let mut all = stream.next().await.unwrap().unwrap().to_vec();
    store.put(&key(2), bytes(2, 3 << 20)).await;
    assert!(!place.file(key(1)).exists());
    while let Some(piece) = stream.next().await {
        all.extend_from_slice(&piece.unwrap());
    }
    assert_eq!(all, content());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 4)]
async fn what_is_small_is_read_once_and_remembered() {
    let objects = Watched::new();
    objects.open().await.put(&key(1), bytes(1, 10_000)).await;
    let store = Store::open_shared_over(Arc::clone(&objects) as _, 1 << 20).await.unwrap();
    let mut readers = JoinSet::new();
    for _ in 0..50 {
        let store = store.clone();
        readers.spawn(async move {
            let found = store.find(&key(1)).await.unwrap();
            read(&found, 0..found.len()).await.0
        });
    }
    assert!(readers.join_all().await.iter().all(|read| *read == bytes(1, 10_000)));
    assert_eq!(objects.record().take_fetched(), [(0, 10_148)]);
    assert_eq!((store.stats().disk_hits, store.stats().memory_hits), (1, 49));
}

#[tokio::test]
async fn what_is_large_is_read_anew_and_not_remembered() {
    let objects = large().await;
    let store = Store::open_shared_over(Arc::clone(&objects) as _, 64 << 20).await.unwrap();
    for _ in 0..2 {
        let found = store.find(&key(1)).await.unwrap();
        assert_eq!(read(&found, 0..LENGTH).await.0, content());
    }
    assert_eq!((store.stats().disk_hits, store.stats().memory_bytes), (2, 0));
    let whole = store.get(&key(1)).await.unwrap();
    objects.record().take_fetched();
    let found = store.find(&key(1)).await.unwrap();
    assert_eq!(read(&found, 0..LENGTH).await.0, whole.bytes);
    assert_eq!(objects.record().take_fetched(), [], "who wanted it whole has it in memory");
}

//! The same over S3. Runs where `VERNE_S3_TEST_URL` names a bucket, `s3://bucket/prefix`, and the usual `AWS_*`
//! variables say how it is reached.

use futures_util::{StreamExt, TryStreamExt};
use verne_store::{Kept, Key, OpenError, Store};

use crate::place::bytes;

/// Keys that no earlier run has used.
fn fresh() -> Key {
    let file = tempfile::NamedTempFile::new().unwrap();
    let now = std::time::SystemTime::now();
    Key::from(blake3::hash(format!("{} {now:?}", file.path().display()).as_bytes()))
}

async fn open() -> Store {
    let address = std::env::var("VERNE_S3_TEST_URL").unwrap();
    Store::open_shared(&address, 0).await.unwrap()
}

#[tokio::test]
#[ignore = "needs a bucket"]
async fn results_of_every_size_are_found_by_another_process() {
    let (writer, reader) = (open().await, open().await);
    // Of one request, of two, of several chunks, and of several parts.
    for (number, length) in
        (0..).zip([0, 1, 50_000, 70_000, 1 << 20, 3 << 20, (8 << 20) - 1000, (20 << 20) + 3])
    {
        let (key, all) = (fresh(), bytes(number, length));
        assert!(reader.find(&key).await.is_none());
        let (put, kept) = writer.put(&key, all.clone()).await;
        assert_eq!(kept, Kept::Durable);
        drop(put);
        let found = reader.find(&key).await.unwrap();
        assert_eq!((found.len(), found.hash()), (length as u64, blake3::hash(&all)));
        let (start, end) = (length / 3, length - length / 5);
        let pieces: Vec<_> = found.stream(start as u64..end as u64).try_collect().await.unwrap();
        assert!(pieces.concat() == all[start..end], "{length} bytes");
        drop((found, pieces));
        assert!(reader.get(&key).await.unwrap().bytes == all, "{length} bytes");
    }
    let stats = (reader.stats().damaged, reader.stats().read_failures, writer.stats().write_failures);
    assert_eq!(stats, (0, 0, 0));
    assert_eq!(writer.healthy().await, Ok(()));
}

#[tokio::test]
#[ignore = "needs a bucket"]
async fn many_readers_and_writers_of_one_large_result() {
    let (key, all) = (fresh(), bytes(7, 9 << 20));
    let mut tasks = tokio::task::JoinSet::new();
    for _ in 0..4 {
        let (store, all) = (open().await, all.clone());
        tasks.spawn(async move {
            assert_eq!(store.put(&key, all.clone()).await.1, Kept::Durable);
            let found = store.find(&key).await.unwrap();
            let mut stream = Box::pin(found.stream(0..found.len()));
            let mut read = Vec::new();
            while let Some(piece) = stream.next().await {
                read.extend_from_slice(&piece.unwrap());
            }
            assert!(read == all);
        });
    }
    tasks.join_all().await;
}

#[tokio::test]
#[ignore = "needs a bucket"]
async fn a_bucket_that_is_not_there_is_an_error_at_the_start() {
    let opened = Store::open_shared("s3://verne-there-is-no-such-bucket/results", 0).await;
    let Err(fault @ OpenError::Shared { .. }) = opened else { panic!("opened") };
    assert!(fault.to_string().contains("verne-there-is-no-such-bucket"), "{fault}");
}

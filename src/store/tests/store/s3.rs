//! A store on S3. Needs a bucket: `VERNE_S3_TEST_URL` is its address, `s3://bucket/prefix`, and the `AWS_*` variables
//! give endpoint and credentials.

use futures_util::{StreamExt, TryStreamExt};
use verne_store::{Durability, Key, OpenError, Store};

use crate::directory::bytes;

/// A key that no earlier run has used.
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
async fn another_process_reads_contents_of_every_size() {
    let (writer, reader) = (open().await, open().await);
    // With one request, two requests, several chunks, and several parts.
    for (number, length) in
        (0..).zip([0, 1, 50_000, 70_000, 1 << 20, 3 << 20, (8 << 20) - 1000, (20 << 20) + 3])
    {
        let (key, all) = (fresh(), bytes(number, length));
        assert!(reader.reader(&key).await.is_none());
        let (put, durability) = writer.put(&key, all.clone()).await;
        assert_eq!(durability, Durability::Durable);
        drop(put);
        let found = reader.reader(&key).await.unwrap();
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
async fn many_processes_read_and_write_one_large_content() {
    let (key, all) = (fresh(), bytes(7, 9 << 20));
    let mut tasks = tokio::task::JoinSet::new();
    for _ in 0..4 {
        let (store, all) = (open().await, all.clone());
        tasks.spawn(async move {
            assert_eq!(store.put(&key, all.clone()).await.1, Durability::Durable);
            let found = store.reader(&key).await.unwrap();
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
async fn opening_a_missing_bucket_fails_with_its_name() {
    let opened = Store::open_shared("s3://verne-there-is-no-such-bucket/results", 0).await;
    let Err(error @ OpenError::Shared { .. }) = opened else { panic!("opened") };
    assert!(error.to_string().contains("verne-there-is-no-such-bucket"), "{error}");
}

//! Objects in memory that record their requests and refuse some of them.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use async_trait::async_trait;
use bytes::Bytes;
use futures_util::stream::BoxStream;
use futures_util::{FutureExt, TryStreamExt};
use object_store::memory::InMemory;
use object_store::path::Path;
use object_store::{
    CopyOptions, Error, GetOptions, GetResult, ListResult, MultipartUpload, ObjectMeta, ObjectStore,
    ObjectStoreExt, PutMultipartOptions, PutOptions, PutPayload, PutResult, Result, UploadPart,
};
use verne_store::{Key, Store};

#[derive(Debug, Default)]
pub(crate) struct RecordingObjects {
    inner: InMemory,
    record: Arc<Record>,
}

/// The requests, and which of them are refused.
#[derive(Debug, Default)]
pub(crate) struct Record {
    /// Start and end of each range that was fetched.
    fetched: Mutex<Vec<(u64, u64)>>,
    /// The location of each object that was written in one request.
    pub(crate) put: Mutex<Vec<Path>>,
    /// Lengths of the parts of uploads.
    pub(crate) parts: Mutex<Vec<usize>>,
    pub(crate) aborted: AtomicUsize,
    /// Whether the last part of an upload is refused.
    pub(crate) last_part_fails: AtomicBool,
    pub(crate) all_fail: AtomicBool,
    /// One request in so many is refused; 0: none.
    pub(crate) one_in: AtomicUsize,
    requests: AtomicUsize,
    pub(crate) refused: AtomicUsize,
}

impl Record {
    fn count(&self) -> Result<()> {
        let requests = self.requests.fetch_add(1, Ordering::Relaxed) + 1;
        let one_in = self.one_in.load(Ordering::Relaxed);
        if self.all_fail.load(Ordering::Relaxed) || (one_in > 0 && requests.is_multiple_of(one_in)) {
            self.refused.fetch_add(1, Ordering::Relaxed);
            return Err(Error::Generic { store: "test", source: "slow down".into() });
        }
        Ok(())
    }

    /// The ranges that were fetched since the last call.
    pub(crate) fn take_fetched(&self) -> Vec<(u64, u64)> {
        std::mem::take(&mut self.fetched.lock().unwrap())
    }
}

impl RecordingObjects {
    pub(crate) fn new() -> Arc<Self> {
        Arc::default()
    }

    pub(crate) fn record(&self) -> &Record {
        &self.record
    }

    /// A store of these objects without a memory cache.
    pub(crate) async fn open(self: &Arc<Self>) -> Store {
        Store::open_shared_over(Arc::clone(self) as _, 0).await.unwrap()
    }

    pub(crate) fn location(key: Key) -> Path {
        let digits = key.to_string();
        Path::from_iter([&digits[..2], &digits[2..]])
    }

    /// The bytes of a key's object.
    pub(crate) async fn object(&self, key: Key) -> Vec<u8> {
        self.inner.get(&Self::location(key)).await.unwrap().bytes().await.unwrap().to_vec()
    }

    /// Replaces a key's object.
    pub(crate) async fn replace(&self, key: Key, object: Vec<u8>) {
        self.inner.put(&Self::location(key), Bytes::from(object).into()).await.unwrap();
    }

    /// The locations of all objects.
    pub(crate) async fn locations(&self) -> Vec<Path> {
        self.inner.list(None).map_ok(|meta| meta.location).try_collect().await.unwrap()
    }
}

impl fmt::Display for RecordingObjects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.inner.fmt(f)
    }
}

#[async_trait]
impl ObjectStore for RecordingObjects {
    async fn put_opts(&self, location: &Path, payload: PutPayload, options: PutOptions) -> Result<PutResult> {
        self.record.count()?;
        self.record.put.lock().unwrap().push(location.clone());
        self.inner.put_opts(location, payload, options).await
    }

    async fn put_multipart_opts(
        &self,
        location: &Path,
        options: PutMultipartOptions,
    ) -> Result<Box<dyn MultipartUpload>> {
        self.record.count()?;
        let upload = self.inner.put_multipart_opts(location, options).await?;
        Ok(Box::new(Upload { upload, record: Arc::clone(&self.record) }))
    }

    async fn get_opts(&self, location: &Path, options: GetOptions) -> Result<GetResult> {
        self.record.count()?;
        let found = self.inner.get_opts(location, options).await?;
        self.record.fetched.lock().unwrap().push((found.range.start, found.range.end));
        Ok(found)
    }

    fn delete_stream(&self, places: BoxStream<'static, Result<Path>>) -> BoxStream<'static, Result<Path>> {
        self.inner.delete_stream(places)
    }

    fn list(&self, prefix: Option<&Path>) -> BoxStream<'static, Result<ObjectMeta>> {
        self.inner.list(prefix)
    }

    async fn list_with_delimiter(&self, prefix: Option<&Path>) -> Result<ListResult> {
        self.inner.list_with_delimiter(prefix).await
    }

    async fn copy_opts(&self, from: &Path, to: &Path, options: CopyOptions) -> Result<()> {
        self.inner.copy_opts(from, to, options).await
    }
}

#[derive(Debug)]
struct Upload {
    upload: Box<dyn MultipartUpload>,
    record: Arc<Record>,
}

#[async_trait]
impl MultipartUpload for Upload {
    fn put_part(&mut self, part: PutPayload) -> UploadPart {
        let last = part.content_length() < 8 << 20;
        self.record.parts.lock().unwrap().push(part.content_length());
        if last && self.record.last_part_fails.load(Ordering::Relaxed) {
            let error = Error::Generic { store: "test", source: "the part is lost".into() };
            return async { Err(error) }.boxed();
        }
        self.upload.put_part(part)
    }

    async fn complete(&mut self) -> Result<PutResult> {
        self.record.count()?;
        self.upload.complete().await
    }

    async fn abort(&mut self) -> Result<()> {
        self.record.aborted.fetch_add(1, Ordering::Relaxed);
        self.upload.abort().await
    }
}

//! A directory of objects that fails or pauses when a test wants it to.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use async_trait::async_trait;
use futures_util::StreamExt;
use futures_util::stream::BoxStream;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::{
    CopyOptions, Error, GetOptions, GetResult, ListResult, MultipartUpload, ObjectMeta, ObjectStore,
    PutMultipartOptions, PutOptions, PutPayload, PutResult, Result,
};
use tokio::sync::Semaphore;

#[derive(Debug)]
pub(crate) struct ControlledObjects {
    inner: Arc<LocalFileSystem>,
    pub(crate) puts_fail: AtomicBool,
    pub(crate) gets_fail: AtomicBool,
    pub(crate) deletes_fail: AtomicBool,
    /// A put, a get or a deletion returns, after it is done, when it gets a permit.
    pub(crate) gate: Arc<Semaphore>,
    /// One permit for each operation that waits, or has waited, at the gate.
    pub(crate) arrived: Arc<Semaphore>,
    pub(crate) gets: AtomicUsize,
}

impl ControlledObjects {
    pub(crate) fn over(inner: LocalFileSystem) -> Arc<Self> {
        Arc::new(Self {
            inner: Arc::new(inner),
            puts_fail: AtomicBool::default(),
            gets_fail: AtomicBool::default(),
            deletes_fail: AtomicBool::default(),
            gate: Arc::new(Semaphore::new(Semaphore::MAX_PERMITS / 2)),
            arrived: Arc::new(Semaphore::new(0)),
            gets: AtomicUsize::default(),
        })
    }

    /// From now on no operation returns.
    pub(crate) fn close_gate(&self) {
        self.gate.forget_permits(Semaphore::MAX_PERMITS);
        self.arrived.forget_permits(Semaphore::MAX_PERMITS);
    }

    pub(crate) fn open_gate(&self) {
        self.gate.add_permits(Semaphore::MAX_PERMITS / 2);
    }

    /// Waits until the next operation arrives at the gate.
    pub(crate) async fn arrival(&self) {
        self.arrived.acquire().await.unwrap().forget();
    }
}

async fn pass(gate: &Semaphore, arrived: &Semaphore) {
    arrived.add_permits(1);
    gate.acquire().await.unwrap().forget();
}

fn refused(refuses: &AtomicBool) -> Result<()> {
    let source = "no space left on device".into();
    if refuses.load(Ordering::Relaxed) { Err(Error::Generic { store: "test", source }) } else { Ok(()) }
}

impl fmt::Display for ControlledObjects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.inner.fmt(f)
    }
}

#[async_trait]
impl ObjectStore for ControlledObjects {
    async fn put_opts(&self, location: &Path, payload: PutPayload, options: PutOptions) -> Result<PutResult> {
        refused(&self.puts_fail)?;
        let done = self.inner.put_opts(location, payload, options).await;
        pass(&self.gate, &self.arrived).await;
        done
    }

    async fn put_multipart_opts(
        &self,
        location: &Path,
        options: PutMultipartOptions,
    ) -> Result<Box<dyn MultipartUpload>> {
        self.inner.put_multipart_opts(location, options).await
    }

    async fn get_opts(&self, location: &Path, options: GetOptions) -> Result<GetResult> {
        refused(&self.gets_fail)?;
        self.gets.fetch_add(1, Ordering::Relaxed);
        let done = self.inner.get_opts(location, options).await;
        pass(&self.gate, &self.arrived).await;
        done
    }

    fn delete_stream(&self, places: BoxStream<'static, Result<Path>>) -> BoxStream<'static, Result<Path>> {
        if let Err(error) = refused(&self.deletes_fail) {
            return futures_util::stream::once(async { Err(error) }).boxed();
        }
        let (gate, arrived) = (Arc::clone(&self.gate), Arc::clone(&self.arrived));
        let done = self.inner.delete_stream(places).then(move |done| {
            let (gate, arrived) = (Arc::clone(&gate), Arc::clone(&arrived));
            async move {
                pass(&gate, &arrived).await;
                done
            }
        });
        done.boxed()
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

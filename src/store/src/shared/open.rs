//! Opening a shared store: which one an address means, and that it takes objects.

use std::fs;
use std::sync::Arc;
use std::time::Duration;

use object_store::aws::AmazonS3Builder;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::prefix::PrefixStore;
use object_store::{BackoffConfig, Error, ObjectStore, RetryConfig};
use url::Url;

use super::Shared;
use crate::OpenError;
use crate::objects::Objects;
use crate::stats::Counts;

/// For so long what the store refuses is asked again.
const PATIENCE: Duration = Duration::from_secs(30);

/// A single request to S3 is repeated so often and for so long: of what is refused one time in ten, one in 10^11
/// fails. What is left of the patience is for what consists of several requests.
const REPEATS: usize = 10;
const REPEATED: Duration = Duration::from_secs(10);

/// Longer than one request is repeated: what the store says is worth waiting for.
const OPENED: Duration = Duration::from_secs(20);

impl Shared {
    /// Opens the store at an address.
    pub(crate) async fn open(address: &str, counts: Arc<Counts>) -> Result<Arc<Self>, OpenError> {
        let wrong =
            |reason: &str| OpenError::Address { address: address.to_owned(), reason: reason.to_owned() };
        let url = Url::parse(address).map_err(|fault| wrong(&fault.to_string()))?;
        if url.query().is_some() || url.fragment().is_some() || !url.username().is_empty() {
            return Err(wrong("it has more than a bucket or directory and a path"));
        }
        let objects = match url.scheme() {
            "s3" => bucket(&url, address)?,
            "file" => directory(&url, address).await?,
            _ => return Err(wrong("it begins with neither s3:// nor file:///")),
        };
        Self::tried_over(objects, address, counts).await
    }

    /// Opens a store whose objects lie where the caller says.
    pub(crate) async fn open_over(
        objects: Arc<dyn ObjectStore>,
        counts: Arc<Counts>,
    ) -> Result<Arc<Self>, OpenError> {
        let address = objects.to_string();
        Self::tried_over(Objects::far_away(objects, PATIENCE), &address, counts).await
    }

    async fn tried_over(
        objects: Objects,
        address: &str,
        counts: Arc<Counts>,
    ) -> Result<Arc<Self>, OpenError> {
        let shared = Self::new(objects, counts);
        shared.tried(OPENED).await.map_err(|source| refusal(address, source))?;
        Ok(Arc::new(shared))
    }
}

/// A bucket, reached with what the environment says. Each request has object_store's own bounds, 5 s to connect
/// and 30 s in all; `AWS_CONNECT_TIMEOUT` and `AWS_TIMEOUT` change them.
fn bucket(url: &Url, address: &str) -> Result<Objects, OpenError> {
    let wrong = |reason: &str| OpenError::Address { address: address.to_owned(), reason: reason.to_owned() };
    let name = url.host_str().filter(|name| !name.is_empty()).ok_or_else(|| wrong("it names no bucket"))?;
    if url.port().is_some() {
        return Err(wrong("it has a port: the endpoint is named by AWS_ENDPOINT"));
    }
    let prefix = Path::from_url_path(url.path()).map_err(|fault| wrong(&fault.to_string()))?;
    let retry =
        RetryConfig { backoff: BackoffConfig::default(), max_retries: REPEATS, retry_timeout: REPEATED };
    let bucket = AmazonS3Builder::from_env().with_bucket_name(name).with_retry(retry).build();
    let bucket = bucket.map_err(|source| refusal(address, source))?;
    Ok(Objects::far_away(Arc::new(PrefixStore::new(bucket, prefix)), PATIENCE))
}

/// A directory, made if it is not there.
async fn directory(url: &Url, address: &str) -> Result<Objects, OpenError> {
    let directory = url.to_file_path().map_err(|()| OpenError::Address {
        address: address.to_owned(),
        reason: "it names no directory of this machine".to_owned(),
    })?;
    let opened = tokio::task::spawn_blocking(move || {
        let made = fs::create_dir_all(&directory).map_err(|source| (directory.clone(), source));
        made.map(|()| LocalFileSystem::new_with_prefix(&directory))
    });
    let objects = opened.await.map_err(|fault| refusal(address, fault.into()))?;
    let objects = objects.map_err(|(directory, source)| OpenError::Directory { directory, source })?;
    let objects = objects.map_err(|source| refusal(address, source))?.with_fsync(true);
    Ok(Objects::in_shared_directory(Arc::new(objects), PATIENCE))
}

fn refusal(address: &str, source: Error) -> OpenError {
    OpenError::Shared { address: address.to_owned(), source }
}

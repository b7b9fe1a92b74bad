//! Opening a shared store: which one an address means, and that it takes objects.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use object_store::aws::AmazonS3Builder;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::prefix::PrefixStore;
use object_store::{BackoffConfig, Error, ObjectStore, RetryConfig};
use url::Url;

use super::{Marker, Shared};
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
        let url = read(address)?;
        let objects = match url.scheme() {
            "s3" => bucket(&url, address)?,
            "file" => directory(&url, address).await?,
            _ => return Err(wrong(address, "it begins with neither s3:// nor file:///")),
        };
        Self::tried_over(objects, address, counts).await
    }

    /// Makes the directory at an address, and its marker, where they are not there. Answers whether the marker was
    /// made.
    pub(crate) fn init(address: &str) -> Result<bool, OpenError> {
        let url = read(address)?;
        if url.scheme() != "file" {
            return Err(wrong(address, "only a directory, file:///..., is prepared"));
        }
        let directory = path(&url, address)?;
        let made = fs::create_dir_all(&directory).and_then(|()| Marker::of(&directory).make());
        made.map_err(|source| OpenError::Directory { directory, source })
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

fn wrong(address: &str, reason: &str) -> OpenError {
    OpenError::Address { address: address.to_owned(), reason: reason.to_owned() }
}

fn read(address: &str) -> Result<Url, OpenError> {
    let url = Url::parse(address).map_err(|fault| wrong(address, &fault.to_string()))?;
    if url.query().is_some() || url.fragment().is_some() || !url.username().is_empty() {
        return Err(wrong(address, "it has more than a bucket or directory and a path"));
    }
    Ok(url)
}

fn path(url: &Url, address: &str) -> Result<PathBuf, OpenError> {
    url.to_file_path().map_err(|()| wrong(address, "it names no directory of this machine"))
}

/// A bucket, reached with what the environment says. Each request has object_store's own bounds, 5 s to connect
/// and 30 s in all; `AWS_CONNECT_TIMEOUT` and `AWS_TIMEOUT` change them.
fn bucket(url: &Url, address: &str) -> Result<Objects, OpenError> {
    let wrong = |reason: &str| wrong(address, reason);
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

/// A directory that has its marker.
async fn directory(url: &Url, address: &str) -> Result<Objects, OpenError> {
    let directory = path(url, address)?;
    let opened = tokio::task::spawn_blocking(move || {
        // Its marker as it is seen now, wherever a link leads later.
        let directory = directory.canonicalize().unwrap_or(directory);
        let marker = Marker::of(&directory);
        match fs::metadata(marker.path()) {
            Ok(_) => Ok((LocalFileSystem::new_with_prefix(&directory), marker)),
            Err(source) => Err((marker.path(), source)),
        }
    });
    let opened = opened.await.map_err(|fault| refusal(address, fault.into()))?;
    let no_marker = |(marker, source)| OpenError::NoMarker { address: address.to_owned(), marker, source };
    let (objects, marker) = opened.map_err(no_marker)?;
    let objects = objects.map_err(|source| refusal(address, source))?.with_fsync(true);
    Ok(Objects::in_shared_directory(Arc::new(objects), PATIENCE, marker))
}

fn refusal(address: &str, source: Error) -> OpenError {
    OpenError::Shared { address: address.to_owned(), source }
}

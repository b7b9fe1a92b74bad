//! Opens the shared store at an address, and tests whether it is writable.

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

use super::Shared;
use crate::error::OpenError;
use crate::marker::Marker;
use crate::object_io::ObjectIo;

/// For how long an operation is repeated that the store refuses.
const RETRY: Duration = Duration::from_secs(30);

/// A single request to S3 is repeated so often, and for so long: if the store refuses one request in ten, one in 10^11
/// fails. The rest of [`RETRY`] is for operations of several requests.
const REQUEST_RETRIES: usize = 10;
const REQUEST_RETRY: Duration = Duration::from_secs(10);

/// Longer than [`REQUEST_RETRY`], so that the error of the store is reported, not the timeout.
const OPEN_TIMEOUT: Duration = Duration::from_secs(20);

impl Shared {
    /// Opens the store at an address.
    pub(crate) async fn open(address: &str) -> Result<Arc<Self>, OpenError> {
        let url = parse(address)?;
        let io = match url.scheme() {
            "s3" => bucket(&url, address)?,
            "file" => directory(&url, address).await?,
            _ => return Err(invalid(address, "it begins with neither s3:// nor file:///")),
        };
        Self::open_io(io, address).await
    }

    /// Creates the directory at an address, and its marker, unless they exist. Returns whether the marker was created.
    pub(crate) fn init(address: &str) -> Result<bool, OpenError> {
        let url = parse(address)?;
        if url.scheme() != "file" {
            return Err(invalid(address, "only a directory, file:///..., can be prepared"));
        }
        let directory = path(&url, address)?;
        let created = fs::create_dir_all(&directory).and_then(|()| Marker::of(&directory).create());
        created.map_err(|source| OpenError::Directory { directory, source })
    }

    /// Opens a store of given objects.
    pub(crate) async fn open_over(objects: Arc<dyn ObjectStore>) -> Result<Arc<Self>, OpenError> {
        let address = objects.to_string();
        Self::open_io(ObjectIo::remote(objects, RETRY), &address).await
    }

    async fn open_io(io: ObjectIo, address: &str) -> Result<Arc<Self>, OpenError> {
        let shared = Self::new(io);
        shared.probe(OPEN_TIMEOUT).await.map_err(|source| open_error(address, source))?;
        Ok(Arc::new(shared))
    }
}

fn invalid(address: &str, reason: &str) -> OpenError {
    OpenError::Address { address: address.to_owned(), reason: reason.to_owned() }
}

fn parse(address: &str) -> Result<Url, OpenError> {
    let url = Url::parse(address).map_err(|error| invalid(address, &error.to_string()))?;
    if url.query().is_some() || url.fragment().is_some() || !url.username().is_empty() {
        return Err(invalid(address, "it has more than a bucket or directory and a path"));
    }
    Ok(url)
}

fn path(url: &Url, address: &str) -> Result<PathBuf, OpenError> {
    url.to_file_path().map_err(|()| invalid(address, "it does not name a directory of this computer"))
}

/// A bucket, with the endpoint and the credentials of the environment. Each request has the limits of object_store: 5 s
/// to connect and 30 s in all, unless `AWS_CONNECT_TIMEOUT` and `AWS_TIMEOUT` are set.
fn bucket(url: &Url, address: &str) -> Result<ObjectIo, OpenError> {
    let invalid = |reason: &str| invalid(address, reason);
    let name = url.host_str().filter(|name| !name.is_empty()).ok_or_else(|| invalid("it names no bucket"))?;
    if url.port().is_some() {
        return Err(invalid("it has a port: set the endpoint with AWS_ENDPOINT"));
    }
    let prefix = Path::from_url_path(url.path()).map_err(|error| invalid(&error.to_string()))?;
    let retry = RetryConfig {
        backoff: BackoffConfig::default(),
        max_retries: REQUEST_RETRIES,
        retry_timeout: REQUEST_RETRY,
    };
    let bucket = AmazonS3Builder::from_env().with_bucket_name(name).with_retry(retry).build();
    let bucket = bucket.map_err(|source| open_error(address, source))?;
    Ok(ObjectIo::remote(Arc::new(PrefixStore::new(bucket, prefix)), RETRY))
}

/// A directory that has a marker.
async fn directory(url: &Url, address: &str) -> Result<ObjectIo, OpenError> {
    let directory = path(url, address)?;
    let opened = tokio::task::spawn_blocking(move || {
        // Without links, so that the marker is that of the directory as it is now.
        let directory = directory.canonicalize().unwrap_or(directory);
        let marker = Marker::of(&directory);
        match fs::metadata(marker.path()) {
            Ok(_) => Ok((LocalFileSystem::new_with_prefix(&directory), marker)),
            Err(source) => Err((marker.path(), source)),
        }
    });
    let opened = opened.await.map_err(|error| open_error(address, error.into()))?;
    let no_marker = |(marker, source)| OpenError::NoMarker { address: address.to_owned(), marker, source };
    let (objects, marker) = opened.map_err(no_marker)?;
    let objects = objects.map_err(|source| open_error(address, source))?.with_fsync(true);
    Ok(ObjectIo::in_shared_directory(Arc::new(objects), RETRY, marker))
}

fn open_error(address: &str, source: Error) -> OpenError {
    OpenError::Shared { address: address.to_owned(), source }
}

//! Workspaces and their files, kept in memory under their ids: bounded in bytes, the longest unused leave first, and
//! equal questions at the same moment are computed once.

use std::future::Future;
use std::sync::Arc;

use axum::body::Bytes;
use moka::future::Cache;
use moka::policy::EvictionPolicy;

use crate::answers::Workspace;
use crate::error::Error;
use crate::wire::format::MeshFormat;

/// Bytes that never change, and the strong entity tag that says so.
#[derive(Clone, Debug)]
pub(crate) struct Content {
    /// The bytes.
    pub bytes: Bytes,
    /// Their hash.
    pub hash: blake3::Hash,
}

impl From<Vec<u8>> for Content {
    fn from(bytes: Vec<u8>) -> Self {
        Self { hash: blake3::hash(&bytes), bytes: bytes.into() }
    }
}

/// The results that are kept.
#[derive(Debug)]
pub(crate) struct Results {
    workspaces: Cache<String, Arc<Workspace>>,
    files: Cache<(String, MeshFormat), Content>,
}

impl Results {
    /// Room for so many bytes, half of them for files: a file is about as large as the workspace it is written from.
    pub(crate) fn within(bytes: u64) -> Self {
        let weight = |bytes: usize| u32::try_from(bytes).unwrap_or(u32::MAX);
        // By use alone: the default policy may turn away what is new, and its id has just been handed out.
        let workspaces = Cache::builder()
            .max_capacity(bytes / 2)
            .eviction_policy(EvictionPolicy::lru())
            .weigher(move |_, workspace: &Arc<Workspace>| weight(workspace.bytes()));
        let files = Cache::builder()
            .max_capacity(bytes / 2)
            .eviction_policy(EvictionPolicy::lru())
            .weigher(move |_, content: &Content| weight(content.bytes.len()));
        Self { workspaces: workspaces.build(), files: files.build() }
    }

    /// The workspace with this id, computed if it is not kept.
    pub(crate) async fn workspace(
        &self,
        id: &str,
        compute: impl Future<Output = Result<Workspace, Error>>,
    ) -> Result<Arc<Workspace>, Error> {
        let computed = async { compute.await.map(Arc::new) };
        self.workspaces.try_get_with(id.to_owned(), computed).await.map_err(|error| (*error).clone())
    }

    /// The workspace with this id, if it is kept.
    pub(crate) async fn kept(&self, id: &str) -> Result<Arc<Workspace>, Error> {
        self.workspaces.get(id).await.ok_or_else(|| Error::NoSuchWorkspace(id.to_owned()))
    }

    /// The mesh of a workspace in a format, written if it is not kept.
    pub(crate) async fn file(
        &self,
        id: &str,
        format: MeshFormat,
        write: impl Future<Output = Result<Content, Error>>,
    ) -> Result<Content, Error> {
        self.files.try_get_with((id.to_owned(), format), write).await.map_err(|error| (*error).clone())
    }
}

//! The client that sends a request.

use std::net::SocketAddr;
use std::sync::Arc;

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::Extensions;
use axum::http::request::Parts;
use verne_jobs::Job;

use crate::http::error::{AccessError, HttpError};
use crate::http::state::SharedState;
use crate::limits::client_address::client_name;
use crate::limits::keys::AcceptedKey;
use crate::limits::rate::TokenBucket;
use crate::wire::error::OperationError;
use crate::wire::role::Role;

/// The client that sends a request. [Access control](crate::http::access_control) adds it to the request's extensions.
#[derive(Clone, Debug)]
pub(crate) struct Client {
    /// The name of the key, or the address of a client without a key. The queue shares the cores among these names.
    pub name: String,
    /// The role. In a service without keys every client is an administrator.
    pub role: Role,
    /// Whether quotas limit the client.
    pub has_quota: bool,
    /// Whether a web page of another origin sends the request. Such a page may read, but not start anything.
    pub is_cross_origin: bool,
    /// The rate of the client, if it has one.
    pub bucket: Option<Arc<TokenBucket>>,
    /// The key that the client sent, if the route requires one.
    pub key: Option<AcceptedKey>,
}

impl Client {
    /// Fails if the role is lower than this one.
    pub(crate) fn require(&self, role: Role) -> Result<(), AccessError> {
        if self.is_cross_origin && role > Role::Read {
            return Err(AccessError::OtherOrigin);
        }
        if self.role >= role { Ok(()) } else { Err(AccessError::Forbidden(role)) }
    }

    /// The name to which quotas are charged; `None` without a quota.
    pub(crate) fn quota(&self) -> Option<&str> {
        self.has_quota.then_some(self.name.as_str())
    }

    /// The name whose jobs the client sees; `None` if it sees all jobs.
    pub(crate) fn sees_only(&self) -> Option<&str> {
        (self.role < Role::Admin).then_some(self.name.as_str())
    }

    /// Whether the client sees a job.
    pub(crate) fn sees(&self, job: &Job) -> bool {
        self.sees_only().is_none_or(|client| job.clients.contains(client))
    }

    /// Returns when the key is removed or has another name or role.
    pub(crate) fn revoked(&self) -> impl Future<Output = ()> + Send + 'static {
        let key = self.key.clone();
        async move {
            match key {
                Some(key) => key.revoked().await,
                None => std::future::pending().await,
            }
        }
    }
}

impl FromRequestParts<SharedState> for Client {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, _: &SharedState) -> Result<Self, HttpError> {
        parts.extensions.get().cloned().ok_or(OperationError::Internal.into())
    }
}

/// The name of the client at the peer's address, and whether it has a quota. The machine itself has none: a proxy there
/// may send the requests of all clients.
pub(crate) fn peer(extensions: &Extensions) -> (String, bool) {
    match extensions.get::<ConnectInfo<SocketAddr>>() {
        Some(ConnectInfo(peer)) => (client_name(peer.ip()), !peer.ip().to_canonical().is_loopback()),
        None => ("local".to_owned(), false),
    }
}

//! Who is behind a request.

use std::net::SocketAddr;

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::Extensions;
use axum::http::request::Parts;
use verne_jobs::Job;

use crate::http::error::{AccessError, HttpError};
use crate::http::state::Shared;
use crate::limits::client_address::client_name;
use crate::limits::keys::Pass;
use crate::wire::error::OperationError;
use crate::wire::role::Role;

/// Who asks. There for every route that the [gate](crate::http::gate::Gate) is before.
#[derive(Clone, Debug)]
pub(crate) struct Caller {
    /// Whose share of the cores a job is charged to: the key's name, or the address of who has none.
    pub client: String,
    /// What it may. Without keys anybody may everything.
    pub role: Role,
    /// Whether it may have but a part of what is there for all at once.
    pub bounded: bool,
    /// Whether a page of another origin has the browser ask: it may read what anybody may, and start nothing.
    pub foreign: bool,
    /// The key, where one was sent and is asked for.
    pub pass: Option<Pass>,
}

impl Caller {
    /// Fails for a role that does not suffice.
    pub(crate) fn must_be(&self, needed: Role) -> Result<(), AccessError> {
        if self.foreign && needed > Role::Read {
            return Err(AccessError::OtherOrigin);
        }
        if self.role >= needed { Ok(()) } else { Err(AccessError::Forbidden(needed)) }
    }

    /// Who has a part of what is there for all at once; `None`: as much as there is.
    pub(crate) fn sharer(&self) -> Option<&str> {
        self.bounded.then_some(self.client.as_str())
    }

    /// Whose jobs it sees; `None`: those of all.
    pub(crate) fn sees_only(&self) -> Option<&str> {
        (self.role < Role::Admin).then_some(self.client.as_str())
    }

    /// Whether the job is there for it.
    pub(crate) fn sees(&self, job: &Job) -> bool {
        self.sees_only().is_none_or(|client| job.clients.contains(client))
    }
}

impl Caller {
    /// Returns when the caller may no longer have what it has: its key was removed, or is another's by now.
    pub(crate) fn revoked(&self) -> impl Future<Output = ()> + Send + 'static {
        let pass = self.pass.clone();
        async move {
            match pass {
                Some(pass) => pass.revoked().await,
                None => std::future::pending().await,
            }
        }
    }
}

impl FromRequestParts<Shared> for Caller {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, _: &Shared) -> Result<Self, HttpError> {
        // The gate has put it there.
        parts.extensions.get().cloned().ok_or(OperationError::Internal.into())
    }
}

/// The address that a request comes from, as a client of the queue; and whether it is bounded. This machine itself is not:
/// what it sends may come from a proxy, for everybody.
pub(crate) fn address(extensions: &Extensions) -> (String, bool) {
    match extensions.get::<ConnectInfo<SocketAddr>>() {
        Some(ConnectInfo(peer)) => (client_name(peer.ip()), !peer.ip().to_canonical().is_loopback()),
        None => ("local".to_owned(), false),
    }
}

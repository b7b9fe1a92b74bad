//! What every question passes on its way to its handler.

use std::path::PathBuf;
use std::sync::Arc;

use axum::Router;
use axum::body::Body;
use axum::extract::{Request, State};
use axum::http::header::CACHE_CONTROL;
use axum::http::{HeaderMap, HeaderValue, Response};
use axum::middleware::{Next, from_fn_with_state};
use axum::routing::MethodRouter;
use headers::HeaderMapExt;
use headers::authorization::{Authorization, Bearer};

use crate::http::allowed_origins::Pages;
use crate::http::caller::{Caller, address};
use crate::http::error::{AccessError, HttpError};
use crate::http::request_log::sent_by;
use crate::http::state::Shared;
use crate::limits::admission::{Admission, Load};
use crate::limits::error::LimitError;
use crate::limits::keys::Keys;
use crate::limits::keys_file::BadKeys;
use crate::limits::rate::{Addresses, Bucket, Rate};
use crate::wire::role::Role;

/// Who may use a route where the service has keys, and what it is to the service.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Access {
    /// Anybody, without limit: probes.
    Probe,
    /// Anybody.
    Open,
    /// Keys of this role, and of those above, for what is this to the service.
    For(Role, Load),
}

/// Stands before the routes.
#[derive(Clone)]
pub(crate) struct Gate {
    /// Without them everybody may everything.
    keys: Option<Arc<Keys>>,
    /// Limits those whose keys are not asked for.
    addresses: Option<Addresses>,
    admission: Arc<Admission>,
    pages: Arc<Pages>,
}

impl Gate {
    /// For all, without a limit but that of places.
    pub(crate) fn for_all(admission: Arc<Admission>) -> Self {
        Self { keys: None, addresses: None, admission, pages: Arc::default() }
    }

    /// As the settings have it.
    pub(crate) async fn open(
        keys: Option<PathBuf>,
        rate: Option<Rate>,
        pages: Pages,
        admission: Arc<Admission>,
    ) -> Result<Self, BadKeys> {
        let keys = match keys {
            Some(path) => Some(Keys::open(path, rate).await?),
            None => None,
        };
        Ok(Self { keys, addresses: rate.map(Addresses::new), admission, pages: Arc::new(pages) })
    }

    /// Reads the keys again; if that fails, they stay as they are.
    pub(crate) async fn reload(&self) -> Result<(), BadKeys> {
        match &self.keys {
            Some(keys) => keys.reload().await,
            None => Ok(()),
        }
    }

    /// The route with the gate before it; also before the methods that it does not have.
    pub(crate) fn before(&self, route: MethodRouter<Shared>, access: Access) -> MethodRouter<Shared> {
        match access {
            Access::Probe => route,
            Access::Open => route.layer(from_fn_with_state(self.open_to_all(), pass)),
            Access::For(role, load) => {
                route.layer(from_fn_with_state((self.clone(), Some(role), load), pass))
            }
        }
    }

    /// Pages with the gate before them: they are open to anybody.
    pub(crate) fn before_pages(&self, pages: Router) -> Router {
        pages.layer(from_fn_with_state(self.open_to_all(), pass))
    }

    fn open_to_all(&self) -> Before {
        (self.clone(), None, Load::Work)
    }

    /// Who asks; fails for who is not known and should be, or asks too fast for what has a limit.
    fn caller(&self, needed: Option<Role>, request: &Request, load: Load) -> Result<Caller, HttpError> {
        let limited = load != Load::Watch;
        let (headers, extensions) = (request.headers(), request.extensions());
        let foreign = self.pages.are_foreign(request.uri(), headers);
        let by_address = |limited| {
            let (client, bounded) = address(extensions);
            sent_by(&client);
            self.addresses.iter().filter(|_| limited).try_for_each(|addresses| addresses.take(&client))?;
            Ok::<_, LimitError>((client, bounded))
        };
        let Some(keys) = self.keys.as_ref().filter(|_| needed.is_some()) else {
            let (client, bounded) = by_address(limited)?;
            let role = if self.keys.is_some() { Role::Read } else { Role::Admin };
            return Ok(Caller { client, role, bounded, foreign, pass: None });
        };
        let sent = headers.typed_get::<Authorization<Bearer>>();
        let Some(pass) = sent.and_then(|sent| keys.holder(sent.token())) else {
            // Who tries keys is limited everywhere.
            by_address(true)?;
            return Err(AccessError::Unauthorized.into());
        };
        let holder = &pass.holder;
        sent_by(&holder.name);
        holder.bucket.iter().filter(|_| limited).try_for_each(Bucket::take)?;
        let (client, role) = (holder.name.clone(), holder.role);
        Ok(Caller { client, role, bounded: true, foreign, pass: Some(pass) })
    }
}

/// A gate, the role that it asks for, and what stands behind it.
type Before = (Gate, Option<Role>, Load);

async fn pass(
    State((gate, needed, load)): State<Before>,
    mut request: Request,
    next: Next,
) -> Result<Response<Body>, HttpError> {
    gate.pages.check_host(request.uri(), request.headers())?;
    let caller = gate.caller(needed, &request, load)?;
    if caller.foreign && !request.method().is_safe() {
        return Err(AccessError::OtherOrigin.into());
    }
    needed.map_or(Ok(()), |needed| caller.must_be(needed))?;
    let place = gate.admission.enter(load, caller.sharer())?;
    request.extensions_mut().insert(caller.clone());
    request.extensions_mut().insert(Arc::clone(&place));
    let response = next.run(request).await;
    // Not kept until the answer is sent: who reads slowly would be in the way of all. Memory is counted instead.
    drop(place);
    let mut response = match load {
        Load::Watch => response,
        Load::Question | Load::Work => gate.admission.send(response, caller.sharer())?,
    };
    if gate.keys.is_some() && needed.is_some() {
        keep_from_others(response.headers_mut());
    }
    Ok(response)
}

/// A cache that many share must not answer who has no key.
fn keep_from_others(headers: &mut HeaderMap) {
    let shared = headers.get(CACHE_CONTROL).and_then(|value| value.to_str().ok()?.strip_prefix("public"));
    if let Some(value) = shared.and_then(|rest| HeaderValue::from_str(&format!("private{rest}")).ok()) {
        headers.insert(CACHE_CONTROL, value);
    }
}

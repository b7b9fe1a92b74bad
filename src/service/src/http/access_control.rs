//! What every request passes before its handler: host name, key, role, rate and the number of requests at once.

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

use crate::http::allowed_origins::AllowedOrigins;
use crate::http::client::{Client, peer};
use crate::http::error::{AccessError, HttpError};
use crate::http::request_log::record_client;
use crate::http::state::SharedState;
use crate::limits::admission::{Admission, RequestClass};
use crate::limits::error::LimitError;
use crate::limits::keys::Keys;
use crate::limits::keys_file::KeysFileError;
use crate::limits::rate::{AddressBuckets, Rate};
use crate::wire::role::Role;

/// Who may use a route of a service with keys, and how its requests are admitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Access {
    /// Anybody, without limits: probes.
    Probe,
    /// Anybody.
    Open,
    /// Keys with this role or a higher one.
    Key(Role, RequestClass),
}

/// Checks requests before their handlers.
#[derive(Clone)]
pub(crate) struct AccessControl {
    /// Without keys every client is an administrator.
    keys: Option<Arc<Keys>>,
    /// The rates of clients without a key.
    addresses: Option<AddressBuckets>,
    admission: Arc<Admission>,
    origins: Arc<AllowedOrigins>,
}

impl AccessControl {
    /// Admits every client, within the number of requests at once.
    pub(crate) fn admitting_all(admission: Arc<Admission>) -> Self {
        Self { keys: None, addresses: None, admission, origins: Arc::default() }
    }

    /// Reads the file of keys, if there is one.
    pub(crate) async fn open(
        keys: Option<PathBuf>,
        rate: Option<Rate>,
        origins: AllowedOrigins,
        admission: Arc<Admission>,
    ) -> Result<Self, KeysFileError> {
        let keys = match keys {
            Some(path) => Some(Keys::open(path, rate).await?),
            None => None,
        };
        Ok(Self { keys, addresses: rate.map(AddressBuckets::new), admission, origins: Arc::new(origins) })
    }

    /// Reads the keys again. On failure the previous keys stay in use.
    pub(crate) async fn reload(&self) -> Result<(), KeysFileError> {
        match &self.keys {
            Some(keys) => keys.reload().await,
            None => Ok(()),
        }
    }

    /// The route behind the checks, which also apply to methods that it does not have.
    pub(crate) fn guard(
        &self,
        route: MethodRouter<SharedState>,
        access: Access,
    ) -> MethodRouter<SharedState> {
        match access {
            Access::Probe => route,
            Access::Open => route.layer(from_fn_with_state(self.open_to_all(), check)),
            Access::Key(role, class) => {
                route.layer(from_fn_with_state((self.clone(), Some(role), class), check))
            }
        }
    }

    /// Pages behind the checks. They need no key.
    pub(crate) fn guard_pages(&self, pages: Router) -> Router {
        pages.layer(from_fn_with_state(self.open_to_all(), check))
    }

    fn open_to_all(&self) -> Check {
        (self.clone(), None, RequestClass::Other)
    }

    /// The client of a request. Fails if its key is invalid or its rate is exceeded.
    fn client(
        &self,
        role: Option<Role>,
        request: &Request,
        class: RequestClass,
    ) -> Result<Client, HttpError> {
        let has_rate = class != RequestClass::Monitoring;
        let (headers, extensions) = (request.headers(), request.extensions());
        let is_cross_origin = self.origins.is_cross_origin(request.uri(), headers);
        let by_address = |has_rate| {
            let (name, has_quota) = peer(extensions);
            record_client(&name);
            let bucket =
                self.addresses.as_ref().filter(|_| has_rate).map(|addresses| addresses.bucket(&name));
            bucket.iter().try_for_each(|bucket| bucket.take())?;
            Ok::<_, LimitError>((name, has_quota, bucket))
        };
        let Some(keys) = self.keys.as_ref().filter(|_| role.is_some()) else {
            let (name, has_quota, bucket) = by_address(has_rate)?;
            let role = if self.keys.is_some() { Role::Read } else { Role::Admin };
            return Ok(Client { name, role, has_quota, is_cross_origin, bucket, key: None });
        };
        let sent = headers.typed_get::<Authorization<Bearer>>();
        let Some(key) = sent.and_then(|sent| keys.accept(sent.token())) else {
            // A client that tries keys has a rate on every route.
            by_address(true)?;
            return Err(AccessError::Unauthorized.into());
        };
        let holder = &key.holder;
        record_client(&holder.name);
        let bucket = holder.bucket.clone().filter(|_| has_rate);
        bucket.iter().try_for_each(|bucket| bucket.take())?;
        let (name, role) = (holder.name.clone(), holder.role);
        Ok(Client { name, role, has_quota: true, is_cross_origin, bucket, key: Some(key) })
    }
}

/// The checks of a route, the role that it requires, and the class of its requests.
type Check = (AccessControl, Option<Role>, RequestClass);

async fn check(
    State((control, role, class)): State<Check>,
    mut request: Request,
    next: Next,
) -> Result<Response<Body>, HttpError> {
    control.origins.check_host(request.uri(), request.headers())?;
    let client = control.client(role, &request, class)?;
    if client.is_cross_origin && !request.method().is_safe() {
        return Err(AccessError::OtherOrigin.into());
    }
    role.map_or(Ok(()), |role| client.require(role))?;
    let permit = control.admission.admit(class, client.quota())?;
    request.extensions_mut().insert(client.clone());
    request.extensions_mut().insert(Arc::clone(&permit));
    let response = next.run(request).await;
    // A client that reads slowly must not keep the permit. The memory of its response is counted instead.
    drop(permit);
    let mut response = match class {
        RequestClass::Monitoring => response,
        RequestClass::Fast | RequestClass::Other => {
            control.admission.count_memory(response, client.quota())?
        }
    };
    if control.keys.is_some() && role.is_some() {
        forbid_shared_caches(response.headers_mut());
    }
    Ok(response)
}

/// Makes Cache-Control private: a shared cache must not answer clients without a key.
fn forbid_shared_caches(headers: &mut HeaderMap) {
    let shared = headers.get(CACHE_CONTROL).and_then(|value| value.to_str().ok()?.strip_prefix("public"));
    if let Some(value) = shared.and_then(|rest| HeaderValue::from_str(&format!("private{rest}")).ok()) {
        headers.insert(CACHE_CONTROL, value);
    }
}

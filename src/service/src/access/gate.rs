//! What every question passes on its way to its handler.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::CACHE_CONTROL;
use axum::http::{Extensions, HeaderMap, HeaderValue, Response};
use axum::middleware::{Next, from_fn_with_state};
use axum::routing::MethodRouter;
use headers::HeaderMapExt;
use headers::authorization::{Authorization, Bearer};

use super::caller::{Caller, address};
use super::keys::Keys;
use super::keys_file::BadKeys;
use super::rate::{Addresses, Bucket, Rate};
use super::role::Role;
use crate::admission::{Admission, Load};
use crate::config::ServeConfig;
use crate::error::Error;
use crate::state::Shared;

/// Who may use a route where the service has keys, and what it is to the service.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Access {
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
    /// Limits who has no key.
    addresses: Option<Addresses>,
    admission: Arc<Admission>,
}

impl Gate {
    /// For all, without a limit but that of places.
    pub(crate) fn for_all(admission: Arc<Admission>) -> Self {
        Self { keys: None, addresses: None, admission }
    }

    /// As the settings have it.
    pub(crate) async fn open(config: &ServeConfig, admission: Arc<Admission>) -> Result<Self, BadKeys> {
        let rate = Rate::new(config.rate, config.rate_burst);
        match &config.keys {
            Some(path) => {
                let keys = Some(Keys::open(path.clone(), rate).await?);
                Ok(Self { keys, ..Self::for_all(admission) })
            }
            None => Ok(Self { addresses: rate.map(Addresses::new), ..Self::for_all(admission) }),
        }
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
            Access::Open => route,
            Access::For(role, load) => route.layer(from_fn_with_state((self.clone(), role, load), pass)),
        }
    }

    /// Who asks; fails for who is not known, or asks too fast for what has a limit.
    fn caller(&self, headers: &HeaderMap, extensions: &Extensions, load: Load) -> Result<Caller, Error> {
        let limited = load != Load::Watch;
        let Some(keys) = &self.keys else {
            let client = address(extensions);
            self.addresses.iter().filter(|_| limited).try_for_each(|addresses| addresses.take(&client))?;
            return Ok(Caller { client, role: Role::Admin });
        };
        let sent = headers.typed_get::<Authorization<Bearer>>().ok_or(Error::Unauthorized)?;
        let holder = keys.holder(sent.token()).ok_or(Error::Unauthorized)?;
        holder.bucket.iter().filter(|_| limited).try_for_each(Bucket::take)?;
        Ok(Caller { client: holder.name.clone(), role: holder.role })
    }
}

async fn pass(
    State((gate, needed, load)): State<(Gate, Role, Load)>,
    mut request: Request,
    next: Next,
) -> Result<Response<axum::body::Body>, Error> {
    let caller = gate.caller(request.headers(), request.extensions(), load)?;
    caller.must_be(needed)?;
    let place = gate.admission.enter(load)?;
    request.extensions_mut().insert(caller);
    request.extensions_mut().insert(Arc::clone(&place));
    let mut response = next.run(request).await;
    drop(place);
    if gate.keys.is_some() {
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

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
use super::role::Role;
use crate::config::ServeConfig;
use crate::error::Error;
use crate::state::Shared;

/// Who may use a route, where the service has keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Access {
    /// Anybody.
    Open,
    /// Keys of this role, and of those above.
    For(Role),
}

/// Stands before the routes.
#[derive(Clone, Default)]
pub(crate) struct Gate {
    /// Without them everybody may everything.
    keys: Option<Arc<Keys>>,
}

impl Gate {
    /// As the settings have it.
    pub(crate) async fn open(config: &ServeConfig) -> Result<Self, BadKeys> {
        let keys = match &config.keys {
            Some(path) => Some(Keys::open(path.clone()).await?),
            None => None,
        };
        Ok(Self { keys })
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
            Access::For(role) => route.layer(from_fn_with_state((self.clone(), role), pass)),
        }
    }

    fn caller(&self, headers: &HeaderMap, extensions: &Extensions) -> Result<Caller, Error> {
        let Some(keys) = &self.keys else {
            return Ok(Caller { client: address(extensions), role: Role::Admin });
        };
        let sent = headers.typed_get::<Authorization<Bearer>>().ok_or(Error::Unauthorized)?;
        let holder = keys.holder(sent.token()).ok_or(Error::Unauthorized)?;
        Ok(Caller { client: holder.name.clone(), role: holder.role })
    }
}

async fn pass(
    State((gate, needed)): State<(Gate, Role)>,
    mut request: Request,
    next: Next,
) -> Result<Response<axum::body::Body>, Error> {
    let caller = gate.caller(request.headers(), request.extensions())?;
    caller.must_be(needed)?;
    request.extensions_mut().insert(caller);
    let mut response = next.run(request).await;
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

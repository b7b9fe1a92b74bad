//! Reads queries and bodies; every failure is an [`Error`].

use axum::body::{Bytes, to_bytes};
use axum::extract::{FromRequest, FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use http_body_util::LengthLimitError;
use serde::de::DeserializeOwned;
use tokio::sync::OwnedSemaphorePermit;
use verne_solver::workspace::Observer;

use crate::error::Error;
use crate::state::Shared;
use crate::wire::parse::{parse_body, parse_query};
use crate::workers::on_workers_while_waited_for;

/// Most bytes in the body of a single question: parsing it stays far below half a millisecond.
pub(crate) const SINGLE_BODY_BYTES: usize = 64 * 1024;

/// A query string as a typed request.
pub(crate) struct Params<T>(pub T);

impl<T: DeserializeOwned> FromRequestParts<Shared> for Params<T> {
    type Rejection = Error;

    async fn from_request_parts(parts: &mut Parts, _: &Shared) -> Result<Self, Error> {
        parse_query(parts.uri.query().unwrap_or_default()).map(Self)
    }
}

/// The JSON body of a single question.
pub(crate) struct Single<T>(pub T);

impl<T: DeserializeOwned> FromRequest<Shared> for Single<T> {
    type Rejection = Error;

    async fn from_request(request: Request, _: &Shared) -> Result<Self, Error> {
        parse_body(&json_bytes(request, SINGLE_BODY_BYTES).await?).map(Self)
    }
}

/// The JSON body of a batch, still to be parsed: that is work for the worker threads.
pub(crate) struct Batch {
    body: Bytes,
    share: OwnedSemaphorePermit,
}

impl Batch {
    /// The answer, from the worker threads. The batch counts as one until it is computed, whether anybody waits or not.
    pub(crate) async fn answer(
        self,
        work: impl FnOnce(&[u8], &dyn Observer) -> Result<Vec<u8>, Error> + Send + 'static,
    ) -> Result<Vec<u8>, Error> {
        let Self { body, share } = self;
        on_workers_while_waited_for(move |observer| {
            let answer = work(&body, observer);
            drop(share);
            answer
        })
        .await
    }
}

impl FromRequest<Shared> for Batch {
    type Rejection = Error;

    async fn from_request(request: Request, state: &Shared) -> Result<Self, Error> {
        let share = state.admission.batch()?;
        let body = json_bytes(request, state.limits.body_bytes).await?;
        Ok(Self { body, share })
    }
}

async fn json_bytes(request: Request, limit: usize) -> Result<Bytes, Error> {
    require_json(request.headers())?;
    to_bytes(request.into_body(), limit).await.map_err(|error| {
        let cause = error.into_inner();
        if cause.is::<LengthLimitError>() {
            Error::BodyTooLarge(limit)
        } else {
            Error::BodyLost(cause.to_string())
        }
    })
}

fn require_json(headers: &HeaderMap) -> Result<(), Error> {
    let Some(declared) = headers.get(header::CONTENT_TYPE) else { return Err(Error::NotJson(None)) };
    let declared = declared.to_str().unwrap_or_default();
    let essence = declared.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
    if essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json")) {
        return Ok(());
    }
    Err(Error::NotJson(Some(declared.to_owned())))
}

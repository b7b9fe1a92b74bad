//! Reads queries and bodies; every failure is an [`Error`].

use axum::body::{Body, Bytes, HttpBody, to_bytes};
use axum::extract::{FromRequest, FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use http_body_util::{BodyExt, LengthLimitError, Limited};
use serde::de::DeserializeOwned;
use utoipa::{IntoParams, ToSchema};
use verne_solver::workspace::Observer;

use crate::http::caller::Caller;
use crate::http::content_coding::Coding;
use crate::http::error::{HttpError, RequestError};
use crate::http::state::Shared;
use crate::limits::admission::Memory;
use crate::limits::client_quota::Share;
use crate::limits::response_memory::with_share;
use crate::operations::compute_pool::run_on_pool;
use crate::wire::error::OperationError;
use crate::wire::parse::parse_body;
use crate::wire::query_string::parse_query;

/// Most bytes in the body of a single question: parsing it stays far below half a millisecond.
pub(crate) const SINGLE_BODY_BYTES: usize = 64 * 1024;

/// A query string as a typed request.
pub(crate) struct Params<T>(pub T);

impl<T: DeserializeOwned + IntoParams> FromRequestParts<Shared> for Params<T> {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, _: &Shared) -> Result<Self, HttpError> {
        Ok(Self(parse_query(parts.uri.query().unwrap_or_default())?))
    }
}

/// The JSON body of a single question.
pub(crate) struct Single<T>(pub T);

impl<T: DeserializeOwned + ToSchema> FromRequest<Shared> for Single<T> {
    type Rejection = HttpError;

    async fn from_request(request: Request, _: &Shared) -> Result<Self, HttpError> {
        Ok(Self(parse_body(&json_bytes(request, SINGLE_BODY_BYTES).await?)?))
    }
}

/// The JSON body of a batch, still to be decoded and parsed: that is work for the worker threads.
pub(crate) struct Batch {
    body: Vec<u8>,
    coding: Option<Coding>,
    /// Most bytes of the decoded body.
    limit: usize,
    memory: Memory,
    share: Share,
}

impl Batch {
    /// The answer, from the worker threads. The batch counts as one until it is sent or given up, and at least until it is
    /// computed, whether anybody waits or not.
    pub(crate) async fn answer(
        self,
        work: impl FnOnce(&[u8], &dyn Observer) -> Result<Vec<u8>, OperationError> + Send + 'static,
    ) -> Result<Bytes, HttpError> {
        let Self { mut body, coding, limit, mut memory, share } = self;
        run_on_pool(move |observer| {
            if let Some(coding) = coding {
                let sent = body.len();
                body = coding.decode(&body, limit, |decoded| memory.hold(sent + decoded))?;
            }
            let answer = work(&body, observer);
            drop((body, memory));
            Ok(with_share(answer?, share))
        })
        .await
    }
}

impl FromRequest<Shared> for Batch {
    type Rejection = HttpError;

    async fn from_request(request: Request, state: &Shared) -> Result<Self, HttpError> {
        require_json(request.headers())?;
        let (coding, limit) = (Coding::of(request.headers())?, state.limits.body_bytes);
        let caller = request.extensions().get::<Caller>().cloned().ok_or(OperationError::Internal)?;
        let mut memory = state.admission.body(caller.sharer())?;
        let body = counted_bytes(request.into_body(), limit, &mut memory).await?;
        // Not before: who sends slowly would have the shares of all.
        let share = state.admission.batch(caller.sharer())?;
        Ok(Self { body, coding, limit, memory, share })
    }
}

async fn json_bytes(request: Request, limit: usize) -> Result<Bytes, HttpError> {
    require_json(request.headers())?;
    let coding = Coding::of(request.headers())?;
    require_within(request.body(), limit)?;
    let body =
        to_bytes(request.into_body(), limit).await.map_err(|error| lost(&*error.into_inner(), limit))?;
    match coding {
        Some(coding) => run_on_pool(move |_| coding.decode(&body, limit, |_| Ok(())).map(Bytes::from)).await,
        None => Ok(body),
    }
}

/// A body whose memory is counted as it comes.
async fn counted_bytes(body: Body, limit: usize, memory: &mut Memory) -> Result<Vec<u8>, HttpError> {
    require_within(&body, limit)?;
    let mut body = Limited::new(body, limit);
    let mut bytes = Vec::new();
    while let Some(frame) = body.frame().await {
        if let Ok(data) = frame.map_err(|error| lost(&*error, limit))?.into_data() {
            memory.hold(bytes.len() + data.len())?;
            bytes.extend_from_slice(&data);
        }
    }
    Ok(bytes)
}

/// Refuses a length that is declared and too large. The client is not asked for such a body by `100 Continue`.
fn require_within(body: &Body, limit: usize) -> Result<(), RequestError> {
    let declared = HttpBody::size_hint(body).lower();
    if usize::try_from(declared).is_ok_and(|bytes| bytes <= limit) {
        Ok(())
    } else {
        Err(RequestError::BodyTooLarge(limit))
    }
}

fn lost(cause: &(dyn std::error::Error + 'static), limit: usize) -> RequestError {
    if cause.is::<LengthLimitError>() {
        RequestError::BodyTooLarge(limit)
    } else {
        RequestError::UnreadableBody(cause.to_string())
    }
}

fn require_json(headers: &HeaderMap) -> Result<(), RequestError> {
    let Some(declared) = headers.get(header::CONTENT_TYPE) else { return Err(RequestError::NotJson(None)) };
    let declared = declared.to_str().unwrap_or_default();
    let essence = declared.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
    if essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json")) {
        return Ok(());
    }
    Err(RequestError::NotJson(Some(declared.to_owned())))
}

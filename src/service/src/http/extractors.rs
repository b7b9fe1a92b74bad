//! Extracts path parameters, query strings and bodies from requests. Each failure is an [`HttpError`].

use axum::BoxError;
use axum::body::{Body, Bytes, HttpBody};
use axum::extract::{FromRequest, FromRequestParts, Path, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use http_body_util::{BodyExt, LengthLimitError, Limited};
use serde::de::DeserializeOwned;
use utoipa::{IntoParams, ToSchema};
use verne_solver::workspace::Observer;

use crate::http::client::Client;
use crate::http::content_coding::Coding;
use crate::http::error::{HttpError, RequestError};
use crate::http::state::SharedState;
use crate::limits::admission::BodyMemory;
use crate::limits::client_quota::QuotaPermit;
use crate::limits::error::LimitError;
use crate::limits::response_memory::bytes_with_permit;
use crate::operations::compute_pool::run_on_pool;
use crate::wire::error::OperationError;
use crate::wire::parse::parse_body;
use crate::wire::query_string::parse_query;

/// Most bytes in the body of a request other than a batch. Such a body is parsed in far less than half a millisecond.
pub(crate) const JSON_BODY_BYTES: usize = 64 * 1024;

/// The only parameter of a path.
pub(crate) struct PathParameter(pub String);

impl<S: Send + Sync> FromRequestParts<S> for PathParameter {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, HttpError> {
        let path = Path::from_request_parts(parts, state).await;
        path.map(|Path(parameter)| Self(parameter)).map_err(|_| HttpError::UnknownPath)
    }
}

/// The parameters of a query string.
pub(crate) struct QueryString<T>(pub T);

impl<T: DeserializeOwned + IntoParams> FromRequestParts<SharedState> for QueryString<T> {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, _: &SharedState) -> Result<Self, HttpError> {
        Ok(Self(parse_query(parts.uri.query().unwrap_or_default())?))
    }
}

/// The JSON body of a request other than a batch.
pub(crate) struct JsonBody<T>(pub T);

impl<T: DeserializeOwned + ToSchema> FromRequest<SharedState> for JsonBody<T> {
    type Rejection = HttpError;

    async fn from_request(request: Request, _: &SharedState) -> Result<Self, HttpError> {
        let coding = coding_of_json(request.headers())?;
        let body = read(request.into_body(), JSON_BODY_BYTES, |_| Ok(())).await?;
        let body = match coding {
            Some(coding) => run_on_pool(move |_| coding.decode(&body, JSON_BODY_BYTES, |_| Ok(()))).await?,
            None => body,
        };
        Ok(Self(parse_body(&body)?))
    }
}

/// The JSON body of a batch, not yet decoded and parsed: this is work for the worker threads.
pub(crate) struct BatchBody {
    body: Vec<u8>,
    coding: Option<Coding>,
    /// Most bytes of the decoded body.
    limit: usize,
    memory: BodyMemory,
    permit: QuotaPermit,
}

impl BatchBody {
    /// Reads the body on the worker threads.
    pub(crate) async fn read<T: Send + 'static>(
        self,
        read: impl FnOnce(&[u8]) -> Result<T, OperationError> + Send + 'static,
    ) -> Result<T, HttpError> {
        let Self { body, coding, limit, mut memory, permit } = self;
        run_on_pool(move |_| {
            let body = decoded(body, coding, limit, &mut memory)?;
            let outcome = read(&body);
            drop((body, memory, permit));
            Ok(outcome?)
        })
        .await
    }

    /// Computes the answer on the worker threads. The batch keeps its permit until the answer is sent or dropped.
    pub(crate) async fn answer(
        self,
        compute: impl FnOnce(&[u8], &dyn Observer) -> Result<Vec<u8>, OperationError> + Send + 'static,
    ) -> Result<Bytes, HttpError> {
        let Self { body, coding, limit, mut memory, permit } = self;
        run_on_pool(move |observer| {
            let body = decoded(body, coding, limit, &mut memory)?;
            let answer = compute(&body, observer);
            drop((body, memory));
            Ok(bytes_with_permit(answer?, permit))
        })
        .await
    }
}

impl FromRequest<SharedState> for BatchBody {
    type Rejection = HttpError;

    async fn from_request(request: Request, state: &SharedState) -> Result<Self, HttpError> {
        let coding = coding_of_json(request.headers())?;
        Self::with_coding(coding, request, state).await
    }
}

impl BatchBody {
    /// A body of any media type.
    pub(crate) async fn of_any_media(request: Request, state: &SharedState) -> Result<Self, HttpError> {
        let coding = Coding::of(request.headers())?;
        Self::with_coding(coding, request, state).await
    }

    async fn with_coding(
        coding: Option<Coding>,
        request: Request,
        state: &SharedState,
    ) -> Result<Self, HttpError> {
        let limit = state.limits.body_bytes;
        let client = request.extensions().get::<Client>().cloned().ok_or(OperationError::Internal)?;
        let mut memory = state.admission.body(client.quota())?;
        let body = read(request.into_body(), limit, |bytes| memory.grow_to(bytes)).await?;
        // Not before the body is read: clients that send slowly would take all permits.
        let permit = state.admission.batches.take(client.quota())?;
        Ok(Self { body, coding, limit, memory, permit })
    }
}

/// The decoded body of a batch.
fn decoded(
    body: Vec<u8>,
    coding: Option<Coding>,
    limit: usize,
    memory: &mut BodyMemory,
) -> Result<Vec<u8>, HttpError> {
    let Some(coding) = coding else { return Ok(body) };
    let sent = body.len();
    coding.decode(&body, limit, |decoded| memory.grow_to(sent + decoded))
}

/// The content coding of a JSON body. Fails for other media types.
fn coding_of_json(headers: &HeaderMap) -> Result<Option<Coding>, RequestError> {
    let Some(declared) = headers.get(header::CONTENT_TYPE) else { return Err(RequestError::NotJson(None)) };
    let declared = declared.to_str().unwrap_or_default();
    if is_json(declared) {
        Coding::of(headers)
    } else {
        Err(RequestError::NotJson(Some(declared.to_owned())))
    }
}

/// Whether a media type is that of JSON.
pub(crate) fn is_json(media_type: &str) -> bool {
    let essence = media_type.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
    essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json"))
}

/// Reads a body of at most `limit` bytes. Calls `reserve` with the new length before the body grows.
async fn read(
    body: Body,
    limit: usize,
    mut reserve: impl FnMut(usize) -> Result<(), LimitError>,
) -> Result<Vec<u8>, HttpError> {
    // A declared length is checked before the client sends the body: it waits for `100 Continue`.
    let declared = HttpBody::size_hint(&body).lower();
    if !usize::try_from(declared).is_ok_and(|bytes| bytes <= limit) {
        return Err(RequestError::BodyTooLarge(limit).into());
    }
    let mut body = Limited::new(body, limit);
    let mut bytes = Vec::new();
    while let Some(frame) = body.frame().await {
        let frame = frame.map_err(|error| unreadable(&error, limit))?;
        if let Ok(data) = frame.into_data() {
            reserve(bytes.len() + data.len())?;
            bytes.extend_from_slice(&data);
        }
    }
    Ok(bytes)
}

/// Why a body of at most `limit` bytes cannot be read.
pub(crate) fn unreadable(error: &BoxError, limit: usize) -> RequestError {
    let is_too_large = error.is::<LengthLimitError>();
    if is_too_large {
        RequestError::BodyTooLarge(limit)
    } else {
        RequestError::UnreadableBody(error.to_string())
    }
}

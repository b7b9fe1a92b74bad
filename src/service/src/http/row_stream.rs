//! A batch with rows in columns: its answer is sent while further rows arrive.

mod worker;

use std::io;

use axum::body::{Body, Bytes};
use axum::extract::Request;
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderMap, HeaderName, HeaderValue};
use axum::response::{IntoResponse, Response};
use futures_util::{Stream, StreamExt, stream};
use serde_json::json;
use tokio::sync::mpsc;
use verne_rows::Format;

use crate::http::client::Client;
use crate::http::content_coding::Coding;
use crate::http::error::HttpError;
use crate::http::extractors::is_json;
use crate::http::negotiation::Accept;
use crate::http::problem::Problem;
use crate::http::read_ahead::ReadAhead;
use crate::http::row_stream::worker::{PIECE_BYTES, Worker};
use crate::http::state::SharedState;
use crate::limits::client_quota::QuotaPermit;
use crate::limits::rate::RowCharge;
use crate::limits::response_memory::UnsharedBytes;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::row_stream::{RowAnswer, RowStream};
use crate::wire::error::OperationError;
use crate::wire::row_format::RowFormat;

/// About the memory of an answer: a chunk of rows as columns and as text.
const ANSWER_BYTES: u64 = 8 * 1024 * 1024;

/// The hash of the machine, as in the answers in JSON.
const MACHINE_HASH: HeaderName = HeaderName::from_static("machine-hash");

/// The formats of the rows and of their answers. `None` for a JSON document.
pub(crate) fn formats(
    headers: &HeaderMap,
    stated: Option<RowFormat>,
    accept: &Accept,
) -> Result<Option<(Format, Format)>, HttpError> {
    let declared = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let stated_columns = stated.and_then(RowFormat::columns);
    if is_json(declared) {
        return match stated_columns {
            Some(_) => {
                Err(HttpError::field("/query/format", "must be json: a JSON body is answered in JSON"))
            }
            None => Ok(None),
        };
    }
    let Some(from) = Format::of_media(declared).or(stated_columns) else { return Ok(None) };
    let to = match (stated, stated_columns) {
        (_, Some(to)) => to,
        (Some(_), None) => {
            let detail =
                "must be arrow, csv or ndjson: rows in columns are not answered as one JSON document";
            return Err(HttpError::field("/query/format", detail));
        }
        (None, None) => {
            let others = Format::ALL.into_iter().filter(|format| *format != from);
            accept.choose([from].into_iter().chain(others).map(|format| (format.media(), format)))?
        }
    };
    Ok(Some((from, to)))
}

/// Refuses the parameters of rows in columns beside a JSON body.
pub(crate) fn refuse_parameters(request: &Request) -> Result<(), HttpError> {
    let query = request.uri().query().unwrap_or_default();
    let name = form_urlencoded::parse(query.as_bytes()).find(|(name, _)| name != "format");
    match name {
        Some((name, _)) => {
            let detail =
                format!("`{name}` belongs into the JSON body; only rows in columns have it in the query");
            Err(HttpError::field(format!("/query/{name}"), detail))
        }
        None => Ok(()),
    }
}

/// Answers the rows in the body. The response begins when the first rows are answered: until then an error is a problem
/// document.
pub(crate) async fn answer_rows(
    state: &SharedState,
    client: Client,
    request: Request,
    (from, to): (Format, Format),
    answer: Box<dyn RowAnswer>,
) -> Result<Response, HttpError> {
    let coding = Coding::of(request.headers())?;
    let memory = state.limits.body_bytes;
    let permits = state.admission.table(client.quota(), memory)?;
    let hash = HeaderValue::from_str(&answer.machine().id.hash).map_err(|_| OperationError::Internal)?;
    let worker = Worker::new(RowStream::new(answer, from, to, memory), coding, memory);
    let charge = RowCharge::new(client.bucket.clone(), state.limits.rows);
    let body = ReadAhead::new(request.into_body(), client, memory);
    let mut answering = Answering { body, worker: Some(worker), format: to, charge };
    let first = answering.next_piece().await?;
    let pieces = stream::iter(first.map(Ok)).chain(answering.rest(permits));
    let headers = [(CONTENT_TYPE, HeaderValue::from_static(to.media())), (MACHINE_HASH, hash)];
    let mut response = (headers, Body::from_stream(pieces)).into_response();
    response.extensions_mut().insert(UnsharedBytes(ANSWER_BYTES));
    Ok(response)
}

/// A batch that is being answered.
struct Answering {
    body: ReadAhead,
    /// `None` after an error.
    worker: Option<Worker>,
    format: Format,
    charge: RowCharge,
}

/// What the task that answers hands over: bytes, the last bytes or an error, or the end.
type Piece = Option<io::Result<Bytes>>;

impl Answering {
    /// The next bytes of the answer; `None` at its end.
    async fn next_piece(&mut self) -> Result<Option<Bytes>, HttpError> {
        loop {
            let mut worker = self.worker.take().ok_or(OperationError::Internal)?;
            let (piece, worker) = run_on_pool(move |observer| {
                let piece = worker.next(|stream| stream.next(observer))?;
                Ok::<_, HttpError>((piece, worker))
            })
            .await?;
            let worker = self.worker.insert(worker);
            if let Some(piece) = piece {
                self.charge.charge(worker.stream.take_rows()).await;
                return Ok(Some(piece.into()));
            }
            if worker.ended {
                return Ok(None);
            }
            let Some(bytes) = self.body.next().await else {
                worker.ended = true;
                continue;
            };
            worker.take(bytes?);
            while worker.arrived_bytes() < PIECE_BYTES
                && let Some(bytes) = self.body.next_arrived()
            {
                worker.take(bytes?);
            }
        }
    }

    /// The bytes of the answer after the first ones. While the client takes a piece, a task answers the next one. The
    /// permits end with the answer, or when the client gives up.
    fn rest(mut self, permits: [QuotaPermit; 2]) -> impl Stream<Item = io::Result<Bytes>> {
        let (sender, receiver) = mpsc::channel(1);
        drop(tokio::spawn(async move {
            loop {
                let piece = tokio::select! {
                    piece = self.next_piece() => piece,
                    () = sender.closed() => return,
                };
                let (piece, is_last): (Piece, bool) = match piece {
                    Ok(piece) => {
                        let is_last = piece.is_none();
                        (piece.map(Ok), is_last)
                    }
                    Err(error) => (Some(self.report(error)), true),
                };
                let sent = sender.send(piece).await;
                if is_last {
                    drop(sender.send(None).await);
                }
                if is_last || sent.is_err() {
                    return;
                }
            }
        }));
        stream::unfold(Some((receiver, permits)), |state| async move {
            let (mut receiver, permits): (mpsc::Receiver<Piece>, _) = state?;
            match receiver.recv().await {
                Some(Some(piece)) => Some((piece, Some((receiver, permits)))),
                Some(None) => None,
                // The task has ended before the answer: nobody may take it for complete.
                None => Some((Err(io::Error::other(HttpError::from(OperationError::Internal))), None)),
            }
        })
    }

    /// Reports an error after the first rows as far as the format has a place for it: in NDJSON as the last line.
    /// Otherwise the connection breaks off, so that nobody takes the answer for complete.
    fn report(&self, error: HttpError) -> io::Result<Bytes> {
        tracing::info!(%error, format = self.format.name(), "a batch ends early");
        match self.format {
            Format::Ndjson => Ok(format!("{}\n", json!({"error": Problem::from(error)})).into()),
            Format::Arrow | Format::Csv => Err(io::Error::other(error)),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

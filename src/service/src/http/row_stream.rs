//! A batch with rows in columns: its answer is sent while further rows arrive.

use std::io::{self, Write};

use axum::body::{Body, Bytes};
use axum::extract::Request;
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderMap, HeaderName, HeaderValue};
use axum::response::{IntoResponse, Response};
use futures_util::{StreamExt, stream};
use serde_json::json;
use verne_rows::Format;

use crate::http::client::Client;
use crate::http::content_coding::{Coding, Decoder};
use crate::http::error::{HttpError, RequestError};
use crate::http::extractors::is_json;
use crate::http::negotiation::Accept;
use crate::http::problem::Problem;
use crate::http::read_ahead::ReadAhead;
use crate::http::state::SharedState;
use crate::limits::client_quota::QuotaPermit;
use crate::limits::rate::RowCharge;
use crate::limits::response_memory::UnsharedBytes;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::row_stream::{RowAnswer, RowStream};
use crate::wire::error::OperationError;
use crate::wire::row_format::RowFormat;

/// Bytes of the body that are decoded at once, at most.
const PIECE_BYTES: usize = 256 * 1024;

/// Bytes that are decompressed at once: at best a thousand times as many result.
const COMPRESSED_BYTES: usize = 4 * 1024;

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
    let worker = Worker {
        stream: RowStream::new(answer, from, to, memory),
        decoder: Some(Decoder::new(coding, Decoded { bytes: Vec::new(), limit: memory })),
        encoded: Vec::new(),
        at: 0,
        step: if coding.is_some() { COMPRESSED_BYTES } else { PIECE_BYTES },
        ended: false,
    };
    let charge = RowCharge::new(client.bucket.clone(), state.limits.rows);
    let body = ReadAhead::new(request.into_body(), client, memory);
    let mut answering = Answering { body, worker: Some(worker), format: to, charge, _permits: permits };
    let first = answering.next_piece().await?;
    let rest = stream::unfold(Some(answering), |answering| async move {
        let mut answering = answering?;
        match answering.next_piece().await {
            Ok(piece) => piece.map(|piece| (Ok(piece), Some(answering))),
            Err(error) => Some((answering.report(error), None)),
        }
    });
    let pieces = stream::iter(first.map(Ok)).chain(rest);
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
    _permits: [QuotaPermit; 2],
}

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
            worker.encoded.extend_from_slice(&bytes?);
            while worker.encoded.len() < PIECE_BYTES
                && let Some(bytes) = self.body.next_arrived()
            {
                worker.encoded.extend_from_slice(&bytes?);
            }
        }
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

/// The part of a batch that the compute pool works on.
struct Worker {
    stream: RowStream,
    /// `None` after the last byte.
    decoder: Option<Decoder<Decoded>>,
    /// The bytes that have arrived.
    encoded: Vec<u8>,
    /// How many of them are decoded.
    at: usize,
    /// How many are decoded at once.
    step: usize,
    /// Whether no bytes follow.
    ended: bool,
}

impl Worker {
    /// What `next` returns for the bytes that have arrived; `None` if it needs more, or at the end.
    fn next(
        &mut self,
        mut next: impl FnMut(&mut RowStream) -> Result<Option<Vec<u8>>, OperationError>,
    ) -> Result<Option<Vec<u8>>, HttpError> {
        loop {
            if let Some(piece) = next(&mut self.stream)? {
                return Ok(Some(piece));
            }
            if let Some(decoder) = self.decoder.as_mut().filter(|_| self.at < self.encoded.len()) {
                let end = self.encoded.len().min(self.at + self.step);
                decoder.push(&self.encoded[self.at..end])?;
                self.at = end;
                let decoded = std::mem::take(&mut decoder.sink_mut().bytes);
                self.stream.push(&decoded);
                continue;
            }
            self.encoded.clear();
            self.at = 0;
            match self.decoder.take_if(|_| self.ended) {
                Some(decoder) => {
                    self.stream.push(&decoder.finish()?.bytes);
                    self.stream.end();
                }
                None => return Ok(None),
            }
        }
    }
}

/// Decoded bytes, until they are taken.
struct Decoded {
    bytes: Vec<u8>,
    limit: usize,
}

impl Write for Decoded {
    fn write(&mut self, decoded: &[u8]) -> io::Result<usize> {
        if self.bytes.len() + decoded.len() > self.limit {
            return Err(io::Error::other(HttpError::from(RequestError::BodyTooLarge(self.limit))));
        }
        self.bytes.extend_from_slice(decoded);
        Ok(decoded.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

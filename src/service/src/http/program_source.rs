//! The file of a program as a response. The store has it compressed with gzip; a client that does not accept gzip gets
//! it decoded while it is sent.

use std::io::{self, Write};

use axum::body::{Body, Bytes};
use axum::http::header::{ACCEPT_ENCODING, CONTENT_ENCODING, CONTENT_LENGTH};
use axum::http::{HeaderMap, HeaderValue};
use axum::response::{IntoResponse, Response};
use flate2::write::GzDecoder;
use futures_util::stream::BoxStream;
use futures_util::{Stream, StreamExt, stream};
use verne_program::Format;
use verne_store::ContentReader;

use crate::http::conditional_response::{Conditions, StreamedText, entity_tag};
use crate::http::error::HttpError;
use crate::http::negotiation::weighted;
use crate::limits::response_memory::UnsharedBytes;
use crate::operations::compute_pool::run_on_pool;
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// Compressed bytes that are decoded at once. They decode to four mebibytes at most.
const STEP_BYTES: usize = 4 * 1024;

/// A piece of the decoded file is sent when it has so many bytes.
const PIECE_BYTES: usize = 256 * 1024;

/// About the memory of a response that is decoded: a piece of the store, a piece of the file, the window.
const RESPONSE_BYTES: u64 = 2 * 1024 * 1024;

/// The response with the file of a program.
pub(crate) fn respond_source(
    id: ResultId,
    source: &ContentReader,
    format: Format,
    headers: &HeaderMap,
    conditions: &Conditions,
) -> Result<Response, HttpError> {
    let coding = accepts_gzip(headers).then_some("gzip");
    // The id identifies the file. Its compressed bytes also depend on the pieces in which it arrived.
    let hash = if coding.is_some() { source.hash() } else { blake3::Hash::from_bytes(*id.job().as_bytes()) };
    let text = StreamedText {
        etag: entity_tag(&hash, coding)?,
        vary: "accept-encoding",
        media: media_type(format),
        file_name: format!("program-{id:.8}.{}", format.name()),
    };
    let mut about = match text.begin(conditions) {
        Ok(about) => about,
        Err(unmodified) => return Ok(*unmodified),
    };
    let length = source.len();
    if let Some(coding) = coding {
        about.insert(CONTENT_ENCODING, HeaderValue::from_static(coding));
        about.insert(CONTENT_LENGTH, length.into());
        return Ok((about, Body::from_stream(source.stream(0..length))).into_response());
    }
    let mut response = (about, Body::from_stream(decoded(source))).into_response();
    response.extensions_mut().insert(UnsharedBytes(RESPONSE_BYTES));
    Ok(response)
}

fn media_type(format: Format) -> &'static str {
    match format {
        Format::Apt | Format::Gcode => "text/plain",
        Format::Csv => "text/csv",
        Format::Ndjson => "application/x-ndjson",
        Format::Arrow => "application/vnd.apache.arrow.stream",
    }
}

fn accepts_gzip(headers: &HeaderMap) -> bool {
    let of = |name: &str| weighted(headers, ACCEPT_ENCODING).find(|(coding, _)| coding == name);
    of("gzip").or_else(|| of("*")).is_some_and(|(_, weight)| weight > 0.0)
}

/// The file, in pieces that are decoded when the connection has room for them.
fn decoded(source: &ContentReader) -> impl Stream<Item = io::Result<Bytes>> + Send + use<> {
    let length = source.len();
    let compressed = source.stream(0..length).map(|piece| piece.map_err(io::Error::other)).boxed();
    let start = Decoding { compressed, pending: Bytes::new(), decoder: GzDecoder::new(Vec::new()) };
    stream::try_unfold(Some(start), |decoding| async {
        match decoding {
            Some(decoding) => decoding.next_piece().await,
            None => Ok(None),
        }
    })
}

struct Decoding {
    compressed: BoxStream<'static, io::Result<Bytes>>,
    /// What is left of a piece of the store.
    pending: Bytes,
    decoder: GzDecoder<Vec<u8>>,
}

impl Decoding {
    /// The next piece of the file, and what follows it.
    async fn next_piece(self) -> io::Result<Option<(Bytes, Option<Self>)>> {
        let Self { mut compressed, mut pending, mut decoder } = self;
        loop {
            if pending.is_empty() {
                match compressed.next().await {
                    Some(piece) => pending = piece?,
                    None => return Ok(Some((decoder.finish()?.into(), None))),
                }
            }
            let work = move || {
                while !pending.is_empty() && decoder.get_ref().len() < PIECE_BYTES {
                    decoder.write_all(&pending.split_to(pending.len().min(STEP_BYTES)))?;
                }
                decoder.flush()?;
                let piece = std::mem::take(decoder.get_mut());
                Ok::<_, io::Error>((piece, pending, decoder))
            };
            let outcome = run_on_pool(move |_| work().map_err(|_| OperationError::Internal)).await;
            let (piece, left, decoder_after) = outcome.map_err(io::Error::other)?;
            (pending, decoder) = (left, decoder_after);
            if !piece.is_empty() {
                return Ok(Some((piece.into(), Some(Self { compressed, pending, decoder }))));
            }
        }
    }
}

//! Receives the program in the body of a request. The reader gets the bytes as they arrive; the body is never in memory
//! as a whole.

use std::io::{self, Write};

use axum::body::{Body, HttpBody};
use axum::extract::{FromRequest, Request};
use axum::http::header::CONTENT_TYPE;
use http_body_util::{BodyExt, Limited};
use verne_program::{Format, ReadOptions};

use crate::http::client::Client;
use crate::http::content_coding::{Coding, Decoder};
use crate::http::error::{HttpError, RequestError};
use crate::http::extractors::unreadable;
use crate::http::state::SharedState;
use crate::limits::admission::ProgramMemory;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::programs::receiver::{ProgramReceiver, ReceivedProgram};
use crate::wire::error::OperationError;

/// Bytes of the body that are read at once. To read them takes longer than to pass them to another thread.
const PIECE_BYTES: usize = 256 * 1024;

/// A program in memory has two copies for a while: its moves, and the packed program that is stored.
const COPIES: usize = 2;

/// The program in the body of a request, of which nothing is read yet.
pub(crate) struct ProgramBody {
    body: Body,
    coding: Option<Coding>,
    media_type: Option<String>,
    /// Most bytes of the decoded body.
    limit: usize,
    memory: ProgramMemory,
}

/// A program, and the permit for its memory.
pub(crate) struct ProgramInMemory {
    /// The program.
    pub program: ReceivedProgram,
    /// Keep it as long as the program.
    pub memory: ProgramMemory,
}

impl FromRequest<SharedState> for ProgramBody {
    type Rejection = HttpError;

    async fn from_request(request: Request, state: &SharedState) -> Result<Self, HttpError> {
        let headers = request.headers();
        let coding = Coding::of(headers)?;
        let media_type = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).map(str::to_owned);
        let client = request.extensions().get::<Client>().ok_or(OperationError::Internal)?;
        let memory = state.admission.program(client.quota())?;
        let (limit, body) = (state.limits.program_bytes, request.into_body());
        // A declared length is checked before the client sends the body: it waits for `100 Continue`.
        let declared = HttpBody::size_hint(&body).lower();
        if !usize::try_from(declared).is_ok_and(|bytes| bytes <= limit) {
            return Err(RequestError::BodyTooLarge(limit).into());
        }
        Ok(Self { body, coding, media_type, limit, memory })
    }
}

impl ProgramBody {
    /// The media type of the body, if it is declared.
    pub(crate) fn media_type(&self) -> Option<&str> {
        self.media_type.as_deref()
    }

    /// Reads the program. The compute pool reads each piece when it has arrived, so that a client that sends slowly
    /// occupies no thread. Reading stops where the program is refused.
    pub(crate) async fn receive(
        self,
        format: Format,
        options: ReadOptions,
    ) -> Result<ProgramInMemory, HttpError> {
        let Self { body, coding, limit, memory, .. } = self;
        let receiver = Some(ProgramReceiver::new(format, &options));
        let mut decoder = Decoder::new(coding, Reception { receiver, memory, received: 0, limit });
        // Compressed data may decode to nothing at all: the encoded bytes have the limit, too.
        let mut body = Limited::new(body, limit);
        let mut piece = Vec::new();
        while let Some(frame) = body.frame().await {
            let frame = frame.map_err(|error| unreadable(&error, limit))?;
            piece.extend_from_slice(frame.data_ref().map(AsRef::as_ref).unwrap_or_default());
            if piece.len() >= PIECE_BYTES {
                let full = std::mem::take(&mut piece);
                decoder = run_on_pool(move |_| decoder.push(&full).map(|()| decoder)).await?;
            }
        }
        run_on_pool(move |_| {
            decoder.push(&piece)?;
            decoder.finish()?.finish()
        })
        .await
    }
}

/// Takes the decoded bytes.
struct Reception {
    /// None after the program is refused.
    receiver: Option<ProgramReceiver>,
    memory: ProgramMemory,
    received: usize,
    limit: usize,
}

impl Reception {
    fn take(&mut self, decoded: &[u8]) -> Result<(), HttpError> {
        let mut receiver = self.receiver.take().ok_or(OperationError::Internal)?;
        self.received += decoded.len();
        if self.received > self.limit {
            return Err(RequestError::BodyTooLarge(self.limit).into());
        }
        if receiver.push(decoded).is_break() {
            receiver.finish()?;
            return Err(OperationError::Internal.into());
        }
        self.memory.grow_to(COPIES * receiver.memory())?;
        self.receiver = Some(receiver);
        Ok(())
    }

    fn finish(self) -> Result<ProgramInMemory, HttpError> {
        let receiver = self.receiver.ok_or(OperationError::Internal)?;
        Ok(ProgramInMemory { program: receiver.finish()?, memory: self.memory })
    }
}

impl Write for Reception {
    fn write(&mut self, decoded: &[u8]) -> io::Result<usize> {
        self.take(decoded).map(|()| decoded.len()).map_err(io::Error::other)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

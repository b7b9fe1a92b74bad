//! The bytes of a batch that have arrived: decoding, and the answers to them.

use std::collections::VecDeque;
use std::io::{self, Write};

use axum::body::Bytes;

use crate::http::content_coding::{Coding, Decoder};
use crate::http::error::{HttpError, RequestError};
use crate::operations::row_stream::RowStream;
use crate::wire::error::OperationError;

/// Bytes of the body that are decoded at once, at most.
pub(super) const PIECE_BYTES: usize = 256 * 1024;

/// Bytes that are decompressed at once: at best a thousand times as many result.
const COMPRESSED_BYTES: usize = 4 * 1024;

/// The part of a batch that the compute pool works on.
pub(super) struct Worker {
    pub(super) stream: RowStream,
    /// `None` after the last byte.
    decoder: Option<Decoder<Decoded>>,
    /// The bytes that have arrived and are not decoded.
    arrived: VecDeque<Bytes>,
    arrived_bytes: usize,
    /// Whether they are compressed.
    is_encoded: bool,
    /// How many are decoded at once.
    step: usize,
    /// Whether no bytes follow.
    pub(super) ended: bool,
}

impl Worker {
    /// For a body with a coding; `memory` is the most bytes that decoding makes at once.
    pub(super) fn new(stream: RowStream, coding: Option<Coding>, memory: usize) -> Self {
        Self {
            stream,
            decoder: Some(Decoder::new(coding, Decoded { bytes: Vec::new(), limit: memory })),
            arrived: VecDeque::new(),
            arrived_bytes: 0,
            is_encoded: coding.is_some(),
            step: if coding.is_some() { COMPRESSED_BYTES } else { PIECE_BYTES },
            ended: false,
        }
    }

    /// How many bytes have arrived and are not decoded.
    pub(super) fn arrived_bytes(&self) -> usize {
        self.arrived_bytes
    }

    /// Takes bytes that have arrived.
    pub(super) fn take(&mut self, bytes: Bytes) {
        self.arrived_bytes += bytes.len();
        self.arrived.push_back(bytes);
    }

    /// At most this many of the next bytes that are not decoded.
    fn next_arrived(&mut self) -> Option<Bytes> {
        let mut bytes = self.arrived.pop_front()?;
        let piece = bytes.split_to(self.step.min(bytes.len()));
        if !bytes.is_empty() {
            self.arrived.push_front(bytes);
        }
        self.arrived_bytes -= piece.len();
        Some(piece)
    }

    /// What `next` returns for the bytes that have arrived; `None` if it needs more, or at the end.
    pub(super) fn next(
        &mut self,
        mut next: impl FnMut(&mut RowStream) -> Result<Option<Vec<u8>>, OperationError>,
    ) -> Result<Option<Vec<u8>>, HttpError> {
        loop {
            if let Some(piece) = next(&mut self.stream)? {
                return Ok(Some(piece));
            }
            if let Some(bytes) = self.next_arrived() {
                match &mut self.decoder {
                    Some(decoder) if self.is_encoded => {
                        decoder.push(&bytes)?;
                        let decoded = std::mem::take(&mut decoder.sink_mut().bytes);
                        self.stream.push(&decoded);
                    }
                    _ => self.stream.push(&bytes),
                }
                continue;
            }
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

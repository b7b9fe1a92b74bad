//! Reads a stored content on a thread that may block, piece by piece: the content is never in memory as a whole unless
//! it is there already.

use std::io::{self, BufRead, Read};
use std::pin::Pin;

use bytes::{Buf, Bytes};
use futures_util::{Stream, StreamExt};
use tokio::runtime::Handle;
use verne_store::{ContentReader, ReadError};

type Pieces = Pin<Box<dyn Stream<Item = Result<Bytes, ReadError>> + Send>>;

/// A reader of a content. The thread must not be one of the runtime's.
pub(crate) struct StoredReader {
    runtime: Handle,
    pieces: Pieces,
    piece: Bytes,
}

impl StoredReader {
    /// A reader at the beginning of a content.
    pub(crate) fn new(content: &ContentReader, runtime: Handle) -> Self {
        Self { runtime, pieces: Box::pin(content.stream(0..content.len())), piece: Bytes::new() }
    }
}

impl BufRead for StoredReader {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.piece.is_empty() {
            match self.runtime.block_on(self.pieces.next()) {
                Some(piece) => self.piece = piece.map_err(io::Error::other)?,
                None => break,
            }
        }
        Ok(&self.piece)
    }

    fn consume(&mut self, count: usize) {
        self.piece.advance(count.min(self.piece.len()));
    }
}

impl Read for StoredReader {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

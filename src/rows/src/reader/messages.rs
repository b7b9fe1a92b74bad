//! Splits the bytes of an Arrow stream into messages, so that their sizes are known before they are in memory.

use arrow_buffer::Buffer;
use arrow_ipc::{Message, MessageHeader, root_as_message};

use crate::error::ReadError;

/// Most bytes of a message's metadata, which describe at most a few hundred columns.
const METADATA_BYTES: usize = 1 << 20;

/// Stands before the length of the metadata.
const CONTINUATION: [u8; 4] = [0xFF; 4];

/// Arrays of an Arrow stream begin at multiples of eight bytes from the beginning of their message.
const ALIGNMENT: usize = 8;

/// Splits bytes into messages.
#[derive(Debug)]
pub(crate) struct Messages {
    bytes: Vec<u8>,
    /// The bytes that are read.
    at: usize,
    /// Most bytes of a message's body, and of all dictionaries together.
    limit: usize,
    dictionaries: usize,
    is_complete: bool,
}

impl Messages {
    pub(crate) fn new(limit: usize) -> Self {
        Self { bytes: Vec::new(), at: 0, limit, dictionaries: 0, is_complete: false }
    }

    pub(crate) fn push(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.at);
        self.at = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// The next message with its length and metadata. `None` if more bytes are needed, or at the end.
    pub(crate) fn next(&mut self, at_end: bool) -> Result<Option<Buffer>, ReadError> {
        let rest = &self.bytes[self.at..];
        if self.is_complete {
            return if rest.is_empty() { Ok(None) } else { Err(malformed("bytes follow its end")) };
        }
        let incomplete = || if at_end { Err(malformed("it ends within a message")) } else { Ok(None) };
        if rest.is_empty() {
            return Ok(None);
        }
        let Some(prefix) = Prefix::of(rest)? else { return incomplete() };
        if prefix.metadata == 0 {
            self.at += prefix.length;
            self.is_complete = true;
            return self.next(at_end);
        }
        let body_start = prefix.length + prefix.metadata;
        let Some(metadata) = rest.get(prefix.length..body_start) else { return incomplete() };
        let message = root_as_message(metadata)
            .map_err(|error| malformed(&format!("it has a bad message: {error}")))?;
        let body = usize::try_from(message.bodyLength()).map_err(|_| malformed("a message has no length"))?;
        if body > self.limit {
            return Err(self.too_large(body));
        }
        check_buffers(&message)?;
        let Some(whole) = rest.get(..body_start + body) else {
            let missing = body_start + body - rest.len();
            self.bytes.reserve_exact(missing);
            return incomplete();
        };
        if message.header_type() == MessageHeader::DictionaryBatch {
            self.dictionaries += body;
            if self.dictionaries > self.limit {
                let limit = self.limit;
                return Err(malformed(&format!("its dictionaries have more than {limit} bytes together")));
            }
        }
        let end = self.at + whole.len();
        if self.at.is_multiple_of(ALIGNMENT) && whole.len() > self.bytes.len() / 2 {
            // The arrays keep the bytes in which the message has arrived, and what follows is copied.
            let rest = self.bytes.split_off(end);
            let start = std::mem::take(&mut self.at);
            let message = Buffer::from_vec(std::mem::replace(&mut self.bytes, rest));
            return Ok(Some(message.slice(start)));
        }
        // A copy, so that the arrays of the message are aligned and keep no other message.
        let message = Buffer::from(whole);
        self.at = end;
        Ok(Some(message))
    }

    fn too_large(&self, bytes: usize) -> ReadError {
        let limit = self.limit;
        malformed(&format!(
            "a record batch has {bytes} bytes; the limit is {limit}. Write smaller batches, as \
             write_table(table, max_chunksize=65536) of pyarrow does"
        ))
    }
}

/// Checks that the buffers of a message are within its body.
fn check_buffers(message: &Message<'_>) -> Result<(), ReadError> {
    let batch = message.header_as_record_batch();
    let batch = batch.or_else(|| message.header_as_dictionary_batch()?.data());
    let buffers = batch.and_then(|batch| batch.buffers());
    let is_within = |offset: i64, length: i64| {
        offset >= 0
            && length >= 0
            && offset.checked_add(length).is_some_and(|end| end <= message.bodyLength())
    };
    if buffers.into_iter().flatten().all(|buffer| is_within(buffer.offset(), buffer.length())) {
        Ok(())
    } else {
        Err(malformed("a buffer lies outside its message"))
    }
}

pub(crate) fn malformed(detail: &str) -> ReadError {
    ReadError::Malformed(format!("the Arrow stream cannot be read: {detail}"))
}

/// What stands before the metadata of a message.
struct Prefix {
    length: usize,
    metadata: usize,
}

impl Prefix {
    /// Reads it; `None` if it is incomplete.
    fn of(bytes: &[u8]) -> Result<Option<Self>, ReadError> {
        if bytes.starts_with(b"ARROW1") {
            return Err(malformed("it is a file of Arrow (Feather); send the streaming format"));
        }
        let word = |start: usize| bytes.get(start..start + 4)?.try_into().ok();
        let (length, size): (usize, [u8; 4]) = match word(0) {
            // Streams before version 0.15 of Arrow have no continuation.
            Some(size) if size != CONTINUATION => (4, size),
            Some(_) => match word(4) {
                Some(size) => (8, size),
                None => return Ok(None),
            },
            None => return Ok(None),
        };
        let metadata = u32::from_le_bytes(size) as usize;
        if metadata > METADATA_BYTES {
            return Err(malformed("it begins with no message of Arrow, or its schema is too large"));
        }
        Ok(Some(Self { length, metadata }))
    }
}

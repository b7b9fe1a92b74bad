//! Lines of a source that arrives in chunks, in bounded memory.

use std::io::{self, BufRead};
use std::ops::ControlFlow;

use crate::builder::Builder;
use crate::error::ProgramError;

/// The longest line in bytes.
pub const LONGEST_LINE: usize = 64 << 10;

/// The mark that some editors put before UTF-8 text.
const UTF8_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Cuts chunks of bytes into numbered lines.
#[derive(Debug, Default)]
pub(crate) struct LineSplitter {
    /// The beginning of a line whose end has not arrived yet.
    pending: Vec<u8>,
    /// The number of lines that were complete.
    count: u32,
}

/// Reads the lines of one format.
pub(crate) trait LineReader: std::fmt::Debug + Send {
    /// Takes a line: its number from 1, and its bytes without the line break.
    fn line(&mut self, number: u32, line: &[u8]);
    /// Takes the end of the source. `terminated` says whether the last line had a line break.
    fn end(&mut self, terminated: bool);
    /// The program under construction.
    fn builder(&mut self) -> &mut Builder;
    /// The same, at the end.
    fn into_builder(self: Box<Self>) -> Builder;
}

impl LineSplitter {
    /// Takes a chunk and passes on each line that is complete.
    pub(crate) fn push(&mut self, mut chunk: &[u8], reader: &mut dyn LineReader) -> ControlFlow<()> {
        while let Some(length) = chunk.iter().position(|byte| *byte == b'\n') {
            let (line, rest) = (&chunk[..length], &chunk[length + 1..]);
            if self.pending.is_empty() {
                self.pass(line, reader)?;
            } else {
                self.extend(line, reader)?;
                let line = std::mem::take(&mut self.pending);
                self.pass(&line, reader)?;
                self.pending = line;
                self.pending.clear();
            }
            chunk = rest;
        }
        self.extend(chunk, reader)
    }

    /// Passes on what is left, and the end.
    pub(crate) fn finish(&mut self, reader: &mut dyn LineReader) {
        let last = std::mem::take(&mut self.pending);
        if last.is_empty() || self.pass(&last, reader).is_continue() {
            reader.end(last.is_empty());
        }
    }

    fn extend(&mut self, bytes: &[u8], reader: &mut dyn LineReader) -> ControlFlow<()> {
        let room = (LONGEST_LINE + 1).saturating_sub(self.pending.len());
        self.pending.extend_from_slice(&bytes[..bytes.len().min(room)]);
        if self.pending.len() > LONGEST_LINE {
            let line = std::mem::take(&mut self.pending);
            return self.pass(&line, reader);
        }
        ControlFlow::Continue(())
    }

    fn pass(&mut self, line: &[u8], reader: &mut dyn LineReader) -> ControlFlow<()> {
        let Some(number) = self.count.checked_add(1) else {
            return stopped(reader, self.count, "a program has fewer than 2^32 lines".to_owned());
        };
        self.count = number;
        if let Some(detail) = not_text(number, line) {
            return stopped(reader, number, detail.to_owned());
        }
        if line.len() > LONGEST_LINE {
            return stopped(reader, number, format!("the line is longer than {LONGEST_LINE} bytes"));
        }
        // DOS ends files with 0x1A.
        let line = line.strip_suffix(b"\x1A").unwrap_or(line);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        reader.line(number, if number == 1 { line.strip_prefix(UTF8_MARK).unwrap_or(line) } else { line });
        if reader.builder().diagnostics.is_stopped() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

fn stopped(reader: &mut dyn LineReader, line: u32, detail: String) -> ControlFlow<()> {
    reader.builder().diagnostics.stop(ProgramError { line, column: 1, word: String::new(), detail });
    ControlFlow::Break(())
}

/// The reason why a line is no line of a text in ASCII, UTF-8 or an 8-bit code page.
fn not_text(number: u32, line: &[u8]) -> Option<&'static str> {
    let blank = |byte: u8| matches!(byte, b'\t' | b'\r' | 0x0B | 0x0C | 0x1A);
    let known = |mark: &[u8]| number == 1 && line.starts_with(mark);
    if known(b"\xFF\xFE\0\0") || known(b"\0\0\xFE\xFF") {
        return Some(UTF_32);
    }
    if known(b"\xFF\xFE") || known(b"\xFE\xFF") {
        return Some(UTF_16);
    }
    if known(b"\x1F\x8B") || known(b"PK\x03\x04") {
        return Some("the file is compressed; send the program itself");
    }
    if line.iter().all(|byte| *byte >= b' ' || blank(*byte)) {
        return None;
    }
    Some(if is_wide::<4>(line) {
        UTF_32
    } else if is_wide::<2>(line) {
        UTF_16
    } else {
        "the file is binary; accepted is text in ASCII or UTF-8"
    })
}

const UTF_16: &str = "the file is UTF-16; save it as UTF-8";
const UTF_32: &str = "the file is UTF-32; save it as UTF-8";

/// Whether most groups of `WIDTH` bytes are a printable ASCII character beside zeros.
fn is_wide<const WIDTH: usize>(line: &[u8]) -> bool {
    let printable = |byte: u8| (b' '..0x7F).contains(&byte);
    let zero = |bytes: &[u8]| bytes.iter().all(|byte| *byte == 0);
    let wide = |group: &&[u8]| match group {
        [byte, rest @ ..] if *byte != 0 => printable(*byte) && zero(rest),
        [rest @ .., byte] => printable(*byte) && zero(rest),
        [] => false,
    };
    let groups = line.chunks_exact(WIDTH);
    line.len() > 3 && groups.clone().filter(wide).count() * 2 > groups.len()
}

/// The texts of some lines of a source, for a report: `numbers` are the lines from 1, in ascending order. A line that
/// does not exist is left out; of a long line the first 64 KiB are kept.
///
/// # Errors
///
/// The source cannot be read.
///
/// ```
/// let source = "one\ntwo\r\nthree".as_bytes();
/// assert_eq!(verne_program::line_texts(source, &[2, 3, 9])?, [(2, "two".into()), (3, "three".into())]);
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn line_texts(mut source: impl BufRead, numbers: &[u32]) -> io::Result<Vec<(u32, String)>> {
    let mut texts = Vec::new();
    let mut number = 1;
    let mut wanted = numbers.iter().copied().peekable();
    let mut text = Vec::new();
    while let Some(&next) = wanted.peek() {
        let chunk = source.fill_buf()?;
        let end = chunk.iter().position(|byte| *byte == b'\n');
        let length = end.unwrap_or(chunk.len());
        if number == next {
            let room = LONGEST_LINE.saturating_sub(text.len());
            text.extend_from_slice(&chunk[..length.min(room)]);
        }
        let at_end = chunk.is_empty();
        source.consume(length + usize::from(end.is_some()));
        if end.is_none() && !at_end {
            continue;
        }
        if number == next && !(at_end && text.is_empty()) {
            let line = text.strip_suffix(b"\r").unwrap_or(&text);
            texts.push((number, String::from_utf8_lossy(line).into_owned()));
            text.clear();
            while wanted.next_if_eq(&next).is_some() {}
        }
        if at_end {
            break;
        }
        number += 1;
    }
    Ok(texts)
}

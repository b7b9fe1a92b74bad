//! Rows through all formats: whole, in pieces of any size, and damaged.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod arrow_types;
mod damage;
mod faults;
mod round_trip;

use verne_rows::{Chunk, Column, Format, ReadError, Reader, Writer};

/// The columns of numbers in these tests.
const NUMBERS: &[&str] = &["x", "y"];

/// Greatest size of a message of Arrow in these tests.
const MESSAGE_BYTES: usize = 1 << 20;

/// Reads bytes in pieces of a size.
fn read_in_pieces(format: Format, bytes: &[u8], size: usize) -> Result<Vec<Chunk>, ReadError> {
    let mut reader = Reader::new(format, NUMBERS, MESSAGE_BYTES);
    let mut chunks = Vec::new();
    for piece in bytes.chunks(size.max(1)) {
        reader.push(piece);
        while let Some(chunk) = reader.next_chunk()? {
            chunks.push(chunk);
        }
    }
    reader.end();
    while let Some(chunk) = reader.next_chunk()? {
        chunks.push(chunk);
    }
    Ok(chunks)
}

fn read(format: Format, bytes: &[u8]) -> Result<Vec<Chunk>, ReadError> {
    read_in_pieces(format, bytes, bytes.len())
}

/// The numbers of a column in all chunks.
fn numbers(chunks: &[Chunk], name: &str) -> Vec<Option<f64>> {
    let of_chunk = |chunk: &Chunk| {
        let numbers = chunk.column(name).and_then(Column::as_numbers).unwrap();
        (0..chunk.rows()).map(|row| numbers.get(row)).collect::<Vec<_>>()
    };
    chunks.iter().flat_map(of_chunk).collect()
}

/// Chunks of rows with the same columns, as bytes.
fn write<'a>(format: Format, chunks: impl IntoIterator<Item = &'a [Column]>) -> Vec<u8> {
    let mut chunks = chunks.into_iter().peekable();
    let mut writer = Writer::new(format, chunks.peek().unwrap()).unwrap();
    let mut bytes: Vec<u8> = chunks.flat_map(|chunk| writer.write(chunk).unwrap()).collect();
    bytes.extend(writer.finish().unwrap());
    bytes
}

//! Arbitrary bytes as tables of every format.

use verne_rows::{Chunk, Column, Format, ReadError, Reader, Writer};

/// The columns of numbers.
const NUMBERS: &[&str] = &["x", "y", "z", "phi1", "phi2"];

/// Greatest size of a message of Arrow.
const MESSAGE_BYTES: usize = 1 << 20;

/// A stream of Arrow.
pub(crate) fn arrow(bytes: &[u8]) {
    check(Format::Arrow, bytes);
}

/// CSV.
pub(crate) fn csv(bytes: &[u8]) {
    check(Format::Csv, bytes);
}

/// NDJSON.
pub(crate) fn ndjson(bytes: &[u8]) {
    check(Format::Ndjson, bytes);
}

/// A table is the same in pieces, and what it passes on can be written and read again.
fn check(format: Format, bytes: &[u8]) {
    let size = bytes.first().map_or(1, |byte| usize::from(*byte) + 1);
    let whole = read(format, bytes, bytes.len().max(1));
    let in_pieces = read(format, bytes, size);
    let (whole, in_pieces) = match (whole, in_pieces) {
        (Ok(whole), Ok(in_pieces)) => (whole, in_pieces),
        (Err(one), Err(other)) => return assert_eq!(one, other),
        (one, other) => panic!("{:?} {:?}", one.map(drop), other.map(drop)),
    };
    assert_eq!(numbers(&whole), numbers(&in_pieces));
    for chunk in &whole {
        assert!(chunk.columns().iter().all(|column| column.len() == chunk.rows()));
        assert!(chunk.faults().is_sorted_by(|one, other| one.row < other.row));
        assert!(chunk.faults().iter().all(|fault| fault.row < chunk.rows() && !fault.detail.is_empty()));
    }
    for to in Format::ALL {
        let Some(written) = write(to, &whole) else { continue };
        // In CSV a name loses the blanks around it, and may then be another one's.
        if to == Format::Csv {
            continue;
        }
        let again = read(to, &written, written.len()).unwrap();
        // Text has no NaN and no infinity.
        if to == Format::Arrow {
            assert_eq!(numbers(&again), numbers(&whole));
        }
    }
}

fn read(format: Format, bytes: &[u8], size: usize) -> Result<Vec<Chunk>, ReadError> {
    let mut reader = Reader::new(format, NUMBERS, MESSAGE_BYTES);
    let mut chunks = Vec::new();
    for piece in bytes.chunks(size) {
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

/// The bits of all numbers, column by column.
fn numbers(chunks: &[Chunk]) -> Vec<Vec<Option<u64>>> {
    let of_column = |name: &&str| {
        let columns = chunks.iter().filter_map(|chunk| chunk.column(name));
        let numbers = columns.flat_map(|column| {
            let numbers = column.as_numbers().unwrap();
            (0..column.len()).map(|row| numbers.get(row).map(f64::to_bits)).collect::<Vec<_>>()
        });
        numbers.collect()
    };
    NUMBERS.iter().map(of_column).collect()
}

/// The table as bytes; nothing if it has no rows, or values for which the format has no text.
fn write(format: Format, chunks: &[Chunk]) -> Option<Vec<u8>> {
    let columns: &[Column] = chunks.first()?.columns();
    let mut writer = Writer::new(format, columns).ok()?;
    let mut bytes = Vec::new();
    for chunk in chunks {
        bytes.extend(writer.write(chunk.columns()).ok()?);
    }
    bytes.extend(writer.finish().unwrap());
    Some(bytes)
}

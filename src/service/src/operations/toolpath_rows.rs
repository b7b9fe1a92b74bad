//! The rows of a tool path in the store: blobs of equally many rows, each row of equally many bytes. So a reader finds
//! any row without reading those before it.

pub(crate) mod row_bytes;

use std::ops::Range;

use crate::operations::toolpath_rows::row_bytes::{ROW_BYTES, StoredRow, read_row, write_row};
use crate::wire::error::OperationError;

/// Rows in a chunk; the last one has fewer.
pub(crate) const ROWS_PER_CHUNK: u64 = 8192;

/// Bytes of a full chunk: about 1 MB.
#[expect(clippy::cast_possible_truncation, reason = "a constant far below 2^32")]
const CHUNK_BYTES: usize = ROWS_PER_CHUNK as usize * ROW_BYTES;

/// The name of the blob of a chunk, from 0.
pub(crate) fn chunk_name(chunk: u64) -> String {
    format!("rows-{chunk}")
}

/// The number of chunks of a tool path with so many rows.
pub(crate) fn chunk_count(rows: u64) -> u64 {
    rows.div_ceil(ROWS_PER_CHUNK)
}

/// Divides rows into chunks, and hands over each chunk when it is full.
pub(crate) struct RowWriter<F> {
    chunk: Vec<u8>,
    number: u64,
    put: F,
}

impl<F: FnMut(u64, Vec<u8>) -> Result<(), OperationError>> RowWriter<F> {
    /// A writer that hands its chunks to `put`, with their numbers.
    pub(crate) fn new(put: F) -> Self {
        Self { chunk: Vec::new(), number: 0, put }
    }

    /// Adds a row.
    pub(crate) fn push(&mut self, row: &StoredRow) -> Result<(), OperationError> {
        if self.chunk.capacity() == 0 {
            self.chunk.reserve_exact(CHUNK_BYTES);
        }
        write_row(row, &mut self.chunk);
        if self.chunk.len() < CHUNK_BYTES { Ok(()) } else { self.hand_over() }
    }

    /// Hands over the last chunk.
    pub(crate) fn finish(mut self) -> Result<(), OperationError> {
        if self.chunk.is_empty() { Ok(()) } else { self.hand_over() }
    }

    fn hand_over(&mut self) -> Result<(), OperationError> {
        let number = self.number;
        self.number += 1;
        let mut chunk = std::mem::take(&mut self.chunk);
        // The store counts the bytes of a chunk, not the room for more.
        chunk.shrink_to_fit();
        (self.put)(number, chunk)
    }
}

/// The rows of a chunk. A row that another version wrote is [`OperationError::OtherVersion`].
pub(crate) fn read_chunk(chunk: &[u8]) -> impl Iterator<Item = Result<StoredRow, OperationError>> {
    chunk.chunks(ROW_BYTES).map(|bytes| read_row(bytes).ok_or(OperationError::OtherVersion))
}

/// Some rows of a chunk, by their numbers in the chunk from 0.
pub(crate) fn rows_of_chunk(
    chunk: &[u8],
    rows: Range<u64>,
) -> impl Iterator<Item = Result<StoredRow, OperationError>> {
    let at = |row: u64| usize::try_from(row).map_or(chunk.len(), |row| row.saturating_mul(ROW_BYTES));
    let wanted = chunk.get(at(rows.start)..at(rows.end)).ok_or(OperationError::OtherVersion);
    let (missing, wanted) = wanted.map_or_else(|error| (Some(Err(error)), &[][..]), |rows| (None, rows));
    missing.into_iter().chain(read_chunk(wanted))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use verne_solver::toolpath::{RowKind, ToolPosition};
    use verne_solver::{Constraint, Element, Margin, TableAngles};

    use super::row_bytes::StoredRow;
    use super::{ROWS_PER_CHUNK, RowWriter, chunk_count, read_chunk};

    fn row(index: u32) -> StoredRow {
        let elements = [
            (Constraint::Stroke, Element::Stroke { slider: 2, high: true }),
            (Constraint::LegLength, Element::Leg(3)),
            (Constraint::SliderJoint, Element::Rod(31)),
            (Constraint::RodInterference, Element::Rods(11, 32)),
            (Constraint::Rotary, Element::Range { high: false }),
            (Constraint::ParallelSingularity, Element::Platform),
            (Constraint::TableClearance, Element::Tool),
            (Constraint::TableClearance, Element::Joint(21)),
        ];
        let (constraint, element) = elements[index as usize % elements.len()];
        let kinds = [RowKind::Rapid, RowKind::Feed, RowKind::Turn, RowKind::Retract, RowKind::Approach];
        let value = f64::from(index);
        StoredRow {
            line: index / 3,
            index,
            kind: kinds[index as usize % kinds.len()],
            position: ToolPosition { tip: [value, -value, 0.1], axis: [0.0, 0.6, 0.8] },
            rho: [value, 2.0, 3.0],
            table: TableAngles { theta1: 0.5, theta2: -value },
            duration: index.is_multiple_of(2).then_some(value / 7.0),
            margin: Margin { constraint, element, value: -value },
        }
    }

    #[test]
    fn chunks_return_the_rows_that_were_written() {
        let rows = u32::try_from(2 * ROWS_PER_CHUNK + 1).unwrap();
        let mut chunks = Vec::new();
        let mut writer = RowWriter::new(|number, chunk| {
            assert_eq!(number, chunks.len() as u64);
            chunks.push(chunk);
            Ok(())
        });
        for index in 0..rows {
            writer.push(&row(index)).unwrap();
        }
        writer.finish().unwrap();
        assert_eq!(chunks.len() as u64, chunk_count(u64::from(rows)));
        let read = chunks.iter().flat_map(|chunk| read_chunk(chunk));
        let read: Vec<StoredRow> = read.collect::<Result<_, _>>().unwrap();
        assert_eq!(read, (0..rows).map(row).collect::<Vec<_>>());
        // The first row of the second chunk is row ROWS_PER_CHUNK.
        let first = read_chunk(&chunks[1]).next().unwrap().unwrap();
        assert_eq!(u64::from(first.index), ROWS_PER_CHUNK);
    }

    #[test]
    fn bytes_that_are_no_rows_are_refused() {
        assert!(read_chunk(&[0; 7]).next().unwrap().is_err());
        assert!(read_chunk(&[255; 120]).next().unwrap().is_err());
    }
}

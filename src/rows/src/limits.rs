//! What bounds the memory of rows.

/// Most rows of a chunk.
pub const CHUNK_ROWS: usize = 8192;

/// Most columns.
pub const MOST_COLUMNS: usize = 256;

/// Most bytes of a row of text.
pub const LONGEST_ROW: usize = 64 << 10;

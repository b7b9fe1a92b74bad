//! Rows in columns with names: readers and writers of Arrow streams, CSV and NDJSON.
//!
//! A [`Reader`] takes bytes as they arrive and returns [`Chunk`]s of rows; a [`Writer`] makes bytes of chunks. Both
//! need memory for one chunk, and the reader of Arrow for one message, whatever the number of rows. The crate knows
//! names and types. It does not know machines, units or HTTP.
//!
//! The caller names the columns that are numbers. The others are *extra columns*: the reader keeps their values as they
//! are, so that a writer can pass them on.
//!
//! ```
//! use verne_rows::{Column, Format, Reader, Writer};
//!
//! let mut reader = Reader::new(Format::Csv, &["x", "y"], 1 << 20);
//! reader.push(b"id,y,x\nA,2,1\nB,,3\n");
//! reader.end();
//! let chunk = reader.next_chunk()?.ok_or("no rows")?;
//! let x = chunk.column("x").and_then(Column::as_numbers).ok_or("no x")?;
//! let y = chunk.column("y").and_then(Column::as_numbers).ok_or("no y")?;
//! assert_eq!((x.get(0), y.get(0)), (Some(1.0), Some(2.0)));
//! assert_eq!((x.get(1), y.get(1)), (Some(3.0), None));
//!
//! let columns = [chunk.column("id").ok_or("no id")?.clone(), Column::numbers("twice", [Some(2.0), None])];
//! let mut writer = Writer::new(Format::Ndjson, &columns)?;
//! let text = writer.write(&columns)?;
//! assert_eq!(text, b"{\"id\":\"A\",\"twice\":2.0}\n{\"id\":\"B\",\"twice\":null}\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cell;
mod chunk;
mod column;
mod error;
mod format;
mod header;
mod limits;
mod numbers;
mod reader;
mod source;
mod writer;

pub use chunk::{Chunk, RowFault};
pub use column::{Column, Names};
pub use error::{ReadError, WriteError};
pub use format::Format;
pub use limits::{CHUNK_ROWS, LONGEST_ROW, MOST_COLUMNS};
pub use numbers::Numbers;
pub use reader::Reader;
pub use writer::Writer;

//! Rows that a request has parsed already.

use crate::error::{ProgramError, ProgramErrors};
use crate::options::ReadOptions;
use crate::program::Program;
use crate::rows::row::Row;
use crate::rows::row_builder::{At, RowBuilder};

/// The program of some rows. The first row is line 1.
///
/// # Errors
///
/// The faults of the rows. `line` is the number of the row, `word` the name of the value at fault.
///
/// ```
/// use verne_program::{ReadOptions, Row, read_points};
///
/// let rows: Vec<Row> = serde_json::from_str("[[0, 0, 300, 0, 0, 1], [9, 0, 300, 0, 0, 0]]")?;
/// let refused = read_points(rows, &ReadOptions::default()).unwrap_err();
/// assert_eq!((refused.errors[0].line, refused.errors[0].word.as_str()), (2, "i"));
/// # Ok::<(), serde_json::Error>(())
/// ```
pub fn read_points(
    rows: impl IntoIterator<Item = Row>,
    options: &ReadOptions,
) -> Result<Program, ProgramErrors> {
    let mut builder = RowBuilder::new(options);
    for (line, row) in (1..=u32::MAX).zip(rows) {
        if let Err((at, detail)) = builder.row(line, &row) {
            let word = match at {
                At::Row => String::new(),
                At::Name(name) => name.to_owned(),
            };
            builder.builder.diagnostics.fault(ProgramError { line, column: 1, word, detail });
        }
        if builder.builder.diagnostics.is_stopped() {
            break;
        }
    }
    builder.builder.finish()
}

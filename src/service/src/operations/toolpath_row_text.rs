//! Writes the rows of a tool path as text, piece by piece.

use verne_solver::toolpath::ToolPosition;

use crate::operations::toolpath_rows::row_bytes::StoredRow;
use crate::wire::degrees::to_degrees;
use crate::wire::error::OperationError;
use crate::wire::limit::Limit;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath_row::{COLUMNS, RowFormat, RowObject};

/// About the bytes of a row as JSON.
const ROW_TEXT_BYTES: usize = 320;

/// Stored rows in their order, or why the next one cannot be read.
pub(crate) type StoredRows<'a> = dyn Iterator<Item = Result<StoredRow, OperationError>> + 'a;

/// Writes rows as text, piece by piece.
pub(crate) trait RowText: Send {
    /// The next rows. The first ones have what stands before all rows.
    fn rows(&mut self, rows: &mut StoredRows<'_>) -> Result<Vec<u8>, OperationError>;

    /// What is left after the last row.
    fn tail(self: Box<Self>) -> Result<Vec<u8>, OperationError>;
}

/// Writes rows in a format.
#[derive(Debug)]
pub(crate) struct RowTextWriter {
    format: RowFormat,
    /// What stands before the rows, until it is written.
    head: String,
    /// The number of the first row.
    first: u64,
    /// The number of the next row.
    next: u64,
}

impl RowTextWriter {
    /// A writer of the rows from this one on.
    pub(crate) fn new(id: ResultId, format: RowFormat, first: u64) -> Self {
        let head = match format {
            RowFormat::Csv => format!("{COLUMNS}\n"),
            RowFormat::Ndjson => String::new(),
            RowFormat::Json => format!("{{\"id\":\"{id}\",\"rows\":["),
        };
        Self { format, head, first, next: first }
    }
}

impl RowText for RowTextWriter {
    fn rows(&mut self, rows: &mut StoredRows<'_>) -> Result<Vec<u8>, OperationError> {
        let mut text = std::mem::take(&mut self.head);
        text.reserve(rows.size_hint().0 * ROW_TEXT_BYTES);
        for row in rows {
            let row = row_object(&row?);
            match self.format {
                RowFormat::Csv => {
                    row.write_csv(&mut text).map_err(|_| OperationError::Internal)?;
                    text.push('\n');
                }
                RowFormat::Ndjson => {
                    text += &json(&row)?;
                    text.push('\n');
                }
                RowFormat::Json => {
                    text.push_str(if self.next > self.first { ",\n" } else { "\n" });
                    text += &json(&row)?;
                }
            }
            self.next += 1;
        }
        Ok(text.into_bytes())
    }

    fn tail(self: Box<Self>) -> Result<Vec<u8>, OperationError> {
        let Self { format, head, first, next } = *self;
        let tail = match format {
            RowFormat::Csv | RowFormat::Ndjson => String::new(),
            RowFormat::Json => format!("\n],\"from\":{first},\"to\":{next}}}\n"),
        };
        Ok((head + &tail).into_bytes())
    }
}

fn json(row: &RowObject) -> Result<String, OperationError> {
    serde_json::to_string(row).map_err(|_| OperationError::Internal)
}

/// A row as it is sent: without -0, with angles in degrees.
fn row_object(row: &StoredRow) -> RowObject {
    let ToolPosition { tip, axis } = row.position;
    let [[x, y, z], [i, j, k], [rho1, rho2, rho3]] = [tip, axis, row.rho].map(|three| three.map(|n| n + 0.0));
    let [theta1, theta2] = [row.table.theta1, row.table.theta2].map(to_degrees);
    let Limit { constraint, value, element, .. } = row.margin.into();
    RowObject {
        line: row.line,
        kind: row.kind.into(),
        x,
        y,
        z,
        i,
        j,
        k,
        rho1,
        rho2,
        rho3,
        theta1,
        theta2,
        duration: row.duration,
        margin: value,
        constraint,
        element,
    }
}

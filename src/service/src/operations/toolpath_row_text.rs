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

/// Writes rows in a format.
#[derive(Debug)]
pub(crate) struct RowTextWriter {
    format: RowFormat,
    /// The number of the first row.
    first: u64,
    /// The number of the next row.
    next: u64,
}

impl RowTextWriter {
    /// A writer of the rows from this one on.
    pub(crate) fn new(format: RowFormat, first: u64) -> Self {
        Self { format, first, next: first }
    }

    /// What stands before the rows.
    pub(crate) fn head(&self, id: ResultId) -> String {
        match self.format {
            RowFormat::Csv => format!("{COLUMNS}\n"),
            RowFormat::Ndjson => String::new(),
            RowFormat::Json => format!("{{\"id\":\"{id}\",\"rows\":["),
        }
    }

    /// The next rows.
    pub(crate) fn rows(
        &mut self,
        rows: impl Iterator<Item = Result<StoredRow, OperationError>>,
    ) -> Result<String, OperationError> {
        let mut text = String::with_capacity(rows.size_hint().0 * ROW_TEXT_BYTES);
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
        Ok(text)
    }

    /// What stands after the rows.
    pub(crate) fn tail(&self) -> String {
        let Self { format, first, next } = self;
        match format {
            RowFormat::Csv | RowFormat::Ndjson => String::new(),
            RowFormat::Json => format!("\n],\"from\":{first},\"to\":{next}}}\n"),
        }
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

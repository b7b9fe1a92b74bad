//! The points of an error map as a table: a row for each point inside the workspace.

use std::ops::Range;

use verne_rows::{Column, Format, Writer};

use crate::operations::outcome_columns::defect;
use crate::wire::error::OperationError;
use crate::wire::error_map::ErrorCells;

/// Rows that are written at once.
const ROWS: usize = 8192;

/// Writes the table, piece by piece.
pub(crate) struct ErrorTable {
    cells: ErrorCells,
    writer: Option<Writer>,
    /// The next row.
    next: usize,
}

impl ErrorTable {
    /// A table of the stored points. Call it on the compute pool.
    pub(crate) fn new(stored: &[u8], format: Format) -> Result<Self, OperationError> {
        let cells: ErrorCells = serde_json::from_slice(stored).map_err(|error| {
            tracing::error!(%error, "the points of an error map are damaged");
            OperationError::Internal
        })?;
        let writer = Writer::new(format, &columns(&cells, 0..0)).map_err(defect)?;
        Ok(Self { cells, writer: Some(writer), next: 0 })
    }

    /// The next bytes; `None` at the end. Call it on the compute pool.
    pub(crate) fn next(&mut self) -> Result<Option<Vec<u8>>, OperationError> {
        let Some(writer) = &mut self.writer else { return Ok(None) };
        let rows = self.next..self.cells.points.len().min(self.next + ROWS);
        if rows.is_empty() {
            let rest = self.writer.take().map(Writer::finish).transpose().map_err(defect)?;
            return Ok(rest.filter(|bytes| !bytes.is_empty()));
        }
        self.next = rows.end;
        writer.write(&columns(&self.cells, rows)).map(Some).map_err(defect)
    }
}

fn columns(cells: &ErrorCells, rows: Range<usize>) -> Vec<Column> {
    let points = cells.points.get(rows.clone()).unwrap_or_default();
    let coordinate =
        |axis: usize| points.iter().map(move |point| Some(cells.grid.position(*point as usize)[axis]));
    let mut columns = vec![Column::whole_numbers("point", points.iter().map(|point| Some(*point)))];
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        columns.push(Column::numbers(name, coordinate(axis)));
    }
    let errors = &cells.errors;
    let of_errors = [
        ("tip_rms", &errors.tip_rms),
        ("tip_worst", &errors.tip_worst),
        ("axis_rms", &errors.axis_rms),
        ("axis_worst", &errors.axis_worst),
    ];
    for (name, values) in of_errors {
        columns.push(Column::numbers(name, rows.clone().map(|row| values.get(row).copied())));
    }
    columns
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::json;
    use verne_rows::Format;

    use super::ErrorTable;

    #[test]
    fn every_point_inside_is_a_row() {
        let cells = json!({
            "id": "0".repeat(64),
            "grid": {"origin": [10.0, 0.0, 300.0], "step": 5.0, "counts": [2, 1, 2], "turn": 0.0},
            "points": [1, 2],
            "tip_rms": [0.01, 0.02], "tip_worst": [0.03, 0.04],
            "axis_rms": [0.001, 0.002], "axis_worst": [0.003, 0.004],
        });
        let mut table = ErrorTable::new(cells.to_string().as_bytes(), Format::Csv).unwrap();
        let text = String::from_utf8(table.next().unwrap().unwrap()).unwrap();
        assert!(table.next().unwrap().is_none());
        let expected = "point,x,y,z,tip_rms,tip_worst,axis_rms,axis_worst\n\
                        1,10,0,305,0.01,0.03,0.001,0.003\n2,15,0,300,0.02,0.04,0.002,0.004\n";
        assert_eq!(text, expected);
    }
}

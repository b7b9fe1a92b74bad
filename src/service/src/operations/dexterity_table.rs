//! The points of a dexterity map as a table: a row for each interval of phi1.

use verne_rows::{Column, Format, Writer};

use crate::operations::outcome_columns::defect;
use crate::wire::dexterity::DexterityCells;
use crate::wire::error::OperationError;

/// Rows that are written at once.
const ROWS: usize = 8192;

/// Writes the table, piece by piece.
pub(crate) struct DexterityTable {
    cells: DexterityCells,
    writer: Option<Writer>,
    /// The next point.
    point: usize,
    /// The next interval.
    interval: usize,
}

/// An interval at a point.
struct Row {
    point: usize,
    position: [f64; 3],
    ends: [f64; 2],
}

impl DexterityTable {
    /// A table of the stored points. Call it on the compute pool.
    pub(crate) fn new(stored: &[u8], format: Format) -> Result<Self, OperationError> {
        let cells = serde_json::from_slice(stored).map_err(|error| {
            tracing::error!(%error, "the points of a dexterity map are damaged");
            OperationError::Internal
        })?;
        let writer = Writer::new(format, &columns(&[])).map_err(defect)?;
        Ok(Self { cells, writer: Some(writer), point: 0, interval: 0 })
    }

    /// The next bytes; `None` at the end. Call it on the compute pool.
    pub(crate) fn next(&mut self) -> Result<Option<Vec<u8>>, OperationError> {
        let Some(writer) = &mut self.writer else { return Ok(None) };
        let mut rows = Vec::new();
        while rows.len() < ROWS
            && let Some(ends) = self.cells.intervals.get(2 * self.interval..2 * self.interval + 2)
        {
            // The last point whose intervals begin here or before.
            let begins = |point: usize| self.cells.offsets.get(point).map(|offset| *offset as usize);
            while begins(self.point + 1).is_some_and(|begin| begin <= self.interval) {
                self.point += 1;
            }
            let position = self.cells.grid.position(self.point);
            rows.push(Row { point: self.point, position, ends: [ends[0], ends[1]] });
            self.interval += 1;
        }
        if rows.is_empty() {
            let rest = self.writer.take().map(Writer::finish).transpose().map_err(defect)?;
            return Ok(rest.filter(|bytes| !bytes.is_empty()));
        }
        writer.write(&columns(&rows)).map(Some).map_err(defect)
    }
}

fn columns(rows: &[Row]) -> Vec<Column> {
    let number =
        |name, number: fn(&Row) -> f64| Column::numbers(name, rows.iter().map(|row| Some(number(row))));
    vec![
        Column::whole_numbers("point", rows.iter().map(|row| u32::try_from(row.point).ok())),
        number("x", |row| row.position[0]),
        number("y", |row| row.position[1]),
        number("z", |row| row.position[2]),
        number("from", |row| row.ends[0]),
        number("to", |row| row.ends[1]),
    ]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::json;
    use verne_rows::Format;

    use super::DexterityTable;

    #[test]
    fn every_interval_is_a_row_at_its_point() {
        let cells = json!({
            "id": "0".repeat(64),
            "grid": {"origin": [10.0, 0.0, 300.0], "step": 5.0, "counts": [2, 1, 2], "turn": 90.0},
            "offsets": [0, 0, 2, 2, 3],
            "intervals": [-20.0, -5.0, 5.0, 20.0, -1.0, 1.0],
        });
        let mut table = DexterityTable::new(cells.to_string().as_bytes(), Format::Csv).unwrap();
        let text = String::from_utf8(table.next().unwrap().unwrap()).unwrap();
        assert!(table.next().unwrap().is_none());
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|text| text.parse().unwrap()).collect())
            .collect();
        assert!(text.starts_with("point,x,y,z,from,to\n") && rows.len() == 3, "{text}");
        for (row, expected) in rows.iter().zip([
            [1.0, 0.0, 10.0, 305.0, -20.0, -5.0],
            [1.0, 0.0, 10.0, 305.0, 5.0, 20.0],
            [3.0, 0.0, 15.0, 305.0, -1.0, 1.0],
        ]) {
            assert!(
                row.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12),
                "{text}"
            );
        }
    }
}

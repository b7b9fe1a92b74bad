//! Writes the rows of a tool path as bytes, piece by piece.

use verne_rows::{Column, Names, Writer};
use verne_solver::toolpath::ToolPosition;

use crate::operations::outcome_columns::{LimitColumns, defect};
use crate::operations::toolpath_rows::row_bytes::StoredRow;
use crate::wire::degrees::to_degrees;
use crate::wire::error::OperationError;
use crate::wire::limit::Limit;
use crate::wire::result_id::ResultId;
use crate::wire::row_format::RowFormat;
use crate::wire::toolpath_row::{RowKindName, RowObject};

/// About the bytes of a row as JSON.
const ROW_TEXT_BYTES: usize = 320;

/// Stored rows in their order, or why the next one cannot be read.
pub(crate) type StoredRows<'a> = dyn Iterator<Item = Result<StoredRow, OperationError>> + 'a;

/// Writes rows as bytes, piece by piece.
pub(crate) trait RowText: Send {
    /// The next rows. The first ones have what stands before all rows.
    fn rows(&mut self, rows: &mut StoredRows<'_>) -> Result<Vec<u8>, OperationError>;

    /// What is left after the last row.
    fn tail(self: Box<Self>) -> Result<Vec<u8>, OperationError>;
}

/// Writes rows in a format.
pub(crate) enum RowWriter {
    /// In columns.
    Columns(Writer, RowColumns),
    /// As one document.
    Document(DocumentWriter),
}

impl RowWriter {
    /// A writer of the rows from this one on.
    pub(crate) fn new(id: ResultId, format: RowFormat, first: u64) -> Result<Self, OperationError> {
        let Some(format) = format.columns() else {
            return Ok(Self::Document(DocumentWriter::new(id, first)));
        };
        let columns = RowColumns::new()?;
        let writer = Writer::new(format, &columns.of(&[])?).map_err(defect)?;
        Ok(Self::Columns(writer, columns))
    }
}

impl RowText for RowWriter {
    fn rows(&mut self, rows: &mut StoredRows<'_>) -> Result<Vec<u8>, OperationError> {
        match self {
            Self::Columns(writer, columns) => {
                let rows = rows.map(|row| row.map(|row| row_object(&row))).collect::<Result<Vec<_>, _>>()?;
                writer.write(&columns.of(&rows)?).map_err(defect)
            }
            Self::Document(writer) => writer.rows(rows),
        }
    }

    fn tail(self: Box<Self>) -> Result<Vec<u8>, OperationError> {
        match *self {
            Self::Columns(writer, _) => writer.finish().map_err(defect),
            Self::Document(writer) => Ok(writer.tail()),
        }
    }
}

/// The name of a column of numbers, and its number in a row.
type NumberColumn = (&'static str, fn(&RowObject) -> f64);

/// The words of the columns, which all pieces of an answer share.
pub(crate) struct RowColumns {
    kinds: Names,
    limits: LimitColumns,
}

impl RowColumns {
    fn new() -> Result<Self, OperationError> {
        let kinds = Names::new(&RowKindName::ALL.map(RowKindName::name)).map_err(defect)?;
        Ok(Self { kinds, limits: LimitColumns::new()? })
    }

    /// The columns of some rows.
    fn of(&self, rows: &[RowObject]) -> Result<Vec<Column>, OperationError> {
        let kinds = rows.iter().map(|row| i8::try_from(row.kind as usize).ok());
        let mut columns = vec![
            Column::whole_numbers("line", rows.iter().map(|row| Some(row.line))),
            Column::names("kind", &self.kinds, kinds).map_err(defect)?,
        ];
        let numbers: [NumberColumn; 11] = [
            ("x", |row| row.x),
            ("y", |row| row.y),
            ("z", |row| row.z),
            ("i", |row| row.i),
            ("j", |row| row.j),
            ("k", |row| row.k),
            ("rho1", |row| row.rho1),
            ("rho2", |row| row.rho2),
            ("rho3", |row| row.rho3),
            ("theta1", |row| row.theta1),
            ("theta2", |row| row.theta2),
        ];
        for (name, number) in numbers {
            columns.push(Column::numbers(name, rows.iter().map(|row| Some(number(row)))));
        }
        columns.push(Column::numbers("duration", rows.iter().map(|row| row.duration)));
        let limits = rows.iter().map(|row| Some((row.constraint, row.margin, row.element)));
        let [constraint, margin, element] = self.limits.of_limits(limits.collect::<Vec<_>>().into_iter())?;
        columns.extend([margin, constraint, element]);
        Ok(columns)
    }
}

/// Writes rows as one document of JSON.
pub(crate) struct DocumentWriter {
    /// What stands before the rows, until it is written.
    head: String,
    /// The number of the first row.
    first: u64,
    /// The number of the next row.
    next: u64,
}

impl DocumentWriter {
    fn new(id: ResultId, first: u64) -> Self {
        Self { head: format!("{{\"id\":\"{id}\",\"rows\":["), first, next: first }
    }

    fn rows(&mut self, rows: &mut StoredRows<'_>) -> Result<Vec<u8>, OperationError> {
        let mut text = std::mem::take(&mut self.head);
        text.reserve(rows.size_hint().0 * ROW_TEXT_BYTES);
        for row in rows {
            text.push_str(if self.next > self.first { ",\n" } else { "\n" });
            text += &serde_json::to_string(&row_object(&row?)).map_err(|_| OperationError::Internal)?;
            self.next += 1;
        }
        Ok(text.into_bytes())
    }

    fn tail(self) -> Vec<u8> {
        let Self { head, first, next } = self;
        format!("{head}\n],\"from\":{first},\"to\":{next}}}\n").into_bytes()
    }
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

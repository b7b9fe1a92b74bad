//! The rows of a batch whose numbers come in columns with names.

use arrayvec::ArrayVec;
use verne_rows::{Chunk, Column, Numbers, RowFault};

use crate::operations::batch_rows::{BatchRow, ROW_WITH_AXIS, RowFormat, fault_of};
use crate::wire::batch::Row;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::{is_angle, is_length};

/// The names of the columns that make a row.
pub(crate) type RowNames = Vec<&'static str>;

/// Columns that stand together: all of them or none.
pub(crate) type Group = &'static [&'static str];

/// The columns of a row: those that every row has, and those of one of the groups.
///
/// # Errors
///
/// A column is missing, or there are several groups.
pub(crate) fn row_names(
    columns: &[Column],
    required: Group,
    groups: &[Group],
    needs_group: bool,
) -> Result<RowNames, OperationError> {
    let has = |name: &str| columns.iter().any(|column| column.name() == name);
    let mut given = groups.iter().filter(|group| group.iter().any(|name| has(name)));
    let (group, other) = (given.next().copied(), given.next());
    let names: RowNames = required.iter().chain(group.into_iter().flatten()).copied().collect();
    let absent = names.iter().filter(|name| !has(name));
    let mut faults: Vec<_> = absent.map(|name| FieldError::missing(pointer(name), name)).collect();
    let first = groups.first().and_then(|group| group.first()).filter(|_| needs_group && group.is_none());
    if let Some(first) = first {
        let accepted: Vec<_> = groups.iter().map(|group| group.join(", ")).collect();
        let detail = format!("`{first}` is missing; expected are {}", accepted.join(", or "));
        faults.push(FieldError::new(pointer(first), detail));
    }
    if let (Some(group), Some(name)) = (group, other.and_then(|other| other.iter().find(|name| has(name)))) {
        faults.push(FieldError::new(pointer(name), format!("cannot stand beside {}", group.join(", "))));
    }
    if faults.is_empty() { Ok(names) } else { Err(OperationError::Fields(faults)) }
}

/// Fails if there is a column of these names; `reason` says why it cannot be used.
pub(crate) fn refuse(columns: &[Column], names: &[&str], reason: &str) -> Result<(), OperationError> {
    let refused = columns.iter().filter(|column| names.contains(&column.name()));
    let faults: Vec<_> = refused.map(|column| FieldError::new(pointer(column.name()), reason)).collect();
    if faults.is_empty() { Ok(()) } else { Err(OperationError::Fields(faults)) }
}

/// The pointer to a column.
pub(crate) fn pointer(name: &str) -> String {
    let mut pointer = "/columns".to_owned();
    crate::wire::json_pointer::push_segment(&mut pointer, name);
    pointer
}

/// The numbers of some rows.
pub(crate) struct RowColumns<'a> {
    names: &'a [&'static str],
    numbers: ArrayVec<Numbers<'a>, ROW_WITH_AXIS>,
    faults: &'a [RowFault],
    rows: usize,
}

impl<'a> RowColumns<'a> {
    /// The columns of these names.
    pub(crate) fn of(chunk: &'a Chunk, names: &'a [&'static str]) -> Result<Self, OperationError> {
        let numbers = names.iter().map(|name| chunk.column(name).and_then(Column::as_numbers));
        let numbers = numbers.collect::<Option<_>>().ok_or(OperationError::Internal)?;
        Ok(Self { names, numbers, faults: chunk.faults(), rows: chunk.rows() })
    }

    /// The rows.
    pub(crate) fn rows(&self) -> Vec<ColumnRow<'_>> {
        (0..self.rows).map(|row| ColumnRow { columns: self, row }).collect()
    }
}

/// A row.
pub(crate) struct ColumnRow<'a> {
    columns: &'a RowColumns<'a>,
    row: usize,
}

impl BatchRow for ColumnRow<'_> {
    fn numbers(&self, _: RowFormat) -> Result<Row, String> {
        self.usual().map_or_else(|| self.examined(), Ok)
    }
}

impl ColumnRow<'_> {
    /// The numbers of a row without a fault. `None` for other rows.
    fn usual(&self) -> Option<Row> {
        let RowColumns { names, numbers, faults, .. } = self.columns;
        if !faults.is_empty() || names.len() == ROW_WITH_AXIS {
            return None;
        }
        let mut row = Row::new();
        for (i, numbers) in numbers.iter().enumerate() {
            let number = numbers.get(self.row)?;
            if !(if i < 3 { is_length(number) } else { is_angle(number) }) {
                return None;
            }
            row.push(number);
        }
        Some(row)
    }

    /// The numbers, or why they cannot be used.
    fn examined(&self) -> Result<Row, String> {
        let RowColumns { names, numbers, faults, .. } = self.columns;
        if let Ok(fault) = faults.binary_search_by_key(&self.row, |fault| fault.row) {
            return Err(faults[fault].detail.clone());
        }
        let mut row = Row::new();
        for (i, (name, numbers)) in names.iter().zip(numbers).enumerate() {
            let number = numbers.get(self.row).filter(|number| !number.is_nan());
            let number = number.ok_or_else(|| format!("{name} is not a number"))?;
            if let Some(fault) = fault_of(i, number, names.len() == ROW_WITH_AXIS) {
                return Err(format!("{name} {fault}"));
            }
            row.push(number);
        }
        Ok(row)
    }
}

//! The Jacobians of rows as columns of a table.

use verne_rows::Column;

use crate::operations::jacobians::{RowJacobian, RowJacobians};
use crate::wire::jacobian::JacobianColumns;

/// The columns of the greatest speeds.
const SPEEDS: [&str; 3] = ["speed_x", "speed_y", "speed_z"];

impl RowJacobians {
    /// The columns `det_p` and `condition_number`, with drives `speed_x`, `speed_y` and `speed_z`, and on request the
    /// entries of the matrix, `j11` to `j55`: row and column.
    pub(crate) fn columns_of(&self, rows: &[Option<&RowJacobian>]) -> Vec<Column> {
        let numbers = |name: &str, number: &dyn Fn(&RowJacobian) -> Option<f64>| {
            Column::numbers(name, rows.iter().map(|row| row.and_then(number)))
        };
        let mut columns = vec![
            numbers("det_p", &|row| Some(row.det_p)),
            numbers("condition_number", &|row| row.condition_number),
        ];
        if self.has_drives {
            let speeds = SPEEDS.iter().enumerate();
            columns.extend(speeds.map(|(i, name)| numbers(name, &|row| Some(row.greatest_speeds?[i]))));
        }
        if self.columns == JacobianColumns::Matrix {
            for i in 0..5 {
                for j in 0..5 {
                    let name = format!("j{}{}", i + 1, j + 1);
                    columns.push(numbers(&name, &|row| Some(row.matrix?.0[i].0[j])));
                }
            }
        }
        columns
    }
}

//! Columns of numbers: double precision from any numeric type.

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, Float64Array};
use arrow_schema::DataType;

/// The values of a column of numbers.
#[derive(Clone, Copy, Debug)]
pub struct Numbers<'a>(pub(crate) &'a Float64Array);

impl<'a> Numbers<'a> {
    /// The number of a row, which may be a NaN; `None` where the row has none.
    ///
    /// # Panics
    ///
    /// The column has fewer rows.
    #[inline]
    pub fn get(&self, row: usize) -> Option<f64> {
        self.0.is_valid(row).then(|| self.0.value(row))
    }

    /// The numbers of all rows, if every row has one; each may be a NaN.
    ///
    /// ```
    /// use verne_rows::Column;
    ///
    /// let complete = Column::numbers("x", [Some(1.0), Some(2.0)]);
    /// assert_eq!(complete.as_numbers().and_then(|numbers| numbers.all()), Some(&[1.0, 2.0][..]));
    /// let incomplete = Column::numbers("x", [Some(1.0), None]);
    /// assert_eq!(incomplete.as_numbers().and_then(|numbers| numbers.all()), None);
    /// ```
    pub fn all(&self) -> Option<&'a [f64]> {
        (self.0.null_count() == 0).then(|| &self.0.values()[..])
    }
}

/// The numbers in double precision; `None` for a column that has none. Integers beyond 2^53 are rounded.
pub(crate) fn to_numbers(values: &ArrayRef) -> Option<ArrayRef> {
    macro_rules! widened {
        ($kind:ty, $convert:expr) => {
            Arc::new(values.as_primitive::<$kind>().unary::<_, Float64Type>($convert))
        };
    }
    Some(match values.data_type() {
        DataType::Float64 => Arc::clone(values),
        DataType::Float32 => widened!(Float32Type, f64::from),
        DataType::Float16 => widened!(Float16Type, f64::from),
        DataType::Int8 => widened!(Int8Type, f64::from),
        DataType::Int16 => widened!(Int16Type, f64::from),
        DataType::Int32 => widened!(Int32Type, f64::from),
        DataType::Int64 => widened!(Int64Type, rounded_i64),
        DataType::UInt8 => widened!(UInt8Type, f64::from),
        DataType::UInt16 => widened!(UInt16Type, f64::from),
        DataType::UInt32 => widened!(UInt32Type, f64::from),
        DataType::UInt64 => widened!(UInt64Type, rounded_u64),
        _ => return None,
    })
}

#[expect(clippy::cast_precision_loss, reason = "documented: the nearest number")]
fn rounded_i64(value: i64) -> f64 {
    value as f64
}

#[expect(clippy::cast_precision_loss, reason = "documented: the nearest number")]
fn rounded_u64(value: u64) -> f64 {
    value as f64
}

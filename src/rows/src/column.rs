//! A column: its name and its values.

use std::borrow::Cow;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int8Type};
use arrow_array::{
    Array, ArrayRef, BooleanArray, DictionaryArray, Float64Array, Int8Array, StringArray, UInt32Array,
};
use arrow_buffer::NullBuffer;
use arrow_schema::{Field, FieldRef};

use crate::error::WriteError;
use crate::numbers::Numbers;

/// A column.
///
/// ```
/// use verne_rows::{Column, Names};
///
/// let status = Names::new(&["ok", "unreachable"])?;
/// let column = Column::names("status", &status, [Some(1), None, Some(0)])?;
/// assert_eq!((column.name(), column.len()), ("status", 3));
/// # Ok::<(), verne_rows::WriteError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Column {
    pub(crate) field: FieldRef,
    pub(crate) values: ArrayRef,
    /// Whether the values are texts of JSON.
    pub(crate) is_json: bool,
}

/// The words of which a column has one in each row.
#[derive(Clone, Debug)]
pub struct Names(ArrayRef);

impl Names {
    /// At most 128 words.
    ///
    /// # Errors
    ///
    /// There are more.
    pub fn new<T: AsRef<str>>(words: &[T]) -> Result<Self, WriteError> {
        if words.len() > 128 {
            return Err(WriteError::Columns("a column has at most 128 names".to_owned()));
        }
        Ok(Self(Arc::new(StringArray::from_iter_values(words.iter().map(AsRef::as_ref)))))
    }
}

impl Column {
    pub(crate) fn new(name: &str, values: ArrayRef) -> Self {
        let field = Field::new(name, values.data_type().clone(), true);
        Self { field: Arc::new(field), values, is_json: false }
    }

    /// Numbers in double precision.
    pub fn numbers(name: &str, values: impl IntoIterator<Item = Option<f64>>) -> Self {
        Self::new(name, Arc::new(values.into_iter().collect::<Float64Array>()))
    }

    /// Numbers in double precision. A row has none where `has_number` is false.
    ///
    /// ```
    /// let column = verne_rows::Column::numbers_where("x", vec![1.0, 0.0], &[true, false])?;
    /// let numbers = column.as_numbers().ok_or("no numbers")?;
    /// assert_eq!((numbers.get(0), numbers.get(1)), (Some(1.0), None));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The lengths differ.
    pub fn numbers_where(name: &str, numbers: Vec<f64>, has_number: &[bool]) -> Result<Self, WriteError> {
        let values = Float64Array::try_new(numbers.into(), nulls(has_number.iter().copied()))?;
        Ok(Self::new(name, Arc::new(values)))
    }

    /// Whole numbers.
    pub fn whole_numbers(name: &str, values: impl IntoIterator<Item = Option<u32>>) -> Self {
        Self::new(name, Arc::new(values.into_iter().collect::<UInt32Array>()))
    }

    /// True or false.
    pub fn flags(name: &str, values: impl IntoIterator<Item = Option<bool>>) -> Self {
        Self::new(name, Arc::new(values.into_iter().collect::<BooleanArray>()))
    }

    /// Texts.
    pub fn texts<T: AsRef<str>>(name: &str, values: impl IntoIterator<Item = Option<T>>) -> Self {
        Self::new(name, Arc::new(values.into_iter().collect::<StringArray>()))
    }

    /// One of the names in each row, by its index: a dictionary column of Arrow.
    ///
    /// # Errors
    ///
    /// An index has no name.
    pub fn names(
        name: &str,
        names: &Names,
        values: impl IntoIterator<Item = Option<i8>>,
    ) -> Result<Self, WriteError> {
        let keys = values.into_iter().collect::<Int8Array>();
        let values = DictionaryArray::<Int8Type>::try_new(keys, Arc::clone(&names.0))?;
        Ok(Self::new(name, Arc::new(values)))
    }

    /// The same from the index of each row; a row with a negative index has no name.
    ///
    /// # Errors
    ///
    /// An index has no name.
    pub fn names_by_code(name: &str, names: &Names, codes: Vec<i8>) -> Result<Self, WriteError> {
        let nulls = nulls(codes.iter().map(|code| *code >= 0));
        let keys = Int8Array::try_new(codes.into(), nulls)?;
        let values = DictionaryArray::<Int8Type>::try_new(keys, Arc::clone(&names.0))?;
        Ok(Self::new(name, Arc::new(values)))
    }

    /// Texts of a few rows, each with its row, in ascending order; the other rows have none.
    ///
    /// ```
    /// let column = verne_rows::Column::few_texts("detail", 3, &[(1, "late")]);
    /// assert_eq!(column.as_texts(), Some(vec![None, Some("late"), None]));
    /// ```
    pub fn few_texts<T: AsRef<str>>(name: &str, rows: usize, texts: &[(usize, T)]) -> Self {
        if texts.is_empty() {
            return Self::new(name, Arc::new(StringArray::new_null(rows)));
        }
        let mut texts = texts.iter().peekable();
        Self::texts(name, (0..rows).map(|row| texts.next_if(|(at, _)| *at == row).map(|(_, text)| text)))
    }

    /// Values of JSON, each as its text.
    pub(crate) fn json(name: &str, values: StringArray) -> Self {
        Self { is_json: true, ..Self::new(name, Arc::new(values)) }
    }

    /// The values for a format that has no values of JSON: each as its text, a text without its quotes.
    pub(crate) fn plain_values(&self) -> ArrayRef {
        let Some(texts) = self.values.as_string_opt::<i32>().filter(|_| self.is_json) else {
            return Arc::clone(&self.values);
        };
        Arc::new(texts.iter().map(|json| json.map(json_text)).collect::<StringArray>())
    }

    /// The name.
    pub fn name(&self) -> &str {
        self.field.name()
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The numbers, if it is a column of numbers in double precision.
    pub fn as_numbers(&self) -> Option<Numbers<'_>> {
        self.values.as_primitive_opt::<Float64Type>().map(Numbers)
    }

    /// The text of each row, if it is a column of texts; `None` where the row has none.
    ///
    /// ```
    /// let column = verne_rows::Column::texts("kind", [Some("feed"), None]);
    /// assert_eq!(column.as_texts(), Some(vec![Some("feed"), None]));
    /// ```
    pub fn as_texts(&self) -> Option<Vec<Option<&str>>> {
        if let Some(texts) = self.values.as_string_opt::<i32>() {
            return Some(texts.iter().collect());
        }
        if let Some(texts) = self.values.as_string_opt::<i64>() {
            return Some(texts.iter().collect());
        }
        let dictionary = self.values.as_any_dictionary_opt()?;
        let words = dictionary.values().as_string_opt::<i32>()?;
        if words.is_empty() {
            return Some(vec![None; self.len()]);
        }
        let keys = dictionary.normalized_keys().into_iter().enumerate();
        let has_word = |row, key| dictionary.is_valid(row) && words.is_valid(key);
        Some(keys.map(|(row, key)| has_word(row, key).then(|| words.value(key))).collect())
    }

    /// The rows from `start` on.
    pub(crate) fn slice(&self, start: usize, length: usize) -> Self {
        Self {
            field: Arc::clone(&self.field),
            values: self.values.slice(start, length),
            is_json: self.is_json,
        }
    }
}

/// Which rows have no value; `None` if all have one.
fn nulls(has_value: impl ExactSizeIterator<Item = bool>) -> Option<NullBuffer> {
    Some(NullBuffer::new(has_value.collect())).filter(|nulls| nulls.null_count() > 0)
}

/// The text of a value of JSON.
pub(crate) fn json_text(json: &str) -> Cow<'_, str> {
    serde_json::from_str::<String>(json).map_or(Cow::Borrowed(json), Cow::Owned)
}

//! The values of a column as text.

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, PrimitiveArray};
use arrow_schema::DataType;
use serde::Serialize;

use crate::column::{Column, json_text};
use crate::error::WriteError;

/// How values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// Numbers without a zero fraction, texts in quotes where they need them, nothing for a missing value.
    Csv,
    /// Values of JSON.
    Json,
}

/// Writes the value of a row.
type Cell<'a> = Box<dyn Fn(usize, &mut Vec<u8>) + 'a>;

/// The writer of a column's values. It writes a missing value, too.
///
/// # Errors
///
/// [`WriteError::NoText`]: there is no text for the type.
pub(crate) fn cells(column: &Column, style: Style) -> Result<Cell<'_>, WriteError> {
    let values = &column.values;
    let write = if column.is_json { Some(json_texts(values, style)) } else { typed(values, style) };
    let no_text =
        || WriteError::NoText { name: column.name().to_owned(), kind: values.data_type().to_string() };
    let write = write.ok_or_else(no_text)?;
    let Some(nulls) = values.logical_nulls() else { return Ok(write) };
    let missing: &[u8] = match style {
        Style::Csv => b"",
        Style::Json => b"null",
    };
    Ok(Box::new(
        move |row, out| {
            if nulls.is_null(row) { out.extend_from_slice(missing) } else { write(row, out) }
        },
    ))
}

fn typed(values: &ArrayRef, style: Style) -> Option<Cell<'_>> {
    Some(match values.data_type() {
        DataType::Float64 => primitive::<Float64Type>(values, move |value, out| {
            write_number(value, value.is_finite(), style, out);
        }),
        DataType::Float32 => primitive::<Float32Type>(values, move |value, out| {
            write_number(value, value.is_finite(), style, out);
        }),
        DataType::Float16 => primitive::<Float16Type>(values, move |value, out| {
            let value = value.to_f32();
            write_number(value, value.is_finite(), style, out);
        }),
        DataType::Int8 => primitive::<Int8Type>(values, write_json),
        DataType::Int16 => primitive::<Int16Type>(values, write_json),
        DataType::Int32 => primitive::<Int32Type>(values, write_json),
        DataType::Int64 => primitive::<Int64Type>(values, write_json),
        DataType::UInt8 => primitive::<UInt8Type>(values, write_json),
        DataType::UInt16 => primitive::<UInt16Type>(values, write_json),
        DataType::UInt32 => primitive::<UInt32Type>(values, write_json),
        DataType::UInt64 => primitive::<UInt64Type>(values, write_json),
        DataType::Boolean => {
            let flags = values.as_boolean();
            Box::new(move |row, out| write_json(flags.value(row), out))
        }
        DataType::Utf8 => {
            let texts = values.as_string::<i32>();
            Box::new(move |row, out| write_text(texts.value(row), style, out))
        }
        DataType::LargeUtf8 => {
            let texts = values.as_string::<i64>();
            Box::new(move |row, out| write_text(texts.value(row), style, out))
        }
        DataType::Utf8View => {
            let texts = values.as_string_view();
            Box::new(move |row, out| write_text(texts.value(row), style, out))
        }
        DataType::Dictionary(..) => return words(values, style),
        _ => return None,
    })
}

fn primitive<'a, T: ArrowPrimitiveType>(
    values: &'a ArrayRef,
    write: impl Fn(T::Native, &mut Vec<u8>) + 'a,
) -> Cell<'a> {
    let values: &PrimitiveArray<T> = values.as_primitive();
    Box::new(move |row, out| write(values.value(row), out))
}

/// The values of a dictionary column.
fn words(values: &ArrayRef, style: Style) -> Option<Cell<'_>> {
    let dictionary = values.as_any_dictionary();
    let write = typed(dictionary.values(), style)?;
    if dictionary.values().is_empty() {
        // Then every value is missing.
        return Some(write);
    }
    let keys = dictionary.normalized_keys();
    Some(Box::new(move |row, out| write(keys[row], out)))
}

/// Values of JSON; in CSV a text stands for itself.
fn json_texts(values: &ArrayRef, style: Style) -> Cell<'_> {
    let texts = values.as_string::<i32>();
    Box::new(move |row, out| {
        let json = texts.value(row);
        if style == Style::Json {
            out.extend_from_slice(json.as_bytes());
        } else {
            write_text(&json_text(json), style, out);
        }
    })
}

/// Writes the shortest decimal number that is read as this one. JSON has no text for numbers that are not finite.
fn write_number(value: impl Serialize, is_finite: bool, style: Style, out: &mut Vec<u8>) {
    if !is_finite {
        if style == Style::Json {
            out.extend_from_slice(b"null");
        }
        return;
    }
    write_json(value, out);
    if style == Style::Csv && out.ends_with(b".0") {
        out.truncate(out.len() - 2);
    }
}

fn write_json(value: impl Serialize, out: &mut Vec<u8>) {
    // Numbers, texts and flags always have a text, and memory takes every byte.
    let written = serde_json::to_writer(out, &value);
    debug_assert!(written.is_ok(), "a number, a text or a flag has a text");
}

/// Writes a text, in CSV with quotes if it needs them.
pub(crate) fn write_text(text: &str, style: Style, out: &mut Vec<u8>) {
    if style == Style::Json {
        return write_json(text, out);
    }
    let needs_quotes = text.bytes().any(|byte| matches!(byte, b',' | b'"' | b'\n' | b'\r'));
    if needs_quotes {
        out.push(b'"');
        out.extend_from_slice(text.replace('"', "\"\"").as_bytes());
        out.push(b'"');
    } else {
        out.extend_from_slice(text.as_bytes());
    }
}

//! The types of Arrow that columns may have.

use std::sync::Arc;

use arrow_array::types::Int32Type;
use arrow_array::{
    ArrayRef, DictionaryArray, Float32Array, Int64Array, ListArray, NullArray, RecordBatch, StringArray,
    StringViewArray, TimestampSecondArray, UInt16Array,
};
use arrow_ipc::writer::StreamWriter;
use verne_rows::{CHUNK_ROWS, Column, Format, WriteError, Writer};

use crate::{numbers, read, write};

fn stream(columns: Vec<(&str, ArrayRef)>) -> Vec<u8> {
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let mut writer = StreamWriter::try_new(Vec::new(), &batch.schema()).unwrap();
    writer.write(&batch).unwrap();
    writer.into_inner().unwrap()
}

#[test]
fn numbers_of_every_type_are_read() {
    let arrays: [ArrayRef; 3] = [
        Arc::new(Float32Array::from(vec![Some(1.5), None])),
        Arc::new(Int64Array::from(vec![Some(-7), None])),
        Arc::new(UInt16Array::from(vec![Some(7), None])),
    ];
    for (array, first) in arrays.into_iter().zip([1.5, -7.0, 7.0]) {
        let chunks = read(Format::Arrow, &stream(vec![("x", array)])).unwrap();
        assert_eq!(numbers(&chunks, "x"), [Some(first), None]);
    }
}

#[test]
fn texts_and_nested_types_are_refused_as_numbers() {
    let text: ArrayRef = Arc::new(StringArray::from(vec!["1"]));
    let error = read(Format::Arrow, &stream(vec![("x", text)])).unwrap_err().to_string();
    assert!(error.contains("\"x\" has the type Utf8; accepted are numbers"), "{error}");
    let list: ArrayRef = Arc::new(ListArray::from_iter_primitive::<Int32Type, _, _>([Some([Some(1)])]));
    for array in [list, Arc::new(NullArray::new(1))] {
        let error = read(Format::Arrow, &stream(vec![("id", array)])).unwrap_err().to_string();
        assert!(error.contains("\"id\" has the type"), "{error}");
    }
}

#[test]
fn other_types_pass_to_arrow_only() {
    let time: ArrayRef = Arc::new(TimestampSecondArray::from(vec![1]));
    let chunks = read(Format::Arrow, &stream(vec![("t", time)])).unwrap();
    let again = read(Format::Arrow, &write(Format::Arrow, [chunks[0].columns()])).unwrap();
    assert_eq!((again[0].rows(), again[0].columns()[0].name()), (1, "t"));
    let error = Writer::new(Format::Csv, chunks[0].columns()).unwrap_err();
    assert!(matches!(error, WriteError::NoText { name, .. } if name == "t"));
}

#[test]
fn dictionaries_and_views_become_texts() {
    let words: DictionaryArray<Int32Type> = [Some("a"), None, Some("b")].into_iter().collect();
    let views = StringViewArray::from_iter([Some("a text that is longer than a view"), None, Some("c")]);
    let bytes = stream(vec![("word", Arc::new(words)), ("view", Arc::new(views))]);
    let chunks = read(Format::Arrow, &bytes).unwrap();
    let text = write(Format::Csv, [chunks[0].columns()]);
    let expected = "word,view\na,a text that is longer than a view\n,\nb,c\n";
    assert_eq!(String::from_utf8(text).unwrap(), expected);
}

#[test]
fn a_short_stream_makes_no_endless_text() {
    let long = "x".repeat(100_000);
    let keys = arrow_array::Int8Array::from(vec![0; CHUNK_ROWS]);
    let values: ArrayRef = Arc::new(StringArray::from(vec![long.as_str()]));
    let words = DictionaryArray::try_new(keys, values).unwrap();
    assert_eq!(words.len(), CHUNK_ROWS);
    let chunks = read(Format::Arrow, &stream(vec![("word", Arc::new(words))])).unwrap();
    let columns = chunks[0].columns();
    let mut writer = Writer::new(Format::Csv, columns).unwrap();
    assert_eq!(writer.write(columns).unwrap_err(), WriteError::TooLong(CHUNK_ROWS));
}

#[test]
fn two_columns_of_one_name_are_refused() {
    let columns = [Column::numbers("x", []), Column::numbers("x", [])];
    for format in Format::ALL {
        assert_eq!(Writer::new(format, &columns).unwrap_err(), WriteError::Twice("x".to_owned()));
    }
}

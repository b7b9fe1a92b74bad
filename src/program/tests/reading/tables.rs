//! Programs as streams of Apache Arrow.

use verne_program::{Format, ProgramErrors, ReadError, ReadOptions, Reader, read};
use verne_rows::{Column, Format as TableFormat, Names, Writer};

use crate::{place, tips};

fn stream(columns: &[Column]) -> Vec<u8> {
    let mut writer = Writer::new(TableFormat::Arrow, columns).unwrap();
    let mut bytes = writer.write(columns).unwrap();
    bytes.extend(writer.finish().unwrap());
    bytes
}

fn numbers(name: &str, values: &[f64]) -> Column {
    Column::numbers(name, values.iter().map(|value| (!value.is_nan()).then_some(*value)))
}

fn table() -> Vec<Column> {
    let kinds = Names::new(&["feed", "rapid"]).unwrap();
    vec![
        numbers("k", &[1.0, 1.0, 4.0]),
        numbers("j", &[0.0, 0.0, -3.0]),
        numbers("i", &[0.0; 3]),
        Column::names("kind", &kinds, [Some(1), None, Some(0)]).unwrap(),
        numbers("feed", &[f64::NAN, 500.0, 800.0]),
        numbers("z", &[350.0, 300.0, 300.0]),
        numbers("y", &[0.0, 0.0, 5.0]),
        numbers("x", &[0.0, 0.0, 20.0]),
        Column::whole_numbers("line", [Some(7), None, Some(9)]),
    ]
}

fn refused(columns: &[Column]) -> ProgramErrors {
    match read(Format::Arrow, &stream(columns)[..], &ReadOptions::default()) {
        Err(ReadError::Program(errors)) => errors,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_table_is_the_program_of_the_same_rows() {
    let ndjson = r#"{"x":0,"y":0,"z":350,"i":0,"j":0,"k":1,"kind":"rapid","line":7}
        {"x":0,"y":0,"z":300,"i":0,"j":0,"k":1,"feed":500}
        {"x":20,"y":5,"z":300,"i":0,"j":-3,"k":4,"kind":"feed","feed":800,"line":9}"#;
    let expected = read(Format::Ndjson, ndjson.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(tips(&expected).len(), 3);
    let bytes = stream(&table());
    for size in [1, 7, 100, bytes.len()] {
        let mut reader = Reader::new(Format::Arrow, &ReadOptions::default());
        assert!(bytes.chunks(size).all(|chunk| reader.push(chunk).is_continue()));
        assert_eq!(reader.finish().unwrap(), expected, "{size}");
    }
}

#[test]
fn faults_have_the_row_and_the_column() {
    let mut columns = table();
    columns[7] = numbers("x", &[0.0, f64::INFINITY, 20.0]);
    assert_eq!(place(&refused(&columns).errors[0]), (2, 1, "x"));
    columns[7] = numbers("x", &[0.0, 0.0, f64::NAN]);
    assert!(refused(&columns).errors[0].detail.contains("x, y and z"));
    columns[7] = Column::texts("x", [Some("1"), Some("2"), Some("3")]);
    assert_eq!(place(&refused(&columns).errors[0]), (1, 1, "x"));
    let mut columns = table();
    columns[3] = Column::texts("kind", [Some("feed"), Some("plunge"), None]);
    assert_eq!(place(&refused(&columns).errors[0]), (2, 1, "kind"));
    columns.truncate(5);
    let errors = refused(&columns);
    assert_eq!((errors.errors.len(), errors.complete), (1, false), "no row can be read");
}

#[test]
fn a_stream_that_ends_early_is_a_fault() {
    let bytes = stream(&table());
    let outcome = read(Format::Arrow, &bytes[..bytes.len() - 100], &ReadOptions::default());
    let Err(ReadError::Program(errors)) = outcome else { panic!() };
    assert!(errors.errors[0].detail.contains("ends within a message"), "{errors:?}");
}

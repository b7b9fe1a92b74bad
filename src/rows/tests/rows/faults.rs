//! A row that cannot be used spoils no other, and an unusable table is refused with the name of the column.

use verne_rows::{Format, LONGEST_ROW, MOST_COLUMNS, ReadError};

use crate::{numbers, read, read_in_pieces};

fn refused(format: Format, text: &str) -> String {
    read(format, text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn what_is_no_number_is_missing() {
    let csv = "x,y\n1,2\nnone,2\n,2\n 3 ,2\n1e400,NaN\n";
    let chunks = read(Format::Csv, csv.as_bytes()).unwrap();
    let x = numbers(&chunks, "x");
    assert_eq!(x, [Some(1.0), None, None, Some(3.0), Some(f64::INFINITY)]);
    assert!(numbers(&chunks, "y")[4].unwrap().is_nan());
    let ndjson = "{\"x\":1}\n{\"x\":\"2\"}\n{\"x\":null}\n{\"x\":[3]}\n{}\n";
    assert_eq!(
        numbers(&read(Format::Ndjson, ndjson.as_bytes()).unwrap(), "x"),
        [Some(1.0), None, None, None, None]
    );
}

#[test]
fn a_malformed_row_is_a_fault_of_this_row() {
    for (format, text, detail) in [
        (Format::Csv, "x,y,id\n1,2,a\n3,4\n5,6,c\n", "2 values instead of 3"),
        (Format::Csv, "x,y,id\n1,2,a\n3,4,b,9\n5,6,c\n", "4 values instead of 3"),
        (Format::Ndjson, "{\"x\":1,\"id\":2}\n[3]\n{\"x\":5}\n", "expected an object"),
        (Format::Ndjson, "{\"x\":1,\"id\":2}\n{\"x\":3,\n{\"x\":5}\n", "EOF"),
        (Format::Ndjson, "{\"x\":1,\"id\":2}\n{\"x\":3,\"z\":4}\n{\"x\":5}\n", "\"z\" is no column"),
        (Format::Ndjson, "{\"x\":1,\"id\":2}\n{\"x\":3,\"x\":4}\n{\"x\":5}\n", "twice"),
    ] {
        let chunks = read(format, text.as_bytes()).unwrap();
        let [fault] = chunks[0].faults() else { panic!("{text}") };
        assert!(fault.row == 1 && fault.detail.contains(detail), "{text}: {}", fault.detail);
        let x = numbers(&chunks, "x");
        assert_eq!((x.len(), x[0], x[2]), (3, Some(1.0), Some(5.0)), "{text}");
    }
}

#[test]
fn an_unusable_table_is_refused() {
    let twice = |name: &str| ReadError::Column { name: name.to_owned(), detail: "occurs twice".to_owned() };
    assert_eq!(read(Format::Csv, b"x,x\n").unwrap_err(), twice("x"));
    assert_eq!(read(Format::Ndjson, b"{\"id\":1,\"id\":2}").unwrap_err(), twice("id"));
    assert!(refused(Format::Csv, "1,2,3\n").contains("must name the columns"));
    assert!(refused(Format::Csv, "").contains("must name the columns"));
    assert!(refused(Format::Csv, "x,,y\n").contains("column 2 has no name"));
    assert!(refused(Format::Ndjson, "[1,2]").contains("must be a JSON object"));
    assert!(refused(Format::Ndjson, "").contains("no row"));
    assert!(refused(Format::Ndjson, "{}\n").contains("no column"));
    let many: Vec<_> = (0..=MOST_COLUMNS).map(|i| format!("c{i}")).collect();
    assert!(refused(Format::Csv, &many.join(",")).contains("more than 256"));
}

#[test]
fn a_long_row_is_refused_before_it_is_in_memory() {
    let long = "1".repeat(4 * LONGEST_ROW);
    assert!(refused(Format::Csv, &format!("x\n\"{long}")).contains("row 2 of the CSV text is longer"));
    assert!(refused(Format::Ndjson, &format!("{{\"x\":1}}\n{long}")).contains("line 2 is longer"));
}

#[test]
fn marks_blank_lines_and_line_ends_of_other_systems_are_no_rows() {
    let text = "\u{FEFF}x,id\r\n1,\"a\nb\"\r\n\r\n2,c";
    assert_eq!(numbers(&read(Format::Csv, text.as_bytes()).unwrap(), "x"), [Some(1.0), Some(2.0)]);
    let text = "{\"x\":1}\r\n\r\n  \n{\"x\":2}";
    assert_eq!(numbers(&read(Format::Ndjson, text.as_bytes()).unwrap(), "x"), [Some(1.0), Some(2.0)]);
}

/// With pieces of one byte a row is read in several steps.
#[test]
fn each_row_has_its_line() {
    for (format, text) in [
        (Format::Csv, "x,id\n1,a\n\n2,b\n3,\"c\nd\"\n4,e"),
        (Format::Csv, "\nx,id\r\n1,a\r\n2,b\r\n3,\"c\r\nd\"\r\n4,e\r\n"),
        (Format::Ndjson, "\n{\"x\":1}\n \n{\"x\":2}\nno row\n{\"x\":4}"),
    ] {
        let expected = if text.contains('\r') { [3, 4, 6, 7] } else { [2, 4, 6, 7] };
        let expected = if format == Format::Ndjson { [2, 4, 5, 6] } else { expected };
        for size in [1, 2, 3, text.len()] {
            let chunks = read_in_pieces(format, text.as_bytes(), size).unwrap();
            let lines = chunks.iter().flat_map(|chunk| (0..chunk.rows()).map(|row| chunk.line(row).unwrap()));
            assert_eq!(lines.collect::<Vec<_>>(), expected, "{text} in pieces of {size}");
        }
    }
}

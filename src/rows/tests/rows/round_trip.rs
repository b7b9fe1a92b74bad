//! The readers read what the writers wrote, in every format.

use verne_rows::{CHUNK_ROWS, Chunk, Column, Format, Names};

use crate::{numbers, read, read_in_pieces, write};

/// Numbers that a text could spoil.
const HARD: [f64; 8] = [0.1 + 0.2, -0.0, 1e-310, f64::MAX, 5e-324, 1e22, -123_456.789_012_345_67, 300.0];

fn table() -> Vec<Column> {
    let words = Names::new(&["ok", "a, \"b\"\nc"]).unwrap();
    let count = HARD.len();
    vec![
        Column::texts("id", (0..count).map(|i| (i != 3).then(|| format!("row {i}, \"é\"")))),
        Column::numbers("y", HARD.into_iter().rev().map(Some)),
        Column::names("word", &words, (0..count).map(|i| i8::try_from(i % 2).ok().filter(|_| i != 5)))
            .unwrap(),
        Column::flags("flag", (0..count).map(|i| (i != 2).then_some(i % 3 == 0))),
        Column::whole_numbers("line", (0..count).map(|i| u32::try_from(i).ok())),
        Column::numbers("x", HARD.into_iter().enumerate().map(|(i, x)| (i != 1).then_some(x))),
    ]
}

fn expected_x() -> Vec<Option<u64>> {
    HARD.into_iter().enumerate().map(|(i, x)| (i != 1).then_some(x.to_bits())).collect()
}

fn bits(numbers: Vec<Option<f64>>) -> Vec<Option<u64>> {
    numbers.into_iter().map(|number| number.map(f64::to_bits)).collect()
}

#[test]
fn numbers_survive_every_format_in_pieces_of_any_size() {
    for format in Format::ALL {
        let bytes = write(format, [&table()[..]]);
        for size in (1..40).chain([64, 1000, bytes.len()]) {
            let chunks = read_in_pieces(format, &bytes, size).unwrap();
            assert_eq!(bits(numbers(&chunks, "x")), expected_x(), "{format:?} {size}");
            assert!(chunks.iter().all(|chunk| chunk.faults().is_empty()), "{format:?} {size}");
        }
    }
}

#[test]
fn extra_columns_pass_from_every_format_to_every_format() {
    let direct = |format| write(format, [&table()[..]]);
    for from in Format::ALL {
        let chunks = read(from, &direct(from)).unwrap();
        for to in Format::ALL {
            let passed = write(to, chunks.iter().map(Chunk::columns));
            let again = read(to, &passed).unwrap();
            let names = |chunks: &[Chunk]| -> Vec<String> {
                chunks[0].columns().iter().map(|column| column.name().to_owned()).collect()
            };
            assert_eq!(names(&again), ["id", "y", "word", "flag", "line", "x"]);
            assert_eq!(bits(numbers(&again, "x")), expected_x(), "{from:?} {to:?}");
        }
        let passed = write(from, chunks.iter().map(Chunk::columns));
        let is_text = from != Format::Arrow;
        assert!(!is_text || passed == direct(from), "{from:?}");
    }
    let csv = |from: Format| {
        let chunks = read(from, &direct(from)).unwrap();
        write(Format::Csv, chunks.iter().map(Chunk::columns))
    };
    assert!(csv(Format::Arrow) == direct(Format::Csv) && csv(Format::Ndjson) == direct(Format::Csv));
}

#[test]
fn columns_may_have_any_order() {
    let [one, other] = ["x,y\n1,2\n", "y,x\n2,1\n"].map(|text| read(Format::Csv, text.as_bytes()).unwrap());
    assert_eq!((numbers(&one, "x"), numbers(&one, "y")), (numbers(&other, "x"), numbers(&other, "y")));
    let text = b"{\"x\":1,\"y\":2}\n{\"y\":4,\"x\":3}\n";
    assert_eq!(numbers(&read(Format::Ndjson, text).unwrap(), "x"), [Some(1.0), Some(3.0)]);
}

#[test]
fn many_rows_come_in_chunks() {
    let count = u32::try_from(3 * CHUNK_ROWS + 5).unwrap();
    let columns = [Column::numbers("x", (0..count).map(|i| Some(f64::from(i))))];
    for format in Format::ALL {
        let chunks = read(format, &write(format, [&columns[..]])).unwrap();
        assert!(chunks.iter().all(|chunk| chunk.rows() <= CHUNK_ROWS));
        let expected: Vec<_> = (0..count).map(|i| Some(f64::from(i))).collect();
        assert!(numbers(&chunks, "x") == expected, "{format:?}");
    }
}

#[test]
fn no_rows_are_an_answer_too() {
    let columns: Vec<_> = table().into_iter().map(|column| Column::numbers(column.name(), [])).collect();
    for format in [Format::Arrow, Format::Csv] {
        let bytes = write(format, [&columns[..]]);
        assert!(read(format, &bytes).unwrap().is_empty());
    }
}

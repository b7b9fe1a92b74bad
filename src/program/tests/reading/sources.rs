//! Sources: chunks, sizes, and data that is no text.

use std::io::{self, BufReader, Read};

use verne_program::{Format, LONGEST_LINE, ReadError, ReadOptions, Reader, line_texts, read};

use crate::faults_of;

/// A source that repeats a piece, and counts what was asked for.
struct Repeated<'a> {
    piece: &'a [u8],
    left: usize,
    at: usize,
    taken: &'a mut usize,
}

impl Read for Repeated<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = buffer.len().min(self.left);
        for byte in &mut buffer[..length] {
            *byte = self.piece[self.at % self.piece.len()];
            self.at += 1;
        }
        self.left -= length;
        *self.taken += length;
        Ok(length)
    }
}

/// The first fault of so many repeated bytes, and how many bytes were read until then.
fn refused(format: Format, piece: &[u8], length: usize) -> (String, usize) {
    let mut taken = 0;
    let source = Repeated { piece, left: length, at: 0, taken: &mut taken };
    let error = read(format, BufReader::new(source), &ReadOptions::default()).unwrap_err();
    let ReadError::Program(refused) = error else { panic!("{error}") };
    (refused.errors[0].to_string(), taken)
}

#[test]
fn a_line_of_100_mb_is_refused_before_it_is_read() {
    for format in [Format::Apt, Format::Csv, Format::Ndjson] {
        let (detail, taken) = refused(format, b"x", 100 << 20);
        assert!(detail.starts_with("line 1") && detail.contains("longer than 65536 bytes"), "{detail}");
        assert!(taken <= 2 * LONGEST_LINE, "{taken}");
    }
    // The same as one chunk.
    let mut reader = Reader::new(Format::Apt, &ReadOptions::default());
    assert!(reader.push(&vec![b' '; 2 * LONGEST_LINE]).is_break());
    assert!(reader.push(b"GOTO/1,2,3\n").is_break());
    assert!(reader.finish().is_err());
}

#[test]
fn ten_million_blank_lines_are_no_program() {
    for (format, lines) in [(Format::Apt, 10_000_000), (Format::Csv, 1000), (Format::Ndjson, 1000)] {
        let (detail, taken) = refused(format, b"\n", lines);
        assert!(detail.contains("no moves"), "{detail}");
        assert_eq!(taken, lines);
    }
}

#[test]
fn blank_lines_count() {
    let text = format!("{}UNITS/MM\nGOTO/1,2,3\n", "\r\n".repeat(70_000));
    let program = read(Format::Apt, text.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(program.moves()[0].line(), 70_002);
}

#[test]
fn binary_data_is_refused_at_its_line() {
    for format in [Format::Apt, Format::Csv, Format::Ndjson] {
        let refused = faults_of(format, b"\n\x7FELF\x02\x01\x01\0\0\0\0\n");
        assert!(refused.to_string().contains("line 2, column 1: the file is binary"), "{refused}");
        assert!(!refused.complete);
    }
    assert!(faults_of(Format::Apt, b"\x1F\x8B\x08\0").to_string().contains("compressed"));
    assert!(faults_of(Format::Csv, b"PK\x03\x04\x14\0").to_string().contains("compressed"));
}

#[test]
fn utf_16_is_refused_by_name() {
    let text = "UNITS/MM\r\nGOTO/1,2,3\r\n";
    let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [[b"\xFF\xFE", &*little].concat(), [b"\xFE\xFF", &*big].concat(), little, big] {
        for format in [Format::Apt, Format::Csv, Format::Ndjson] {
            let refused = faults_of(format, &bytes);
            assert!(refused.to_string().contains("UTF-16; save it as UTF-8"), "{refused}");
        }
    }
}

#[test]
fn utf_32_is_refused_by_name() {
    for text in ["UNITS/MM\r\nGOTO/1,2,3\r\n", "%\nO1\n"] {
        let little: Vec<u8> = text.chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
        let big: Vec<u8> = text.chars().flat_map(|c| u32::from(c).to_be_bytes()).collect();
        for bytes in [[b"\xFF\xFE\0\0", &*little].concat(), [b"\0\0\xFE\xFF", &*big].concat(), little, big] {
            let refused = faults_of(Format::Apt, &bytes);
            assert!(refused.to_string().contains("UTF-32; save it as UTF-8"), "{refused}");
        }
    }
}

#[test]
fn chunks_of_any_size_give_the_same_program() {
    let text = "\u{FEFF}UNITS/MM\r\n$$ é ü\nGOTO/1,2,$\n3,0,0,1\nCIRCLE/0,0,0,0,0,1\nGOTO/-1,-2,3";
    let whole = read(Format::Apt, text.as_bytes(), &ReadOptions::default()).unwrap();
    for size in 1..text.len() {
        let mut reader = Reader::new(Format::Apt, &ReadOptions::default());
        assert!(text.as_bytes().chunks(size).all(|chunk| reader.push(chunk).is_continue()));
        assert_eq!(reader.finish().unwrap(), whole, "{size}");
    }
}

#[test]
fn a_source_that_fails_is_no_fault_of_the_program() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("unplugged"))
        }
    }
    let error = read(Format::Apt, BufReader::new(Broken), &ReadOptions::default()).unwrap_err();
    assert_eq!(error.to_string(), "cannot read the program: unplugged");
}

#[test]
fn the_texts_of_lines_are_found_again() {
    let text = "one\r\n\nthree\n\u{fc}\nlast";
    let found = line_texts(BufReader::with_capacity(2, text.as_bytes()), &[1, 2, 2, 4, 5, 6]).unwrap();
    let expected = [(1, "one"), (2, ""), (4, "\u{fc}"), (5, "last")];
    assert_eq!(found, expected.map(|(line, text)| (line, text.to_owned())));
    assert_eq!(line_texts("".as_bytes(), &[1]).unwrap(), []);
    assert_eq!(line_texts("a\n".as_bytes(), &[2]).unwrap(), []);
    let long = "x".repeat(3 * LONGEST_LINE);
    assert_eq!(line_texts(long.as_bytes(), &[1]).unwrap()[0].1.len(), LONGEST_LINE);
}

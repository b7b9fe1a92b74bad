//! Arbitrary bytes as programs of every format, and as packed programs.

use verne_program::{
    Compensation, Format, Program, ReadError, ReadOptions, Reader, RotarySense, Step, Units, packed, read,
};

use crate::draw::Draw;

/// CL text.
pub(crate) fn apt(bytes: &[u8]) {
    check_source(Format::Apt, bytes);
}

/// G-code, under several options.
pub(crate) fn gcode(bytes: &[u8]) {
    let code = |text: &str| text.parse().unwrap();
    let plain = ReadOptions { most_moves: 10_000, ..ReadOptions::default() };
    let controlled = ReadOptions { tcp: true, rotary_sense: RotarySense::Table, ..plain.clone() };
    let switched = ReadOptions {
        tcp_on: vec![code("M428"), code("M451")],
        tcp_off: vec![code("M429"), code("M451")],
        rapid_feed: Some(5000.0),
        compensation: Compensation::Refuse,
        units: Some(Units::Inches),
        ..plain.clone()
    };
    for options in [plain, controlled, switched] {
        check_with(Format::Gcode, bytes, &options);
    }
}

/// CSV.
pub(crate) fn csv(bytes: &[u8]) {
    check_source(Format::Csv, bytes);
}

/// NDJSON.
pub(crate) fn ndjson(bytes: &[u8]) {
    check_source(Format::Ndjson, bytes);
}

/// Bytes to be unpacked, or a packed program with some bytes changed.
pub(crate) fn packed(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    if draw.one_in(2) {
        return unpack(draw.rest());
    }
    let changes: Vec<_> =
        (0..draw.below(4)).map(|_| (draw.below(256) * 256 + draw.below(256), draw.byte())).collect();
    let options = ReadOptions { units: Some(Units::Millimetres), ..ReadOptions::default() };
    let Ok(program) = read(Format::Apt, draw.rest(), &options) else { return };
    let mut bytes = pack(&program);
    for (at, byte) in changes {
        let at = at % bytes.len();
        bytes[at] ^= byte;
    }
    unpack(&bytes);
}

/// A program is sound, and the same in chunks; faults have places and say what is wrong.
fn check_source(format: Format, bytes: &[u8]) {
    check_with(format, bytes, &ReadOptions { most_moves: 10_000, ..ReadOptions::default() });
}

fn check_with(format: Format, bytes: &[u8], options: &ReadOptions) {
    let outcome = read(format, bytes, options);
    let mut reader = Reader::new(format, options);
    let size = bytes.first().map_or(1, |byte| usize::from(*byte) + 1);
    let refused = bytes.chunks(size).any(|chunk| reader.push(chunk).is_break());
    let in_chunks = reader.finish();
    match outcome {
        Ok(program) => {
            assert!(!refused);
            check(&program);
            assert_eq!(in_chunks.unwrap(), program);
        }
        Err(ReadError::Program(errors)) => {
            assert!((1..=20).contains(&errors.errors.len()), "{errors:?}");
            for error in &errors.errors {
                assert!(error.line >= 1 && error.column >= 1 && !error.detail.is_empty(), "{error:?}");
                assert!(error.word.chars().count() <= 64, "{error:?}");
            }
            assert!(
                errors.errors.is_sorted_by_key(|error| error.line) || format == Format::Apt,
                "{errors:?}"
            );
            assert_eq!(in_chunks.unwrap_err(), errors);
        }
        Err(ReadError::Source(error)) => panic!("{error}"),
    }
}

fn pack(program: &Program) -> Vec<u8> {
    let mut bytes = Vec::new();
    packed::write(program, &mut bytes).unwrap();
    bytes
}

fn unpack(bytes: &[u8]) {
    if let Ok(program) = packed::unpack(bytes) {
        assert_eq!(packed::unpack(pack(&program).as_slice()).unwrap(), program);
        check_steps(&program);
    }
}

fn check(program: &Program) {
    assert_eq!(&packed::unpack(pack(program).as_slice()).unwrap(), program);
    check_steps(program);
    let bounds = program.bounds().unwrap();
    assert!(program.moves().iter().all(|one| {
        let tip = one.tip();
        (0..3).all(|k| bounds.min[k] <= tip[k] && tip[k] <= bounds.max[k])
    }));
    assert!(program.tools().len() <= program.events().len());
    let warnings = program.warnings();
    assert!(warnings.list.len() <= 100 && warnings.total >= warnings.list.len() as u64);
}

/// Every move and event appears once, and every point of a path is finite.
fn check_steps(program: &Program) {
    let (mut moves, mut events) = (0, 0);
    for step in program.steps() {
        match step {
            Step::Move(segment) => {
                moves += 1;
                let axis = segment.end.axis();
                assert!((axis.iter().map(|n| n * n).sum::<f64>() - 1.0).abs() < 1e-12, "{axis:?}");
                assert!(segment.end.feed().is_none_or(|feed| feed.value > 0.0 && feed.value.is_finite()));
                assert_eq!(segment.tip_at(1.0), segment.end.tip());
                // A damaged packed program may have numbers whose squares overflow.
                if segment.end.tip().iter().all(|n| n.abs() <= 1e7) && segment.arc.is_none() {
                    assert!(segment.tip_at(0.3).iter().all(|n| n.is_finite()), "{segment:?}");
                }
            }
            Step::Event(_) => events += 1,
        }
    }
    assert_eq!((moves, events), (program.moves().len(), program.events().len()));
}

//! Words, comments and lines as controllers and posts write them.

use verne_program::{EventKind, Format, ReadOptions, read};

use crate::{faults_of, nc, nc_fault, nc_faults, place, tips, warnings};

#[test]
fn blanks_signs_case_and_line_breaks_do_not_matter() {
    let expected = nc("G1 X1.5 Y-0.25 Z16.3 F100\nX2 Y.5 Z10.");
    for text in [
        "G1X1.5Y-.25Z16.3F100\nX2Y.5Z10.",
        "g01 x+1.5 y - 0.25 z  16.3 f100.0\nx2. y+.5 z010",
        "N10 G1 X1.50 Y-00.25 Z 16.300 F 100\nN20 X 2 Y 0.5 Z1\u{30}",
        "\tG1\tX1.5 (in) Y-.25 Z16.3 F100 ; end\n  X2 Y.5 Z10",
        "G1 X1.5 Y-.25 Z16.3 F100\r\nX2 Y.5 Z10\r",
        "F100 Z16.3 Y-.25 X1.5 G1\nN5 Z10 X2 Y.5",
    ] {
        let program = nc(text);
        assert_eq!(program.moves(), expected.moves(), "{text}");
    }
}

#[test]
fn numbers_keep_all_their_digits() {
    assert_eq!(
        tips(&nc("G0 X123.456789012 Y0.1 Z-271.828182845"))[0],
        [123.456_789_012, 0.1, -271.828_182_845]
    );
    assert!(tips(&nc("G0 X-0 Y-0.0 Z1"))[0].iter().all(|n| n.is_sign_positive()));
}

#[test]
fn comments_are_events_in_their_place() {
    let bytes = b"%\n(first (nested) text)\nG21\nG0 X0 Y0 Z0 (M\xFCller \x80 5) ; last\n\
                  G1 X1 F9 (\xC3\xA9)\n(---)\n()\nM2\n%\n";
    let program = read(Format::Gcode, &bytes[..], &ReadOptions::default()).unwrap();
    let comments: Vec<_> = program
        .events()
        .iter()
        .filter(|event| event.kind == EventKind::Comment)
        .map(|event| (event.line, event.before, &*event.text))
        .collect();
    assert_eq!(
        comments,
        [(2, 0, "first (nested) text"), (4, 0, "Müller € 5"), (4, 0, "last"), (5, 1, "é"), (6, 2, "---")]
    );
}

#[test]
fn percent_begins_and_ends_a_program() {
    let program = read(
        Format::Gcode,
        "%\nO1234 (NAME)\nG21 G0 X1 Y2 Z3\n%\nthis is not read\nG0 X9\n".as_bytes(),
        &ReadOptions::default(),
    )
    .unwrap();
    assert_eq!(tips(&program), [[1.0, 2.0, 3.0]]);
    assert_eq!(warnings(&program), ["what follows the end of the program is not read"]);
    assert_eq!(&*program.events()[1].text, "O1234");
    assert_eq!(tips(&nc("G0 X1 Y2 Z3\nM2\nG1 X5")).len(), 1);
}

#[test]
fn a_truncated_program_is_refused_or_if_it_may_be_whole_a_warning() {
    let refused = faults_of(Format::Gcode, b"%\nG21\nG0 X1 Y2 Z3\nG1 X12");
    assert_eq!(refused.errors[0].line, 4);
    assert!(refused.errors[0].detail.contains("truncated"));
    for text in ["%\nG21\nG0 X1 Y2 Z3\n", "G21\nG0 X1 Y2 Z3"] {
        let program = read(Format::Gcode, text.as_bytes(), &ReadOptions::default()).unwrap();
        assert!(warnings(&program)[0].contains("may be truncated"), "{text}");
    }
    for text in ["%\nG21 G0 X1 Y2 Z3\nM30", "%\nG21 G0 X1 Y2 Z3\n%", "G21 G0 X1 Y2 Z3\nM2\n"] {
        let program = read(Format::Gcode, text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(program.warnings().total, 0, "{text}");
    }
}

#[test]
fn block_delete_is_off() {
    let program = nc("G0 X0 Y0 Z0\n/G1 X1 F9\nN5 /2 X2\n / X3");
    assert_eq!(program.moves().len(), 4);
    assert_eq!(program.warnings().total, 3);
    assert!(warnings(&program)[0].contains("block delete"));
}

#[test]
fn what_is_no_word_is_a_fault_at_its_place() {
    for (block, column, word, part) in [
        ("G1 X", 4, "X", "a letter and a number"),
        ("G1 X-Y1", 4, "X-Y1", "a letter and a number"),
        ("G1 X.", 4, "X.", "a letter and a number"),
        ("G1 X1.2.3", 4, "X1.2.3", "at most one point"),
        ("G1 X1 2", 4, "X1", "at most one point"),
        ("G1 X1-2", 4, "X1-2", "at most one point"),
        ("  G1 Xnan", 6, "Xnan", "a letter and a number"),
        ("G1 X10 ?", 8, "?", "a letter and a number"),
        ("G1 X10 Ä1", 8, "Ä1", "a letter and a number"),
        ("G1 X1 (open", 7, "(open", "no end"),
        ("G1 X1 close)", 7, "close)", "a letter and a number"),
        ("G1 X1 )", 7, ")", "no beginning"),
        ("G1 X1 X2", 7, "X2", "two X words"),
        ("G1.05 X1", 1, "G1.05", "at most one decimal"),
        ("G-1 X1", 1, "G-1", "no sign"),
        ("G5000000000", 1, "G5000000000", "at most one decimal"),
        ("G12345 X1", 1, "G12345", "not known"),
        ("T1.5 M6", 1, "T1.5", "whole number"),
        ("G1 X1e5 F1", 6, "e5", "no such axis"),
    ] {
        let error = &nc_faults(&format!("G0 X0 Y0 Z0\n{block}"))[0];
        assert_eq!(place(error), (3, column, word), "{error}");
        assert!(error.detail.contains(part), "{error}");
    }
    let digits = "9".repeat(400);
    assert!(nc_fault(&format!("G0 X0 Y0 Z{digits}")).detail.contains("too large"));
    assert!(nc_fault("G0 X0 Y0 Z100000000").detail.contains("check the units"));
    assert!(nc_faults(&"M7".repeat(70))[0].detail.contains("64 words"));
}

#[test]
fn parameters_subprograms_and_other_languages_are_refused_by_name() {
    for (block, column, part) in [
        ("#1=5", 1, "parameters"),
        ("G1 X#1", 4, "parameters"),
        ("G1 X[1+2]", 4, "parameters"),
        ("#<rate>=1000", 1, "parameters"),
        ("G1 F#<rate> X1", 4, "parameters"),
        ("O<cut> call [1]", 1, "subprograms"),
        ("o100 sub", 1, "subprograms"),
        ("O100", 1, "subprograms"),
        ("M98 P1000", 1, "calls"),
        ("M99", 1, "calls"),
        ("G65 P9000 A1", 1, "macros"),
        ("G66 P9000", 1, "macros"),
        ("IF [1 EQ 1] GOTO 5", 1, "branches"),
        ("WHILE [1 LT 2] DO1", 1, "loops"),
        ("CYCLE800(0,\"\",0)", 1, "CYCLE800"),
        ("PLANE SPATIAL SPA+10", 1, "PLANE SPATIAL"),
        ("TRAORI", 1, "TRAORI"),
    ] {
        let error = &nc_faults(&format!("G0 X0 Y0 Z0\n{block}"))[0];
        assert_eq!((error.line, error.column), (3, column), "{error}");
        assert!(error.detail.contains(part), "{error}");
    }
}

#[test]
fn shifts_splines_and_unknown_codes_are_refused_by_name() {
    for (block, part) in [
        ("G52 X1", "G52 shifts"),
        ("G92 X0", "G92 shifts"),
        ("G92.1", "G92 shifts"),
        ("G10 L2 P1 X0", "G10 changes"),
        ("G5 X1 Y1 I0 J0 P1 Q1", "splines"),
        ("G05.1 Q1", "a mode such as G5.1 Q1"),
        ("G234 H1", "G234 in tcp_on"),
        ("G41.2 D1", "tool centre point"),
        ("G43.1 Z1", "with H"),
        ("G54.1 P3", "G54 to G59.3"),
        ("G68 R30", "G68.2"),
        ("G84 Z-1 R1", "G73, G80"),
        ("G76 X1", "G73, G80"),
        ("G7", "not known"),
        ("G1.1", "not known"),
    ] {
        let error = nc_fault(&format!("G0 X0 Y0 Z0\n{block}"));
        assert_eq!((error.line, error.column), (3, 1), "{error}");
        assert!(error.detail.contains(part), "{error}");
    }
}

#[test]
fn two_codes_of_a_group_exclude_each_other() {
    for (block, second) in [
        ("G0 G1 X1", "G1"),
        ("G17 G18", "G18"),
        ("G90 G91", "G91"),
        ("G90.1 G91.1", "G91.1"),
        ("G93 G94", "G94"),
        ("G20 G21", "G21"),
        ("G40 G41", "G41"),
        ("G43 G49 H1", "G49"),
        ("G98 G99", "G99"),
        ("G54 G55", "G55"),
        ("G4 G28 X1", "G28"),
        ("G80 G81 Z1 R1", "G80"),
        ("G1 G81 Z1 R1", "G81"),
        ("M3 M4", "M4"),
        ("M8 M9", "M9"),
        ("M0 M30", "M30"),
    ] {
        let errors = nc_faults(&format!("G0 X0 Y0 Z5\n{block}"));
        assert_eq!(errors[0].word, second, "{block}: {errors:?}");
        assert!(errors[0].detail.contains("exclude each other"), "{errors:?}");
    }
    // The usual first block of Fanuc programs has codes of ten groups.
    assert_eq!(nc("G0 G17 G40 G49 G80 G90 G94 G98 G69 M7 M8 X1 Y2 Z3").moves().len(), 1);
}

#[test]
fn words_that_nothing_uses_are_warnings_or_if_they_may_move_faults() {
    let program = nc("G0 X0 Y0 Z0 D5 L2 P3 Q4");
    assert_eq!(program.warnings().total, 4);
    for word in ["E1", "U1", "V1", "W1", "I1", "R5", "K2"] {
        let error = nc_fault(&format!("G0 X0 Y0 Z0\nG1 X1 F9 {word}"));
        assert_eq!(place(&error), (3, 10, word), "{error}");
    }
}

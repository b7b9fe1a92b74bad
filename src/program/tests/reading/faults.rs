//! Faults: their places, their number, and broken numbers.

use verne_program::{Format, ReadOptions, read};

use crate::{fault, faults_of, mm, place, warnings};

#[test]
fn a_fault_names_line_column_word_and_what_is_accepted() {
    let error = fault("$$ a comment\n\n  GOTO/1,2,three");
    assert_eq!(place(&error), (4, 12, "THREE"));
    assert!(error.detail.contains("3 or 6 numbers"));
    assert_eq!(place(&fault("GOTO/1,2")), (2, 1, "GOTO"));
    assert_eq!(place(&fault("GOTO/1,2,3,4,5")), (2, 1, "GOTO"));
    assert_eq!(error.to_string(), format!("line 4, column 12, \"THREE\": {}", error.detail));
}

#[test]
fn numbers_that_are_none_are_refused() {
    for number in ["NaN", "inf", "-Infinity", "1e999", "1.2.3", "--1", "1-2", "0x10", "1_000", "."] {
        let error = fault(&format!("GOTO/1,2,{number}"));
        assert_eq!(place(&error), (2, 10, number.to_uppercase().as_str()), "{error}");
    }
    assert!(fault("GOTO/1,2,1e8").detail.contains("check the units"));
}

#[test]
fn at_most_twenty_faults_are_collected() {
    let text = format!("UNITS/MM\n{}", "GOTO/1\n".repeat(100));
    let refused = faults_of(Format::Apt, text.as_bytes());
    assert_eq!((refused.errors.len(), refused.complete), (20, false));
    assert_eq!(refused.errors[19].line, 21);
    let refused = faults_of(Format::Apt, b"UNITS/MM\nGOTO/1\nGOTO/2\nGOTO/1,2,3\n");
    assert_eq!((refused.errors.len(), refused.complete), (2, true));
}

#[test]
fn warnings_are_listed_once_and_counted() {
    let text = (0..150).map(|n| format!("WORD{n}/1\nWORD{n}/2\n")).collect::<Vec<_>>().concat();
    let program = mm(&format!("{text}RAPID\nGOTO/0,0,0"));
    assert_eq!((program.warnings().list.len(), program.warnings().total), (100, 300));
}

#[test]
fn a_long_word_is_shortened() {
    let error = fault(&format!("GOTO/1,2,{}", "X".repeat(1000)));
    assert_eq!(error.word.len(), 64);
}

#[test]
fn a_program_without_moves_is_refused() {
    for (format, text) in [
        (Format::Apt, ""),
        (Format::Apt, "UNITS/MM\nFINI\n"),
        (Format::Csv, "x,y,z\n"),
        (Format::Csv, ""),
        (Format::Ndjson, "\n\n"),
    ] {
        assert_eq!(
            faults_of(format, text.as_bytes()).errors[0].detail,
            "the program has no moves",
            "{text:?}"
        );
    }
}

#[test]
fn a_truncated_file_is_refused_or_if_it_may_be_whole_a_warning() {
    let whole = "PARTNO/X\nUNITS/MM\nRAPID\nGOTO/1,2,3.125\nGOTO/4,5,6.25,$\n0,0,1.0\nFINI\n";
    let parse = |text: &str| read(Format::Apt, text.as_bytes(), &ReadOptions::default());
    assert!(warnings(&parse(whole).unwrap()).len() == 1, "only that there is no feed");
    let numbers_end = whole.find("FINI").unwrap();
    for end in whole.find("GOTO").unwrap()..numbers_end {
        let text = &whole[..end];
        match parse(text) {
            Err(error) => assert!(!error.to_string().is_empty()),
            // Cut after a line break: nothing proves that something is missing.
            Ok(program) => {
                assert!(text.ends_with('\n'), "{text:?}");
                assert!(
                    warnings(&program).iter().any(|detail| detail.contains("may be truncated")),
                    "{text:?}"
                );
            }
        }
    }
    let refused = faults_of(Format::Apt, b"UNITS/MM\nGOTO/4,5,6,$\n");
    assert!(refused.errors[0].detail.contains("ends within this statement"), "{refused}");
}

#[test]
fn a_statement_has_a_bounded_length() {
    let text = format!("UNITS/MM\nGOTO/$\n{}", "1,$\n".repeat(100_000));
    let error = &faults_of(Format::Apt, text.as_bytes()).errors[0];
    assert_eq!(error.line, 2);
    assert!(error.detail.contains("65536 bytes"), "{error}");
}

#[test]
fn more_moves_than_allowed_are_refused_at_their_line() {
    let options = ReadOptions { most_moves: 2, ..ReadOptions::default() };
    let text = "UNITS/MM\nGOTO/1,0,0\nGOTO/2,0,0\nGOTO/3,0,0\n";
    let refused = read(Format::Apt, text.as_bytes(), &options).unwrap_err().to_string();
    assert!(refused.starts_with("line 4") && refused.contains("at most 2 moves"), "{refused}");
}

//! How CL text is written: case, blanks, numbers, comments, continuations, cards, and words that are not known.

use verne_program::{EventKind, Format, ReadOptions, Step, read};

use crate::{apt, fault, mm, place, tips, warnings};

#[test]
fn case_blanks_and_bare_points_do_not_matter() {
    let program =
        apt("  units / mm \r\n\trapid\r\ngoto / .9625, 1.,-3\r\nGoTo/1.,0,0  ,0 , 0,  1.\r\nfini\r\n");
    assert_eq!(tips(&program), [[0.9625, 1.0, -3.0], [1.0, 0.0, 0.0]]);
}

#[test]
fn a_dollar_continues_a_statement_and_its_first_line_counts() {
    let program =
        mm("GOTO / 1.0, 2.0, 3.0,  $\n\n0.0, 0.0, $ ignored\n$$ a comment between\n 1.0\nGOTO/4,5,6");
    assert_eq!(tips(&program), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(program.moves().iter().map(verne_program::Move::line).collect::<Vec<_>>(), [2, 7]);
}

#[test]
fn a_fault_in_a_continued_statement_names_its_own_line() {
    assert_eq!(place(&fault("GOTO/1,2,3, $\n  0, 0, one")), (3, 9, "ONE"));
}

#[test]
fn texts_are_events_in_their_places() {
    let text = "PARTNO PART 7/B\nFEDRAT/9,MMPM\nREMARK -> A / B\nGOTO/0,0,0\n$$ between\n\
                PPRINT/'it''s \"quoted\", GOTO/1'\n\
                PPWORD/RETURN,7\nTPRINT/DRILL 5$\nINSERT/M21 (GOTO/1,2,3)\nGOTO/1,0,0 $$ behind";
    let program = mm(text);
    let found: Vec<_> = program
        .steps()
        .map(|step| match step {
            Step::Move(segment) => format!("{}", segment.end.line()),
            Step::Event(event) => format!("{} {:?} {}", event.line, event.kind, event.text),
        })
        .collect();
    assert_eq!(
        found,
        [
            "2 Comment PART 7/B",
            "4 Comment -> A / B",
            "5",
            "6 Comment between",
            "7 Comment it''s \"quoted\", GOTO/1",
            "8 Comment RETURN,7",
            "9 Comment DRILL 5$",
            "10 Insert M21 (GOTO/1,2,3)",
            "11",
            "11 Comment behind",
        ]
    );
    assert!(program.warnings().list.is_empty());
}

#[test]
fn a_table_of_words_before_the_program_moves_nothing() {
    let program =
        mm("PPWORD/TLAXIS,3171\nPPWORD/GOTO,1,2,3\nCAMERA/ 1.0, 0.0, 0.0, $\n-10.5, $\n0.0,1.0\nGOTO/0,0,0");
    assert_eq!(program.moves().len(), 1);
}

#[test]
fn a_continued_comment_ends_where_its_numbers_end() {
    let text = "$$-> CSYS / 1.0, 0.0, 0.0, 0.0, $\n  0.0, 1.0, 0.0, 0.0, $\n 0.0, 0.0, 1.0, 0.0\nGOTO/1,2,3\n\
                $$ costs 5 $\nGOTO/4,5,6";
    assert_eq!(mm(text).moves().len(), 2);
}

#[test]
fn columns_73_to_80_of_card_images_are_numbers_of_cards() {
    let cards = ["PARTNO CARDS", "UNITS/MM", "GOTO/1,2,3,$", "0,0,1", "FINI"];
    let text =
        (1..).zip(cards).map(|(n, card)| format!("{card:<72}{:08}\n", 10 * n)).collect::<Vec<_>>().concat();
    let program = apt(&text);
    assert_eq!(tips(&program), [[1.0, 2.0, 3.0]]);
    assert_eq!(&*program.events()[0].text, "CARDS");
}

#[test]
fn a_long_free_line_is_read_to_its_end() {
    let line = format!(
        "GOTO/{},{},{},0.000000000000,0.00000000000,1.0",
        "1.0000000000", "2.0000000000", "3.0000000000"
    );
    assert!(line.len() > 72);
    assert_eq!(tips(&mm(&line)), [[1.0, 2.0, 3.0]]);
    // Eighty columns, and digits to the end.
    let line = format!("GOTO/1.0,2.0,{:0<67}", "3.5");
    assert_eq!((line.len(), tips(&mm(&line))[0]), (80, [1.0, 2.0, 3.5]));
}

#[test]
fn bytes_of_a_code_page_and_a_byte_order_mark_are_accepted() {
    let text = b"\xEF\xBB\xBFUNITS/MM\nPPRINT/M\xFCLLER \x96 5\xB0\nGOTO/1,2,3\x1A";
    let program = read(Format::Apt, text.as_slice(), &ReadOptions::default()).unwrap();
    assert_eq!(program.moves().len(), 1);
}

#[test]
fn a_word_that_is_not_known_is_a_warning_unless_it_may_move_the_tool() {
    let program = mm("WHATEVER/19.\nANOTHER/TOOL,5\nWHATEVER/20.\nBARE\nRAPID\nGOTO/0,0,0");
    let list: Vec<_> =
        program.warnings().list.iter().map(|w| (w.line, w.word.as_str(), w.occurrences)).collect();
    assert_eq!(list, [(2, "WHATEVER", 2), (3, "ANOTHER", 1), (5, "BARE", 1)]);
    assert_eq!(program.warnings().total, 4);
    for statement in ["SWEEP/1,2,3", "GOSOMEWHERE/5", "P1=POINT/1,2", "MOVECIR/A", "X/A,1,2,3,B"] {
        assert!(fault(statement).detail.contains("may move the tool"), "{statement}");
    }
}

#[test]
fn words_that_are_known_and_move_the_tool_otherwise_are_refused_with_a_way_out() {
    for (statement, part) in [
        ("TLLFT,GOLFT/C1", "GOTO"),
        ("ROTABL/90", "axis"),
        ("SPLINE/1,2,3", "splines"),
        ("COPY/1,TRANSL,10,0,0,3", "transforms"),
        ("GOTO/1,2,3,0,0,1,0,0,1", "cutter-contact"),
    ] {
        let error = fault(statement);
        assert!(error.detail.contains(part), "{error}");
    }
}

#[test]
fn silent_words_are_silent_and_words_for_the_controller_are_passed_on() {
    let program = mm("MACHIN/MILL,1\nCUTTER/10.,0,5,0,0,0,30\nMODE/MILL\nPAINT/COLOR,4\nSELECT/TOOL,5\n\
                      CSI_SET_FLUTE_LENGTH/19.\nTDATA/MILL,3,3,3,WEIGHT,,ANGLE,\nAUXFUN/21\nRAPID\nGOTO/0,0,0");
    assert!(warnings(&program).is_empty());
    assert_eq!(program.events().iter().map(|event| event.kind).collect::<Vec<_>>(), [EventKind::Other]);
}

#[test]
fn the_paths_of_nx_begin_and_end_in_words_of_their_own() {
    let text = "TOOL PATH/MILL_1,TOOL,D10\nTLDATA/MILL,10.,0.,75.,0.,0.\nUNITS/MM\nMSYS/0,0,0,1,0,0,0,1,0\nPAINT/PATH\n\
                LOAD/TOOL,1,ADJUST,1\nRAPID\nGOTO/1.,2.,3.,0.,0.,1.\nEND-OF-PATH\n";
    let program = apt(text);
    assert_eq!(program.moves().len(), 1);
    assert!(warnings(&program).is_empty());
}

#[test]
fn what_follows_fini_is_not_read() {
    let program = apt("UNITS/MM\nRAPID\nGOTO/0,0,0\nFINI\nGOTO/1,1,1\n");
    assert_eq!(program.moves().len(), 1);
    assert_eq!(warnings(&program), ["what follows FINI is not read"]);
}

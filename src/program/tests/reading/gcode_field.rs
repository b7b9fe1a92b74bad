//! Small programs with the peculiarities of those that posts write.

use verne_program::{EventKind, MoveKind, ReadOptions, RotarySense};

use crate::{assert_near, events, gcode, tips, warnings};

fn switched(on: &str, off: &str) -> ReadOptions {
    ReadOptions {
        tcp_on: vec![on.parse().unwrap()],
        tcp_off: vec![off.parse().unwrap()],
        rotary_sense: RotarySense::Table,
        ..ReadOptions::default()
    }
}

#[test]
fn blanks_in_words_inverse_time_and_table_angles_beyond_a_turn() {
    let text = "(  blade  )\nM428 ;TCP\nG93\nS600 M3\nG0  X  16.339  Y -25.409  Z  33.353  A -71.841  C -35.930\n\
                G1  X   6.302  Y -11.560  Z  27.743  A -71.841  C -399.805  F 318\nM5\nG0  A 0 C 0\nG0  X 0 Y 0 Z40\n\
                M429 ;Restore\nM30\n";
    let program = gcode(text, &switched("M428", "M429"));
    assert_eq!(program.moves().len(), 4);
    let cut = program.moves()[1];
    assert_eq!((cut.line(), cut.tip()), (6, [6.302, -11.56, 27.743]));
    assert_eq!(
        cut.orientation(),
        verne_program::Orientation::Rotary { phi1: 71.841_f64.to_radians(), phi2: 399.805_f64.to_radians() }
    );
    assert_eq!(cut.feed().map(|feed| feed.unit), Some(verne_program::FeedUnit::InverseMinutes));
    assert_eq!(warnings(&program).len(), 1, "only that there is no unit");
}

#[test]
fn blocks_without_a_g_word_and_changes_of_the_feed_mode() {
    let text = "%\nM428 ;TCP\n(PART)\n( OPERATION=  ROUGH )\nG00 G17 G40 G90 G94\nZ5\nT1 M6\n\
                G54 X-49.65 Y-23.015 A0. C0. S630 M03\nG00 Z5.0 M08\nZ3.0\nG01 Z-6.625 F300.0\nX-49.375 F600.0\n\
                G02 X-44.662 Y-20.99 I4.051 J-2.93\nG01 X40.959\nG93\nG01 Z-7.056 F29.8332\nX39.636 A-5.5 F60.0\nG94\n\
                G00 Z-7.055\nG00 X0. Y0. A0 C0\nM429\nM30\n%\n";
    let program = gcode(text, &switched("M428", "M429"));
    assert_eq!(tips(&program)[0], [-49.65, -23.015, 5.0]);
    assert_eq!(program.moves()[0].line(), 8);
    // Z5 before X and Y are known, and Z5.0 at Z5, are no moves.
    let details = warnings(&program);
    assert!(details.iter().any(|detail| detail.contains("left out")), "{details:?}");
    assert_eq!(program.moves().iter().filter(|one| program.arc(one).is_some()).count(), 1);
    let last_cut = program.moves().iter().rfind(|one| one.kind() == MoveKind::Feed).unwrap();
    assert_near(last_cut.tip(), [39.636, -20.99, -7.056]);
    assert_eq!(last_cut.feed().map(|feed| feed.value), Some(60.0));
}

#[test]
fn one_code_that_toggles_and_c_over_several_turns_and_a_through_zero() {
    let text = "( TEST )\nG90 G21 G17          ( mm )\nG94\nM451                 ( ON )\nF300\n\
                G0 X0 Y0 Z10 A0 C0\nG1 X12.99 Y7.5   Z-7.5  A27  C390\nG1 X10    Y0     Z-19   A45  C1080\n\
                G1 X-25 Y7  Z-5  A-3  C10\nG1 X-20 Y8  Z-5  A0   C12\nG1 X-15 Y9  Z-5  A3   C13\n\
                G0 X0 Y0 Z20 A0 C0\nM451\nM2\n";
    let program = gcode(text, &switched("M451", "M451"));
    assert_eq!((program.moves().len(), program.warnings().total), (7, 0));
    let on = EventKind::CentrePointControl { on: true };
    assert_eq!(events(&program), [on, EventKind::CentrePointControl { on: false }]);
}

#[test]
fn a_fanuc_program_with_two_tools() {
    let text = "%\nO0001(BRACKET)\nN10 G21 G17 G40 G49 G80 G90 G69\nN20 G91 G28 Z0.\nN30 T1 M06\nN40 S8000 M03\n\
                N50 G90 G54 G00 G43.4 H01 X0. Y0. Z100. A0. C0.\nN60 G01 X10. Z5. A-20. C45. F1500.\nN70 G49\n\
                N80 G91 G28 Z0.\nN90 M01\nN100 T2 M06\nN110 G90 G43.4 H2 G0 X1 Y1 Z100 A0 C0\nN120 M30\n%";
    let program = gcode(text, &ReadOptions::default());
    assert_eq!(program.moves().len(), 3);
    assert_eq!(program.tools().iter().map(|tool| tool.number).collect::<Vec<_>>(), [Some(1), Some(2)]);
    let lengths: Vec<_> = events(&program)
        .into_iter()
        .filter_map(|kind| match kind {
            EventKind::LengthOffset { number } => Some(number),
            _ => None,
        })
        .collect();
    assert_eq!(lengths, [Some(1), None, Some(2)]);
    assert_eq!(events(&program).iter().filter(|kind| **kind == EventKind::Home).count(), 2);
}

//! Drilling cycles in the words of every system.

use verne_program::{Dwell, EventKind, MoveKind, Program};

use crate::{assert_near, fault, mm, tips, warnings};

/// The z of each move with its kind: r for a rapid, f for a feed.
fn strokes(program: &Program) -> String {
    let stroke = |one: &verne_program::Move| {
        let kind = if one.kind() == MoveKind::Rapid { 'r' } else { 'f' };
        format!("{kind}{}", one.tip()[2])
    };
    program.moves().iter().map(stroke).collect::<Vec<_>>().join(" ")
}

/// The strokes of one hole at (40, 0, 300), from above.
fn hole(cycle: &str) -> String {
    strokes(&mm(&format!("RAPID\nGOTO/40,0,400\nCYCLE/{cycle}\nGOTO/40,0,300\nCYCLE/OFF")))
}

#[test]
fn a_hole_is_expanded_in_the_words_of_every_system() {
    for (cycle, expected) in [
        // NX: the bottom is negative.
        ("DRILL,RAPTO,3.0,FEDTO,-25.0,RTRCTO,10.,MMPM,250.", "r400 r303 f275 r310"),
        // SolidWorks: the depth is positive.
        ("DRILL,FEDTO,10.,MMPM,275.59,RAPTO,3.,RTRCTO,25.,DWELL,0", "r400 r303 f290 r325"),
        // Creo.
        ("DRILL, DEPTH, 12.5, MMPM, 200.0, CLEAR, 2.0", "r400 r302 f287.5 r302"),
        ("DRILL, DEPTH, 12.5, MMPM, 200.0, CLEAR, 2.0, RETURN, 50", "r400 r302 f287.5 r350"),
        // Fusion: depth and clearance have no words; RAPTO leads down from the clearance.
        ("DRILL, 5.0, MMPM, 200.0, 2.0", "r400 r302 f295 r302"),
        ("DRILL, 5.0, MMPM, 200.0, 15, RAPTO, 10", "r400 r305 f295 r315"),
        ("REAM,DEPTH,5,CLEAR,2", "r400 r302 f295 f302"),
        ("BORE, 5.0, MMPM, 200.0, 2.0, 0.1, ORIENT, 0", "r400 r302 f295 f302"),
        ("DEEP, 9.0, INCR, 4.0, MMPM, 200.0, 1.0", "r400 r301 f297 r301 r297.5 f293 r301 r293.5 f291 r301"),
        ("DRILL,DEEP,RAPTO,1,FEDTO,-7,STEP1,4", "r400 r301 f297 r301 r297.5 f293 r301"),
        ("BRKCHP,DEPTH,7,STEP,4,CLEAR,1", "r400 r301 f297 r297.5 f293 r301"),
        ("DEEP2,FEDTO,7,RAPTO,1", "r400 r301 f293 r301"),
    ] {
        assert_eq!(hole(cycle), expected, "{cycle}");
    }
}

#[test]
fn the_points_until_cycle_off_are_holes_along_their_axis() {
    let program = mm(
        "RAPID\nGOTO/0,0,50\nCYCLE/DRILL,FEDTO,10,RAPTO,3\nGOTO/0,0,0\nGOTO/20,0,0,1,0,0\nCYCLE/OFF\nGOTO/9,9,9",
    );
    assert_eq!(
        tips(&program),
        [
            [0.0, 0.0, 50.0],
            [0.0, 0.0, 3.0],
            [0.0, 0.0, -10.0],
            [0.0, 0.0, 3.0],
            [23.0, 0.0, 0.0],
            [10.0, 0.0, 0.0],
            [23.0, 0.0, 0.0],
            [9.0, 9.0, 9.0]
        ]
    );
    assert_eq!(program.moves()[1..4].iter().map(verne_program::Move::line).collect::<Vec<_>>(), [5, 5, 5]);
    assert_eq!(program.moves()[4].axis(), [1.0, 0.0, 0.0]);
}

#[test]
fn between_holes_the_tool_rises_first_and_goes_over() {
    let program = mm("RAPID\nGOTO/0,0,5\nCYCLE/DRILL,FEDTO,10,RAPTO,2\nGOTO/0,0,0\nGOTO/20,0,8\nGOTO/40,0,0");
    let expected = [
        [0.0, 0.0, 5.0],
        [0.0, 0.0, 2.0],
        [0.0, 0.0, -10.0],
        [0.0, 0.0, 2.0],
        // Up, and over.
        [0.0, 0.0, 10.0],
        [20.0, 0.0, 10.0],
        [20.0, 0.0, -2.0],
        [20.0, 0.0, 10.0],
        // Over, and down.
        [40.0, 0.0, 10.0],
        [40.0, 0.0, 2.0],
        [40.0, 0.0, -10.0],
        [40.0, 0.0, 2.0],
    ];
    for (actual, expected) in tips(&program).into_iter().zip(expected) {
        assert_near(actual, expected);
    }
    assert_eq!(program.moves().len(), expected.len());
}

#[test]
fn the_feed_of_a_hole_is_that_of_its_cycle_or_of_fedrat() {
    let feeds = |text: &str| {
        let program = mm(text);
        program
            .moves()
            .iter()
            .filter_map(verne_program::Move::feed)
            .map(|feed| feed.value)
            .collect::<Vec<_>>()
    };
    assert_eq!(feeds("CYCLE/DRILL,5.0,MMPM,200,2\nFEDRAT/70,MMPM\nGOTO/0,0,0"), [200.0]);
    assert_eq!(feeds("CYCLE/DRILL,5.0,200,MMPM\nGOTO/0,0,0"), [200.0]);
    assert_eq!(feeds("CYCLE/DRILL,DEPTH,5,CLEAR,2\nFEDRAT/70,MMPM\nGOTO/0,0,0"), [70.0]);
}

#[test]
fn a_dwell_stands_at_the_bottom() {
    let program = mm("CYCLE/FACE,DEPTH,5,CLEAR,2,DWELL,1.5\nGOTO/0,0,0");
    let event = &program.events()[0];
    assert_eq!((event.kind, event.before), (EventKind::Dwell(Dwell::Seconds(1.5)), 2));
    assert_eq!(
        mm("CYCLE/DRILL,DEPTH,5,DWELL,REV,2\nGOTO/0,0,0").events()[0].kind,
        EventKind::Dwell(Dwell::Revolutions(2.0))
    );
}

#[test]
fn a_cycle_can_be_resumed_and_prepared() {
    let program = mm(
        "CYCLE/INIT\nCYCLE/DRILL,DEPTH,5,CLEAR,2\nGOTO/0,0,0\nCYCLE/OFF\nRAPID\nGOTO/9,0,2\nCYCLE/ON\nGOTO/9,0,0",
    );
    assert_eq!(strokes(&program), "r2 f-5 r2 r2 f-5 r2");
    assert!(fault("CYCLE/ON").detail.contains("a cycle before it"));
}

#[test]
fn a_tapping_cycle_says_what_it_leaves_out() {
    let program = mm("SPINDL/300,CLW\nCYCLE/TAP,DEPTH,8,MMPR,1.25,CLEAR,3\nGOTO/0,0,0");
    assert_eq!(strokes(&program), "r3 f-8 f3");
    assert!(warnings(&program)[0].contains("reversal"));
}

#[test]
fn a_cycle_that_cannot_be_expanded_is_refused() {
    for (text, word, part) in [
        ("CYCLE/DRILL,CLEAR,2\nGOTO/0,0,0", "CYCLE", "no depth"),
        ("CYCLE/DEPTH,2\nGOTO/0,0,0", "CYCLE", "kind"),
        ("CYCLE/BORE,BACK,DEPTH,5\nGOTO/0,0,0", "BACK", "accepted"),
        ("CYCLE/DRILL,DEPTH,5,CLEAR,-9\nGOTO/0,0,0", "CYCLE", "begins below"),
        ("CYCLE/DEEP,DEPTH,5,STEP,0\nGOTO/0,0,0", "CYCLE", "positive"),
        ("CYCLE/DEEP,DEPTH,5,STEP,.001\nGOTO/0,0,0", "GOTO", "1000 pecks"),
        ("CYCLE/DRILL,1,2,3,4\nGOTO/0,0,0", "CYCLE", "without words"),
        ("CYCLE/DRILL,DEPTH,CLEAR,2\nGOTO/0,0,0", "DEPTH", "needs a number"),
        ("CYCLE/DRILL,DEPTH,5\nGOTO/0,0,0\nGODLTA/1,0,0", "GODLTA", "GOTO"),
        ("CYCLE/DRILL,DEPTH,5\nGOTO/0,0,0\nCIRCLE/0,0,0,0,0,1", "CIRCLE", "CYCLE/OFF"),
    ] {
        let refused = crate::faults_of(verne_program::Format::Apt, format!("UNITS/MM\n{text}\n").as_bytes());
        let error = &refused.errors[0];
        assert_eq!(error.word, word, "{error}");
        assert!(error.detail.contains(part), "{error}");
    }
}

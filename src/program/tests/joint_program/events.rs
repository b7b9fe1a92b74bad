//! Events stand in their places, and texts stay texts.

use verne_program::joint_program::JointProgramOptions;
use verne_program::{Coolant, Dwell, EventKind, Rotation, Spindle};

use crate::reader::blocks;
use crate::{body, event, row, write};

const START: [f64; 5] = [600.0, 600.0, 600.0, 0.0, 0.0];

#[test]
fn events_stand_before_their_moves_and_the_next_block_is_complete() {
    let spindle = Spindle { speed: Some(6000.0), rotation: Some(Rotation::Clockwise) };
    let events = [
        event(0, EventKind::Tool { number: Some(3), length: None }, "LOADTL/3"),
        event(0, EventKind::Spindle(spindle), "SPINDL/6000,CLW"),
        event(1, EventKind::Coolant(Coolant::Flood), "COOLNT/ON"),
        event(2, EventKind::Dwell(Dwell::Seconds(1.5)), "DELAY/1.5"),
        event(2, EventKind::Dwell(Dwell::Revolutions(50.0)), "DELAY/50,REV"),
        event(3, EventKind::Coolant(Coolant::Off), "COOLNT/OFF"),
        event(3, EventKind::End, "END"),
    ];
    let at = |step, x, duration| row(step, [x, 600.0, 600.0, 0.0, 0.0], duration);
    let rows =
        [at(0, 600.0, None), at(1, 610.0, Some(1.0)), at(1, 611.0, Some(1.0)), at(2, 620.0, Some(1.0))];
    let (text, _) = write(&JointProgramOptions::default(), &events, &rows).unwrap();
    let expected = [
        "T3 M6",
        "S6000 M3",
        "G0 X600.0 Y600.0 Z600.0 A0.0 C0.0",
        "M8",
        "G1 X610.0 Y600.0 Z600.0 A0.0 C0.0 F60.0",
        "X611.0 F60.0",
        "G4 P1.500",
        "G4 P0.500",
        "G1 X620.0 Y600.0 Z600.0 A0.0 C0.0 F60.0",
        "M9",
    ];
    assert_eq!(body(&text), expected);
    assert!(text.ends_with("\nM30\n"));
}

#[test]
fn texts_cannot_leave_their_comments() {
    let evil = "x) G0 X0 (y\nG0 Z0\r\u{2028}M3 (LOGOPEN,/a) Ü";
    let kinds = [
        EventKind::Comment,
        EventKind::Other,
        EventKind::Home,
        EventKind::Frame,
        EventKind::Tool { number: None, length: None },
        EventKind::Coolant(Coolant::Through),
        EventKind::Dwell(Dwell::Revolutions(2.0)),
    ];
    let events: Vec<_> = kinds.into_iter().map(|kind| event(0, kind, evil)).collect();
    let options = JointProgramOptions { comments: vec![evil.to_owned()], ..JointProgramOptions::default() };
    let (text, _) = write(&options, &events, &[row(0, START, None)]).unwrap();
    assert!(text.is_ascii());
    let words: Vec<_> =
        blocks(&text).into_iter().map(|block| block.into_keys().collect::<String>()).collect();
    assert_eq!(words, ["G", "M", "M", "ACGXYZ", "M"]);
}

#[test]
fn an_insert_is_passed_on_as_it_is_and_the_position_is_stated_anew() {
    let events = [event(1, EventKind::Insert, "M64 M51")];
    let rows = [row(0, START, None), row(1, START, Some(1.0))];
    let (text, _) = write(&JointProgramOptions::default(), &events, &rows).unwrap();
    let complete = "X600.0 Y600.0 Z600.0 A0.0 C0.0";
    assert_eq!(body(&text), [format!("G0 {complete}"), "M64 M51".to_owned(), format!("G1 {complete} F60.0")]);
}

#[test]
fn an_insert_with_other_words_than_m_s_and_t_is_a_comment() {
    let texts = ["G0 X777", "G91", "Stock Size X95. Y150.", "G64 P0.01", "M98 P1000", "M8 (x) G0 Z0", "M99"];
    let events = texts.map(|text| event(1, EventKind::Insert, text));
    let rows = [row(0, START, None), row(1, [610.0, 600.0, 600.0, 0.0, 0.0], Some(1.0))];
    let (text, _) = write(&JointProgramOptions::default(), &events, &rows).unwrap();
    let blocks = blocks(&text);
    let words: Vec<_> = blocks.iter().map(|block| block.keys().collect::<String>()).collect();
    assert_eq!(words, ["G", "ACGXYZ", "ACFGXYZ", "M"]);
    assert!(text.contains("\n(not passed on: Stock Size X95. Y150.)\n"), "{text}");
    assert!(text.contains("\n(not passed on: M8 [x] G0 Z0)\n"), "{text}");
}

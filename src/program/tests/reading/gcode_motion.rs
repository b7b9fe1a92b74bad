//! Straight moves, modes, units and feeds.

use verne_program::{EventKind, Feed, FeedUnit, Format, MoveKind, ReadOptions, Units, read};

use crate::{assert_near, evenly, gcode, mm, nc, nc_fault, tips, warnings};

fn feeds(text: &str) -> Vec<Option<Feed>> {
    nc(text).moves().iter().map(verne_program::Move::feed).collect()
}

fn feed(value: f64, unit: FeedUnit) -> Feed {
    Feed { value, unit }
}

#[test]
fn motion_is_modal_and_bare_coordinates_move() {
    let program = nc("G0 X1 Y2 Z3\nX4\nG1 Z1 F100\nY5\nM8\nG0\nZ9");
    let moves: Vec<_> = program.moves().iter().map(|one| (one.line(), one.kind(), one.tip())).collect();
    let (rapid, cut) = (MoveKind::Rapid, MoveKind::Feed);
    assert_eq!(
        moves,
        [
            (2, rapid, [1.0, 2.0, 3.0]),
            (3, rapid, [4.0, 2.0, 3.0]),
            (4, cut, [4.0, 2.0, 1.0]),
            (5, cut, [4.0, 5.0, 1.0]),
            (8, rapid, [4.0, 5.0, 9.0])
        ]
    );
    assert!(nc_fault("X1 Y2 Z3").detail.contains("no motion is in force"));
}

#[test]
fn rapids_before_the_position_is_known_are_left_out_and_cuts_are_faults() {
    let program = nc("G0 Z50\nX1 Y2\nG1 Z5 F9");
    assert_eq!(tips(&program), [[1.0, 2.0, 50.0], [1.0, 2.0, 5.0]]);
    assert!(warnings(&program)[0].contains("left out"));
    let error = nc_fault("G0 Z50\nG1 X1 F9\nG1 Y2");
    assert_eq!(error.line, 3);
    assert!(error.detail.contains("not known yet"));
}

#[test]
fn incremental_coordinates_give_the_same_path() {
    let (mut absolute, mut incremental) = (Vec::new(), Vec::new());
    let (mut x, mut z) = (1.0, 3.0);
    for n in 1..50 {
        let (dx, dz) = (evenly(n, 0.1) * 20.0 - 10.0, evenly(n, 0.7) * 4.0 - 2.0);
        (x, z) = (x + dx, z + dz);
        absolute.push(format!("X{x:.17} Z{z:.17}"));
        incremental.push(format!("X{dx:.17} Z{dz:.17}"));
    }
    let absolute = format!("G0 X1 Y2 Z3\nG1 F100\n{}", absolute.join("\n"));
    let incremental = format!("G0 X1 Y2 Z3\nG91 G1 F100\n{}", incremental.join("\n"));
    let (absolute, incremental) = (nc(&absolute), nc(&incremental));
    for (one, other) in tips(&absolute).into_iter().zip(tips(&incremental)) {
        assert_near(one, other);
    }
    assert_eq!(absolute.moves().len(), incremental.moves().len());
}

#[test]
fn an_inch_is_25_4_mm_in_lengths_and_feeds() {
    let text = |scale: f64, unit: &str| {
        let word = |value: f64| format!("{:.17}", value / scale);
        format!(
            "{unit}\nG0 X{} Y{} Z{}\nG1 X{} F{}\nG2 X{} Y{} I{} J0\nG3 X{} Y{} R{}\nM30\n",
            word(25.4),
            word(0.0),
            word(50.8),
            word(-2.54),
            word(508.0),
            word(17.46),
            word(0.0),
            word(10.0),
            word(37.46),
            word(20.0),
            word(20.0)
        )
    };
    let mm = gcode(&text(1.0, "G21"), &ReadOptions::default());
    let inch = gcode(&text(25.4, "G20"), &ReadOptions::default());
    assert_eq!((mm.units(), inch.units()), (Units::Millimetres, Units::Inches));
    for (one, other) in mm.moves().iter().zip(inch.moves()) {
        assert_near(one.tip(), other.tip());
        assert_eq!(mm.arc(one).is_some(), inch.arc(other).is_some());
        let values = [one, other].map(|one| one.feed().map_or(0.0, |feed| feed.value));
        assert!((values[0] - values[1]).abs() < 1e-9, "{values:?}");
    }
}

#[test]
fn angles_and_their_feeds_are_degrees_in_inch_programs_too() {
    let program = gcode("G20 G43.4 H1\nG0 X1 Y0 Z2 A30 C90\nG1 C180 F500\nM30\n", &ReadOptions::default());
    let [first, second] = program.moves() else { panic!() };
    assert_near(first.tip(), [25.4, 0.0, 50.8]);
    assert_near(first.axis(), [0.5, 0.0, 0.75_f64.sqrt()]);
    assert_eq!(second.feed(), Some(feed(500.0, FeedUnit::DegreesPerMinute)));
}

#[test]
fn without_g20_and_g21_lengths_are_those_of_the_request_or_mm_with_a_warning() {
    let text = "G0 X1 Y0 Z0\nM30\n";
    let program = gcode(text, &ReadOptions::default());
    assert_eq!(tips(&program)[0][0], 1.0);
    assert!(warnings(&program)[0].contains("taken as mm"));
    let options = ReadOptions { units: Some(Units::Inches), ..ReadOptions::default() };
    let program = gcode(text, &options);
    assert_eq!((tips(&program)[0][0], program.warnings().total), (25.4, 0));
}

#[test]
fn a_feed_is_per_minute_inverse_time_or_per_turn() {
    use FeedUnit::{DegreesPerMinute, InverseMinutes, MillimetresPerMinute, MillimetresPerRevolution};
    let start = "G43.4 H1\nG0 X0 Y0 Z0\n";
    assert_eq!(
        feeds(&format!("{start}G1 X1 F100\nX2\nC5\nX3 C6")),
        [
            None,
            Some(feed(100.0, MillimetresPerMinute)),
            Some(feed(100.0, MillimetresPerMinute)),
            Some(feed(100.0, DegreesPerMinute)),
            Some(feed(100.0, MillimetresPerMinute))
        ]
    );
    assert_eq!(
        feeds(&format!("{start}G93 G1 X1 F4\nC5 F6\nG94 X2 F7")),
        [
            None,
            Some(feed(4.0, InverseMinutes)),
            Some(feed(6.0, InverseMinutes)),
            Some(feed(7.0, MillimetresPerMinute))
        ]
    );
    assert_eq!(feeds(&format!("{start}G95 G1 X1 F.2")), [None, Some(feed(0.2, MillimetresPerRevolution))]);
    for (text, word) in [("G1 X1 F0", "F0"), ("G1 X1 F-5", "F-5"), ("G1 X1 F9999999999", "F9999999999")] {
        assert_eq!(nc_fault(&format!("G0 X0 Y0 Z0\n{text}")).word, word);
    }
}

#[test]
fn a_feed_per_turn_without_a_speed_of_the_spindle_is_a_warning() {
    let per_turn =
        "a feed per turn of the spindle, which does not turn or has no speed (S, SPINDL): the drives decide";
    for (text, warned) in [
        ("G95 G1 X1 F.2", Some(3)),
        ("M3\nG95 G1 X1 F.2\nX2", Some(4)),
        ("S0 M3\nG95 G1 X1 F.2", Some(4)),
        ("S900 M3\nG95 G1 X1 F.2\nM5\nX2", Some(6)),
        ("S900 M3\nG95 G1 X1 F.2\nG94 M5\nX2 F9", None),
        ("S900\nM3\nG95 G1 X1 F.2", None),
        ("S900 M5\nM4\nG95 G1 X1 F.2", None),
        ("G95 G0 X1", None),
    ] {
        let program = nc(&format!("G0 X0 Y0 Z0\n{text}"));
        let found = program.warnings().list.iter().find(|warning| warning.detail == per_turn);
        assert_eq!(found.map(|warning| warning.line), warned, "{text}");
    }
    assert_eq!(warnings(&mm("FEDRAT/0.2,MMPR\nGOTO/0,0,0")), [per_turn]);
    assert!(warnings(&mm("SPINDL/900,RPM,CLW\nFEDRAT/0.2,MMPR\nGOTO/0,0,0")).is_empty());
}

#[test]
fn without_f_the_drives_decide() {
    for text in ["G1 X1", "G93 G1 X1 F5\nX2", "G94 G1 X1 F5\nG93 X2 F5\nG94 X3"] {
        let program = nc(&format!("G0 X0 Y0 Z0\n{text}"));
        assert_eq!(program.moves().last().and_then(verne_program::Move::feed), None, "{text}");
        assert_eq!(warnings(&program), ["a feed move without F: the drives decide"], "{text}");
    }
}

#[test]
fn moves_without_length_are_left_out_also_in_inverse_time() {
    let program = nc("G0 X0 Y0 Z0\nG93 G1 X1 F5\nX1 F7\nG1 X2 F9");
    assert_eq!(tips(&program), [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    assert_eq!(warnings(&program), ["a move without length and turning is left out"]);
}

#[test]
fn feeds_as_fast_as_rapid_feed_are_rapids() {
    let options = ReadOptions { rapid_feed: Some(5000.0), ..ReadOptions::default() };
    let kinds = |text: &str| -> Vec<MoveKind> {
        let text = format!("G0 X0 Y0 Z0\n{text}\nM30\n");
        gcode(&text, &options).moves()[1..].iter().map(verne_program::Move::kind).collect()
    };
    let (rapid, cut) = (MoveKind::Rapid, MoveKind::Feed);
    assert_eq!(kinds("G21 G1 X1 F9999\nX2 F4999\nX3 F5000"), [rapid, cut, rapid]);
    assert_eq!(kinds("G20 G1 X1 F200\nX2 F100"), [rapid, cut]);
    assert_eq!(kinds("G21 G93 G1 X1 F9999"), [cut]);
}

#[test]
fn after_the_reference_point_x_y_and_z_must_be_given() {
    let program = nc("G0 X0 Y0 Z5\nG91 G28 Z0\nG90 G0 X1 Y1 Z9\nG53 G0 Z0\nM8\nX2 Y2 Z2\nG30\nG0 X0 Y0 Z0");
    let homes: Vec<_> = program
        .events()
        .iter()
        .filter(|event| event.kind == EventKind::Home)
        .map(|event| (event.line, event.before, &*event.text))
        .collect();
    assert_eq!(homes, [(3, 1, "G28 Z0"), (5, 2, "G53 Z0"), (8, 3, "G30")]);
    assert!(warnings(&program)[0].contains("does not state"));
    for text in ["G28 Z0\nG0 X1 Y1", "G53 G0 Z0\nG1 Z5 F9", "G28\nG91 G0 X1 Y1 Z1", "G30\nG2 X5 Y0 I2 J0 F9"]
    {
        let error = nc_fault(&format!("G0 X0 Y0 Z5\n{text}"));
        assert_eq!(error.line, 4, "{error}");
        assert!(error.detail.contains("position is not known"), "{error}");
    }
    assert!(nc_fault("G0 X0 Y0 Z5\nG1 X1 F9\nG53 Z0").detail.contains("in a cut"));
}

#[test]
fn many_lines_are_read_in_chunks() {
    let text = (0..100_000).map(|n| format!("X{}.{:03}\n", n % 100, n % 1000)).collect::<Vec<_>>().concat();
    let text = format!("G21 G0 X0 Y0 Z0\nG1 F1000\n{text}M2\n");
    let mut reader = verne_program::Reader::new(Format::Gcode, &ReadOptions::default());
    for chunk in text.as_bytes().chunks(1000) {
        assert!(reader.push(chunk).is_continue());
    }
    let program = reader.finish().unwrap();
    assert_eq!(program, read(Format::Gcode, text.as_bytes(), &ReadOptions::default()).unwrap());
    assert_eq!(program.moves().last().map(verne_program::Move::line), Some(100_002));
}

//! Points, axes and feeds of CL text.

use verne_program::{EventKind, Feed, FeedUnit, Format, MoveKind, ReadOptions, Step, Units, read};

use crate::{apt, assert_near, fault, faults_of, mm, place, tips, warnings};

fn feeds(text: &str) -> Vec<Option<Feed>> {
    mm(text).moves().iter().map(verne_program::Move::feed).collect()
}

fn feed(value: f64, unit: FeedUnit) -> Feed {
    Feed { value, unit }
}

#[test]
fn a_rapid_holds_for_one_motion() {
    let program = mm("FEDRAT/100,MMPM\nRAPID\nGOTO/0,0,1\nGOTO/0,0,2\nRAPID/\nGOTO/0,0,3\nGOTO/0,0,4");
    let kinds: Vec<_> = program.moves().iter().map(verne_program::Move::kind).collect();
    assert_eq!(kinds, [MoveKind::Rapid, MoveKind::Feed, MoveKind::Rapid, MoveKind::Feed]);
    assert_eq!(program.moves()[2].feed(), None);
    assert!(program.moves()[3].feed().is_some());
}

#[test]
fn a_feed_has_value_and_unit_in_any_order() {
    use FeedUnit::{InverseMinutes, MillimetresPerMinute, MillimetresPerRevolution};
    for (words, expected) in [
        ("250.,MMPM", feed(250.0, MillimetresPerMinute)),
        ("MMPM,250.0000", feed(250.0, MillimetresPerMinute)),
        ("10, IPM", feed(254.0, MillimetresPerMinute)),
        ("2,FPM", feed(609.6, MillimetresPerMinute)),
        ("MMPR,.5", feed(0.5, MillimetresPerRevolution)),
        ("IPR,1", feed(25.4, MillimetresPerRevolution)),
        ("INVERS,12", feed(12.0, InverseMinutes)),
        ("300", feed(300.0, MillimetresPerMinute)),
        ("PERREV,2", feed(2.0, MillimetresPerRevolution)),
    ] {
        assert_eq!(feeds(&format!("FEDRAT/{words}\nGOTO/0,0,0")), [Some(expected)], "{words}");
    }
}

#[test]
fn a_feed_without_a_unit_is_in_the_unit_of_the_file() {
    let program = apt("UNITS/INCHES\nFEDRAT/10\nGOTO/1,2,3\nFINI\n");
    assert_eq!(program.moves()[0].feed(), Some(feed(254.0, FeedUnit::MillimetresPerMinute)));
    assert_near(program.moves()[0].tip(), [25.4, 50.8, 76.2]);
    assert_eq!(program.units(), Units::Inches);
}

#[test]
fn a_feed_that_is_not_understood_is_refused_at_its_word() {
    let error = fault("FEDRAT/100,FURLONG");
    assert_eq!(place(&error), (2, 12, "FURLONG"));
    assert!(error.detail.contains("MMPM"), "{error}");
    for words in ["", "MMPM", "1,2", "0,MMPM", "-5,MMPM"] {
        assert_eq!(fault(&format!("FEDRAT/{words}")).line, 2, "{words}");
    }
}

#[test]
fn a_feed_move_without_a_feed_is_a_warning() {
    let program = mm("GOTO/0,0,0");
    assert_eq!(program.moves()[0].feed(), None);
    assert_eq!(warnings(&program), ["a feed move without FEDRAT: the drives decide"]);
}

#[test]
fn the_unit_comes_from_the_file_or_from_the_request_and_is_asked_for_once() {
    let text = b"FEDRAT/100,MMPM\nGOTO/1,0,0\nGOTO/2,0,0\n";
    let refused = faults_of(Format::Apt, text);
    assert_eq!(refused.errors.iter().map(place).collect::<Vec<_>>(), [(2, 1, "GOTO")]);
    assert!(refused.errors[0].detail.contains("UNITS/MM"), "{refused}");
    let options = ReadOptions { units: Some(Units::Inches), ..ReadOptions::default() };
    assert_eq!(read(Format::Apt, text.as_slice(), &options).unwrap().moves()[0].tip(), [25.4, 0.0, 0.0]);
    // The file knows better than the request.
    let stated = read(Format::Apt, b"UNIT/MM\nGOTO/1,0,0\n".as_slice(), &options).unwrap();
    assert_eq!((stated.moves()[0].tip(), stated.units()), ([1.0, 0.0, 0.0], Units::Millimetres));
}

#[test]
fn three_numbers_keep_the_axis_and_multax_off_sets_it_upright() {
    let program =
        mm("GOTO/0,0,0\nGOTO/1,0,0,1.,0,0\nGOTO/2,0,0\nMULTAX/OFF\nGOTO/3,0,0\nMULTAX\nGOTO/4,0,0,0,1,0");
    let axes: Vec<_> = program.moves().iter().map(verne_program::Move::axis).collect();
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(axes, [z, x, x, z, y]);
}

#[test]
fn tlaxis_sets_the_axis_of_the_points_that_follow() {
    let program = mm("TLAXIS/0,-3,4\nGOTO/0,0,0");
    assert_eq!(program.moves()[0].axis(), [0.0, -0.6, 0.8]);
    assert_eq!(fault("TLAXIS/0,0,0").line, 2);
    assert_eq!(fault("TLAXIS/NORMPS").word, "NORMPS");
}

#[test]
fn an_axis_is_a_unit_vector_without_negative_zeros() {
    let program = mm("GOTO/-0.0,0,0,-0.0,-0.,2.5");
    let one = program.moves()[0];
    assert_eq!(one.axis(), [0.0, 0.0, 1.0]);
    assert!(one.axis().iter().chain(&one.tip()).all(|n| n.is_sign_positive()));
    assert!(fault("GOTO/0,0,0,0,0,0").detail.contains("(0, 0, 0)"));
}

#[test]
fn noise_at_the_pole_is_kept_as_it_is() {
    let axis = mm("GOTO/0,0,0,-0.0000001,0.0000000,1.0000000").moves()[0].axis();
    assert!((axis[0] + 1e-7).abs() < 1e-20 && axis[2] <= 1.0, "{axis:?}");
}

#[test]
fn godlta_is_relative_and_a_single_number_is_along_the_axis() {
    let program = mm("GOTO/1,2,3,1,0,0\nGODLTA/1,1,1\nGODLTA/-5");
    assert_eq!(tips(&program)[1..], [[2.0, 3.0, 4.0], [-3.0, 3.0, 4.0]]);
    assert!(fault("GODLTA/1,1,1").detail.contains("GOTO"));
}

#[test]
fn from_is_where_the_tool_begins() {
    let program = mm("FROM/0,0,100\nFEDRAT/10,MMPM\nGOTO/0,0,50");
    assert_eq!(program.moves()[0].kind(), MoveKind::Rapid);
    assert!(program.warnings().list.is_empty());
    assert_eq!(warnings(&mm("RAPID\nGOTO/0,0,0\nFROM/1,0,0")).len(), 1);
}

#[test]
fn gohome_without_a_point_makes_the_position_unknown() {
    let program = mm("RAPID\nGOTO/0,0,0\nGOHOME\nRAPID\nGOTO/5,0,0");
    let starts: Vec<_> = program
        .steps()
        .filter_map(|step| match step {
            Step::Move(segment) => Some(segment.start.is_some()),
            Step::Event(_) => None,
        })
        .collect();
    assert_eq!(starts, [false, false]);
    assert_eq!(program.events()[0].kind, EventKind::Home);
    assert!(fault("GOTO/0,0,0\nGOHOME\nGODLTA/1,0,0").detail.contains("present point"));
    assert_eq!(tips(&mm("GOTO/0,0,0\nGOHOME/0,0,100"))[1], [0.0, 0.0, 100.0]);
}

#[test]
fn a_move_without_length_is_left_out_with_a_warning() {
    let program = mm("FEDRAT/INVERS,5\nGOTO/1,2,3\nGOTO/1,2,3\nGOTO/1,2,3,0,0,9\nGOTO/1,2,4");
    assert_eq!(tips(&program), [[1.0, 2.0, 3.0], [1.0, 2.0, 4.0]]);
    let warning = &program.warnings().list[0];
    assert_eq!((warning.line, warning.occurrences), (4, 2));
    assert!(warning.detail.contains("without length"));
}

#[test]
fn the_feed_of_a_turning_axis_is_no_speed_of_the_tip() {
    use FeedUnit::{DegreesPerMinute, InverseMinutes};
    let turn = "\nGOTO/0,0,0\nGOTO/0,0,0,0,-1,1";
    assert_eq!(feeds(&format!("FEDRAT/100,MMPM{turn}"))[1], None);
    assert_eq!(feeds(&format!("FEDRAT/DPM,360{turn}"))[1], Some(feed(360.0, DegreesPerMinute)));
    assert_eq!(feeds(&format!("FEDRAT/INVERS,4{turn}"))[1], Some(feed(4.0, InverseMinutes)));
    assert!(warnings(&mm(&format!("FEDRAT/100,MMPM{turn}")))[0].contains("the drives decide"));
}

#[test]
fn opposite_axes_at_the_ends_of_a_feed_move_are_refused() {
    let error = fault("GOTO/0,0,0,0,0,1\nGOTO/9,0,0,0,0,-1");
    assert_eq!(place(&error), (3, 1, "GOTO"));
    assert!(error.detail.contains("opposite"));
    assert_eq!(fault("GOTO/0,0,0,1e-12,0,1\nGOTO/9,0,0,0,0,-1").line, 3);
    assert_eq!(mm("GOTO/0,0,0,0,0,1\nRAPID\nGOTO/9,0,0,0,0,-1").moves().len(), 2);
    assert_eq!(mm("GOTO/0,0,0,1e-6,0,1\nGOTO/9,0,0,0,0,-1").moves().len(), 2);
}

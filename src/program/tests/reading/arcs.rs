//! Arcs of CL text: CIRCLE, MOVARC and TLON.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use verne_program::{MoveKind, Program, Segment, Step};

use crate::{assert_near, fault, mm};

fn segments(program: &Program) -> Vec<Segment<'_>> {
    let segment = |step| if let Step::Move(segment) = step { Some(segment) } else { None };
    program.steps().filter_map(segment).collect()
}

/// The sweep of the last move; none if it is straight.
fn last_sweep(program: &Program) -> Option<f64> {
    segments(program).last().unwrap().arc.map(verne_program::Arc::sweep)
}

#[track_caller]
fn assert_sweep(text: &str, expected: f64) {
    let sweep = last_sweep(&mm(text)).unwrap();
    assert!((sweep - expected).abs() < 1e-9, "{sweep}, not {expected}");
}

#[test]
fn a_circle_turns_right_handed_about_its_normal_to_the_next_point() {
    assert_sweep("GOTO/10,0,5\nCIRCLE/0,0,5,0,0,1.\nGOTO/0,10,5", FRAC_PI_2);
    assert_sweep("GOTO/10,0,5\nCIRCLE/0,0,5,0,0,-1.\nGOTO/0,10,5", 3.0 * FRAC_PI_2);
    let program = mm("GOTO/10,0,5\nCIRCLE/0,0,5,0,0,-1.,10.\nFEDRAT/9,MMPM\nGOTO/0,-10,5");
    let arc = segments(&program)[1];
    let half = 50_f64.sqrt();
    assert_near(arc.tip_at(0.5), [half, -half, 5.0]);
    assert!((arc.length() - 5.0 * PI).abs() < 1e-9);
    assert_eq!((arc.end.line(), arc.end.kind(), arc.end.feed().unwrap().value), (5, MoveKind::Feed, 9.0));
}

#[test]
fn an_end_on_the_start_is_a_full_circle() {
    assert_sweep("GOTO/10,0,5\nCIRCLE/0,0,5,0,0,1\nGOTO/10,0,5", TAU);
    let bounds = mm("GOTO/10,0,5\nCIRCLE/0,0,5,0,0,1\nGOTO/10,0,5").bounds().unwrap();
    assert_near(bounds.min, [-10.0, -10.0, 5.0]);
    assert_near(bounds.max, [10.0, 10.0, 5.0]);
}

#[test]
fn an_end_above_the_plane_is_a_helix_and_times_adds_turns() {
    assert_sweep("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/10,0,-2", TAU);
    assert_sweep("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10.,.06,.5,20.,0.,TIMES,3\nGOTO/0,10,-6", 4.5 * PI);
}

#[test]
fn the_normal_may_be_oblique_and_the_axis_may_turn_along_the_arc() {
    let program = mm("GOTO/10,0,0,0,0,1\nCIRCLE/0,0,0,0,-1,0\nGOTO/0,0,10,0,-1,1");
    let arc = segments(&program)[1];
    let half = 50_f64.sqrt();
    assert_near(arc.tip_at(0.5), [half, 0.0, half]);
    assert_ne!(arc.end.axis(), arc.start.unwrap().axis());
}

#[test]
fn the_end_may_miss_the_circle_by_its_tolerance_and_stays_the_end() {
    let program = mm("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/0,10.015,0");
    assert_eq!(segments(&program)[1].tip_at(1.0), [0.0, 10.015, 0.0]);
    assert!(fault("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/0,10.1,0").detail.contains("misses the circle"));
}

#[test]
fn a_circle_needs_a_start_an_end_a_normal_and_its_radius() {
    for (text, line, part) in [
        ("CIRCLE/0,0,0,0,0,1\nGOTO/0,10,0", 3, "present point"),
        ("GOTO/1,0,0\nCIRCLE/0,0,0,0,0,1\nCIRCLE/0,0,0,0,0,1\nGOTO/0,1,0", 4, "no end"),
        ("GOTO/1,0,0\nCIRCLE/0,0,0,0,0,1", 4, "before the end of a circle"),
        ("GOTO/1,0,0\nCIRCLE/0,0,0,0,0,0", 3, "normal"),
        ("GOTO/1,0,0\nCIRCLE/0,0,0", 3, "six numbers"),
        ("GOTO/9,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,9,0", 4, "not 10.000000 mm as stated"),
        ("GOTO/0,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/0,0,0", 4, "begins at its centre"),
    ] {
        let error = fault(text);
        assert_eq!(error.line, line, "{error}");
        assert!(error.detail.contains(part), "{error}");
    }
}

#[test]
fn a_rapid_may_be_an_arc() {
    let program = mm("RAPID\nGOTO/1,0,0\nRAPID\nCIRCLE/0,0,0,0,0,1\nGOTO/0,1,0");
    assert_eq!(program.moves()[1].kind(), MoveKind::Rapid);
    assert!(last_sweep(&program).is_some());
}

#[test]
fn after_the_end_of_a_circle_a_chord_is_straight() {
    assert_eq!(last_sweep(&mm("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/0,10,0\nGOTO/-10,0,0")), None);
}

#[test]
fn a_circle_of_creo_has_points_up_to_its_end() {
    let circle = "GOTO / 10, 0, 0\nCIRCLE / 0, 0, 0,  $\n0, 0, 1, 10\nGOTO / 0, 10, 0\nGOTO / -10, 0, 0";
    assert_sweep(circle, FRAC_PI_2);
    // The next point leaves the circle; a point after a full turn would go on beyond it.
    assert_eq!(last_sweep(&mm(&format!("{circle}\nGOTO / -10, -5, 0"))), None);
    let full = format!("{circle}\nGOTO / 0, -10, 0\nGOTO / 10, 0, 0");
    assert_sweep(&full, FRAC_PI_2);
    assert_eq!(last_sweep(&mm(&format!("{full}\nGOTO / 0, 10, 0"))), None);
    // Any other word ends it.
    assert_eq!(last_sweep(&mm(&format!("{circle}\nRAPID\nGOTO / 0, -10, 0"))), None);
}

#[test]
fn creo_is_known_by_its_header_and_may_write_rows_of_numbers() {
    let header = "$$*         Pro/CLfile  Version 11.0 - 11.0.0.0\n";
    let text = format!("{header}GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1\nGOTO/0,10,0\n-10,0,0\n0,-10,0");
    let program = mm(&text);
    assert_eq!(segments(&program).iter().filter(|segment| segment.arc.is_some()).count(), 3);
    assert!(fault("GOTO/1,2,3\n4,5,6").detail.contains("ends with $"));
}

#[test]
fn movarc_states_its_angle() {
    assert_sweep("GOTO/0,0,300\nMOVARC/10.0, 0, 300, 0, 0, -1, 10, ANGLE, 180.0\nGOTO/20,0,300", PI);
    assert_sweep("GOTO/0,0,0\nMOVARC/10,0,0,0,0,1,10,ANGLE,900\nGOTO/20,0,4", 5.0 * PI);
    assert!(fault("GOTO/0,0,0\nMOVARC/9,0,0,0,0,1,9,ANGLE,90\nGOTO/18,0,0").detail.contains("stated angle"));
    assert!(fault("GOTO/0,0,0\nMOVARC/9,0,0,0,0,1,9").detail.contains("ANGLE"));
}

fn exit(direction: &str, exit: &str) -> String {
    format!("GOTO/10,0,5\nINDIRV/{direction}\nTLON,GOFWD/ (CIRCLE/ 0, 0, 0,$\n   10),{exit}")
}

#[test]
fn an_exit_line_ends_an_arc_that_begins_in_the_stated_direction() {
    let program = mm(&exit("0.00000, 1.00000, 0.00000", "ON,(LINE/ 0,0,0,$\n 0,10,0)"));
    assert!((last_sweep(&program).unwrap() - FRAC_PI_2).abs() < 1e-9);
    assert_near(program.moves()[1].tip(), [0.0, 10.0, 5.0]);
    let program = mm(&exit("0,-1,0", "ON,2,INTOF,(LINE/0,0,0,0,10,0)"));
    assert!((last_sweep(&program).unwrap() - 3.0 * FRAC_PI_2).abs() < 1e-9);
    // A line that goes on beyond the circle: the number of the intersection decides.
    assert_near(mm(&exit("0,1,0", "ON,(LINE/0,-20,0,0,20,0)")).moves()[1].tip(), [0.0, 10.0, 5.0]);
    assert_near(mm(&exit("0,1,0", "ON,2,INTOF,(LINE/0,-20,0,0,20,0)")).moves()[1].tip(), [0.0, -10.0, 5.0]);
    // The end on the start: a full circle.
    let program = mm(&exit("0,1,0", "ON,2,INTOF,(LINE/0,0,0,10,0,0)"));
    assert_eq!(last_sweep(&program), Some(TAU));
}

#[test]
fn an_exit_line_arc_lies_in_the_plane_of_psis_or_across_the_axis() {
    let text = "GOTO/0,10,0,1,0,0\nAUTPS\nINDIRV/0,0,1\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,0,10)";
    assert_near(mm(text).moves()[1].tip(), [0.0, 0.0, 10.0]);
    let text = "GOTO/0,10,0\nPSIS/(PLANE/1,0,0,0)\nINDIRV/0,0,1\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,0,10)";
    assert_near(mm(text).moves()[1].tip(), [0.0, 0.0, 10.0]);
}

#[test]
fn an_exit_line_that_does_not_fit_is_refused() {
    for (text, part) in [
        (exit("1,0,0", "ON,(LINE/0,0,0,0,10,0)"), "along the circle"),
        (exit("0,1,0", "ON,(LINE/30,0,0,30,10,0)"), "does not meet"),
        (exit("0,1,0", "ON,3,INTOF,(LINE/0,0,0,0,10,0)"), "two intersections"),
        (exit("0,1,0", "ON,(LINE/0,0,0"), "accepted"),
        (exit("0,1,0", "TO,(LINE/0,0,0,0,10,0)"), "ON is expected"),
        (exit("0,1,0", "ON,(LINE/0,0,0,0,10,0)").replace("GOTO/10", "GOTO/11"), "as stated"),
        (exit("0,1,0", "ON,(LINE/0,0,0,0,10,0)").replace("CIRCLE", "CYLNDR"), "CIRCLE is expected"),
        ("GOTO/1,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,1),ON,(LINE/0,0,0,0,1,0)".to_owned(), "INDIRV"),
        ("TLON,GORGT/(CIRCLE/0,0,0,1),ON,(LINE/0,0,0,0,1,0)".to_owned(), "GOFWD"),
    ] {
        let error = fault(&text);
        assert!(error.detail.contains(part), "{error}");
    }
}

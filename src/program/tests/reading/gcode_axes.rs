//! Words A, B and C and axis vectors under control of the tool centre point.

use std::f64::consts::FRAC_PI_2;

use verne_program::{EventKind, Orientation, ReadOptions, RotarySense};

use crate::{assert_near, events, gcode, nc, nc_fault, nc_faults, place, tcp};

fn rotary(text: &str, options: &ReadOptions) -> Vec<[f64; 2]> {
    let program = gcode(&format!("G21 G43.4 H1\n{text}\nM30\n"), options);
    let words = |one: &verne_program::Move| match one.orientation() {
        Orientation::Rotary { phi1, phi2 } => [phi1.to_degrees(), phi2.to_degrees()],
        Orientation::Vector(axis) => panic!("{axis:?}"),
    };
    program.moves().iter().map(words).collect()
}

#[track_caller]
fn assert_words(actual: &[[f64; 2]], expected: &[[f64; 2]]) {
    assert_eq!(actual.len(), expected.len(), "{actual:?}");
    for (one, other) in actual.iter().flatten().zip(expected.iter().flatten()) {
        assert!((one - other).abs() < 1e-9, "{actual:?}, not {expected:?}");
    }
}

#[test]
fn a_and_c_are_phi1_and_phi2_and_are_not_reduced() {
    let options = ReadOptions::default();
    let text = "G0 X0 Y0 Z0 A30 C0\nG1 C1080 F100\nA-10\nG91 C-1500 A5\nG90 X1";
    assert_words(
        &rotary(text, &options),
        &[[30.0, 0.0], [30.0, 1080.0], [-10.0, 1080.0], [-5.0, -420.0], [-5.0, -420.0]],
    );
    let table = ReadOptions { rotary_sense: RotarySense::Table, ..options };
    assert_words(&rotary("G0 X0 Y0 Z0 A30 C-399.8", &table), &[[-30.0, 399.8]]);
}

#[test]
fn b_and_c_are_an_axis_rotated_about_y_and_then_z() {
    for (sense, sign) in [(RotarySense::Tool, 1.0), (RotarySense::Table, -1.0)] {
        let options = ReadOptions { rotary_sense: sense, ..ReadOptions::default() };
        let program = gcode("G21 G43.4 H1 G0 X0 Y0 Z0\nB30 C50\nM30\n", &options);
        let (b, c) = ((sign * 30.0_f64).to_radians(), (sign * 50.0_f64).to_radians());
        assert_near(program.moves()[1].axis(), [b.sin() * c.cos(), b.sin() * c.sin(), b.cos()]);
        // Before B is known the axis is upright, and C counts from the same place.
        assert_eq!(program.moves()[0].orientation(), Orientation::Rotary { phi1: 0.0, phi2: FRAC_PI_2 });
    }
}

#[test]
fn a_turn_at_the_pole_is_a_move() {
    let program = tcp("G0 X0 Y0 Z0\nG1 C360 F100\nC0");
    assert_eq!(program.moves().len(), 3);
    assert!(program.moves().iter().all(|one| one.axis() == [0.0, 0.0, 1.0]));
}

#[test]
fn with_g43_5_the_axis_is_a_vector() {
    let program = nc("G43.5 H2\nG0 X0 Y0 Z0\nG1 X1 I0 J-3 K4 F9\nX2\nK-1 J-0 I1");
    let axes: Vec<_> = program.moves().iter().map(verne_program::Move::orientation).collect();
    let d = 0.5_f64.sqrt();
    assert_eq!(axes[0], Orientation::Rotary { phi1: 0.0, phi2: 0.0 });
    assert_eq!(axes[1], Orientation::Vector([0.0, -0.6, 0.8]));
    assert_eq!(axes[2], axes[1]);
    assert_near(axes[3].axis(), [d, 0.0, -d]);
    assert!(nc_fault("G43.5 H2\nG0 X0 Y0 Z0 I0 K0").detail.contains("(0, 0, 0)"));
    assert!(nc_fault("G43.5 H2\nG0 X0 Y0 Z0 A5").detail.contains("I, J, K"));
    assert!(nc_fault("G43.4 H2\nG0 X0 Y0 Z0\nG1 X1 K1 F9").detail.contains("G43.5"));
    // Opposite axes in a cut have no plane.
    assert!(nc_fault("G43.5 H2\nG0 X0 Y0 Z0 K1\nG1 X1 J1 K1 F1\nJ-1 K-1").detail.contains("opposite"));
}

#[test]
fn angles_without_control_of_the_centre_point_are_one_fault_that_says_so() {
    let error = nc_fault("G43 H1\nG0 X0 Y0 Z0\nG1 X1 A10 C20 F9\nX2 A20");
    assert_eq!(place(&error), (4, 7, "A10"));
    for part in ["off", "G43.4", "tcp_on"] {
        assert!(error.detail.contains(part), "{error}");
    }
    assert!(nc_fault("G43.4 H1\nG0 X0 Y0 Z0 A0\nG49\nG0 C10").detail.contains("off"));
}

#[test]
fn the_request_can_say_that_control_is_on_or_which_codes_switch_it() {
    let text = "G21\nG0 X0 Y0 Z0 A5 C6\nG49\nA7\nM30\n";
    assert_eq!(gcode(text, &ReadOptions { tcp: true, ..ReadOptions::default() }).moves().len(), 2);
    let codes = |on: &[&str], off: &[&str]| ReadOptions {
        tcp_on: on.iter().map(|code| code.parse().unwrap()).collect(),
        tcp_off: off.iter().map(|code| code.parse().unwrap()).collect(),
        ..ReadOptions::default()
    };
    let program = gcode("G21\nM428\nG0 X0 Y0 Z0 A5\nA0\nM429\nG1 X1 F9\nM30\n", &codes(&["M428"], &["M429"]));
    let switched = |on| EventKind::CentrePointControl { on };
    assert_eq!(events(&program), [switched(true), switched(false)]);
    assert_eq!((program.events()[0].before, program.events()[1].before), (0, 2));
    assert_eq!(program.warnings().total, 0);
    // One code that does both.
    let program = gcode("G21\nM451\nG0 X0 Y0 Z0 A0\nM451\nG1 X1 F9\nM30\n", &codes(&["M451"], &["M451"]));
    assert_eq!(events(&program), [switched(true), switched(false)]);
    // A G code that nobody else knows.
    let program = gcode("G21\nG234 H3\nG0 X0 Y0 Z0 A0\nG49\nM30\n", &codes(&["G234"], &["G49"]));
    let length = |number| EventKind::LengthOffset { number };
    assert_eq!(events(&program), [length(Some(3)), switched(true), length(None), switched(false)]);
}

#[test]
fn after_control_ends_tilted_a_rapid_leaves_and_a_cut_is_refused() {
    let program = tcp("G0 X0 Y0 Z0 A30 C0\nG49\nG0 Z100\nG43.4 H1\nG0 X1 Y1 Z1");
    let kinds = events(&program);
    assert!(kinds.contains(&EventKind::Home), "{kinds:?}");
    assert_eq!(program.moves().len(), 2);
    let errors = nc_faults("G43.4 H1\nG0 X0 Y0 Z0 A0 C90\nG49\nG1 Z5 F9\nX1\nY5");
    assert_eq!((errors.len(), errors[0].line), (1, 5));
    assert!(errors[0].detail.contains("part is turned"), "{errors:?}");
}

#[test]
fn a_with_b_is_refused() {
    let error = nc_fault("G43.4 H1\nG0 X0 Y0 Z0 A1 B2 C3");
    assert_eq!(place(&error), (3, 16, "B2"));
    assert_eq!(nc_fault("G43.4 H1\nG0 X0 Y0 Z0 A1\nB2").line, 4);
    assert!(nc_fault("G43.4 H1\nG0 X0 Y0 Z0 C2000000").detail.contains("1000000 degrees"));
}

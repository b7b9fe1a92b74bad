//! G2 and G3 in their three planes, with centres and radii.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use verne_program::{Program, Segment, Step};

use crate::{assert_near, evenly, nc, nc_fault, tcp};

/// The segments of a program.
fn segments(program: &Program) -> Vec<Segment<'_>> {
    let moves = |step| match step {
        Step::Move(segment) => Some(segment),
        Step::Event(_) => None,
    };
    program.steps().filter_map(moves).collect()
}

#[track_caller]
fn assert_last(text: &str, sweep: f64, middle: [f64; 3]) {
    let program = nc(text);
    let last = *segments(&program).last().unwrap();
    let arc = last.arc.unwrap();
    assert!((arc.sweep() - sweep).abs() < 1e-9, "{text}: {arc:?}");
    assert_near(last.tip_at(0.5), middle);
}

#[test]
fn arcs_turn_in_their_plane_with_centre_or_radius() {
    let d = 50_f64.sqrt();
    for (text, sweep, middle) in [
        ("G0 X10 Y0 Z0\nG3 X0 Y10 I-10 J0 F9", FRAC_PI_2, [d, d, 0.0]),
        ("G0 X10 Y0 Z0\nG3 X0 Y10 I-10 F9", FRAC_PI_2, [d, d, 0.0]),
        ("G0 X10 Y0 Z0\nG3 X0 Y10 R10 F9", FRAC_PI_2, [d, d, 0.0]),
        ("G0 X10 Y0 Z0\nG3 X0 Y-10 I-10 F9", 3.0 * FRAC_PI_2, [-d, d, 0.0]),
        ("G0 X10 Y0 Z0\nG3 X0 Y-10 R-10 F9", 3.0 * FRAC_PI_2, [-d, d, 0.0]),
        ("G0 X10 Y0 Z0\nG2 X0 Y-10 R10 F9", FRAC_PI_2, [d, -d, 0.0]),
        ("G0 X10 Y0 Z0\nG2 X0 Y10 R-10 F9", 3.0 * FRAC_PI_2, [-d, -d, 0.0]),
        ("G0 X10 Y0 Z0\nG3 X-10 R10 F9", PI, [0.0, 10.0, 0.0]),
        ("G0 X10 Y0 Z0\nG90.1 G3 X0 Y10 I0 J0 F9", FRAC_PI_2, [d, d, 0.0]),
        ("G0 X10 Y0 Z0\nG17 G3 X0 Y10 I-10 K0 F9", FRAC_PI_2, [d, d, 0.0]),
        // Seen against the y axis, z is to the left of x.
        ("G0 X0 Y0 Z10\nG18 G3 X10 Z0 K-10 F9", FRAC_PI_2, [d, 0.0, d]),
        ("G0 X0 Y0 Z10\nG18 G3 X10 Z0 R10 F9", FRAC_PI_2, [d, 0.0, d]),
        ("G0 X0 Y10 Z0\nG19 G3 Y0 Z10 J-10 F9", FRAC_PI_2, [0.0, d, d]),
        ("G0 X0 Y10 Z0\nG19 G2 Y0 Z-10 R10 F9", FRAC_PI_2, [0.0, d, -d]),
        // Full circles, with and without their end.
        ("G0 X10 Y0 Z0\nG3 I-10 F9", TAU, [-10.0, 0.0, 0.0]),
        ("G0 X10 Y0 Z0\nG2 X10 Y0 I-10 J0 F9", TAU, [-10.0, 0.0, 0.0]),
        // Helices.
        ("G0 X10 Y0 Z0\nG3 X0 Y10 Z-4 I-10 F9", FRAC_PI_2, [d, d, -2.0]),
        ("G0 X10 Y0 Z0\nG3 Z-4 I-10 F9", TAU, [-10.0, 0.0, -2.0]),
        ("G0 X10 Y0 Z0\nG3 Z-4 I-10 P2 F9", 2.0 * TAU, [10.0, 0.0, -2.0]),
        ("G0 X10 Y0 Z0\nG3 X0 Y10 Z-5 I-10 P3 F9", 4.5 * PI, [d, d, -2.5]),
        ("G0 X10 Y0 Z0\nG91 G3 X-10 Y10 I-10 F9", FRAC_PI_2, [d, d, 0.0]),
    ] {
        assert_last(text, sweep, middle);
    }
    let program = nc("G0 X10 Y0 Z0\nG3 X0 Y10 I-10 F9\nX-10 Y0 J-10\nG1 X0");
    assert_eq!(segments(&program).iter().filter(|one| one.arc.is_some()).count(), 2);
}

#[test]
fn random_arcs_keep_their_radius_and_end_where_the_block_says() {
    for n in 0..200 {
        let random = |seed: f64| evenly(n, seed);
        let (cx, cy, radius) =
            (random(0.1) * 200.0 - 100.0, random(0.23) * 200.0 - 100.0, 0.1 + random(0.37) * 300.0);
        let (from, sweep) = (random(0.41) * TAU, 0.01 + random(0.59) * (TAU - 0.02));
        let counter = n % 2 == 0;
        let to = if counter { from + sweep } else { from - sweep };
        let at = |angle: f64| [cx + radius * angle.cos(), cy + radius * angle.sin()];
        let ([x0, y0], [x1, y1]) = (at(from), at(to));
        let code = if counter { 3 } else { 2 };
        let signed = if sweep > PI { -radius } else { radius };
        let centre = format!("I{:.12} J{:.12}", cx - x0, cy - y0);
        let with_radius = format!("R{signed:.12}");
        // Near a half turn the chord says little about the centre.
        let near_half = (sweep - PI).abs() < 0.1;
        for form in [Some(centre), Some(with_radius).filter(|_| !near_half)].into_iter().flatten() {
            let program =
                nc(&format!("G0 X{x0:.12} Y{y0:.12} Z7\nG{code} X{x1:.12} Y{y1:.12} Z9 {form} F500"));
            let last = *segments(&program).last().unwrap();
            assert!((last.arc.unwrap().sweep() - sweep).abs() < 1e-6, "{form}");
            for k in 0..=16 {
                let t = f64::from(k) / 16.0;
                let [x, y, z] = last.tip_at(t);
                let error = (x - cx).hypot(y - cy) - radius;
                assert!(error.abs() < 1e-6 * radius.max(1.0), "{form}: {error}");
                assert!((z - 7.0 - 2.0 * t).abs() < 1e-9);
            }
            assert_eq!(
                last.tip_at(1.0).map(|n| format!("{n:.12}"))[..2],
                [format!("{x1:.12}"), format!("{y1:.12}")]
            );
        }
    }
}

#[test]
fn the_end_may_miss_the_radius_and_the_arc_still_ends_there() {
    let program = nc("G0 X10 Y0 Z0\nG3 X0 Y10.019 I-10 F9");
    assert_eq!(program.moves()[1].tip(), [0.0, 10.019, 0.0]);
    let error = nc_fault("G0 X10 Y0 Z0\nG3 X0 Y10.021 I-10 F9");
    assert_eq!(error.line, 3);
    assert!(error.detail.contains("misses the circle"), "{error}");
    assert_last("G0 X10 Y0 Z0\nG3 X-10 R9.9999 F9", PI, [0.0, 10.0, 0.0]);
    assert!(nc_fault("G0 X10 Y0 Z0\nG3 X-10 R9.9 F9").detail.contains("at least 10.0"));
}

#[test]
fn the_axis_turns_along_an_arc() {
    let program = tcp("G0 X10 Y0 Z0 A10 C0\nG3 X-10 Y0 I-10 A20 C180 F500");
    let [_, arc] = program.moves() else { panic!() };
    assert!(program.arc(arc).is_some());
    assert_near(arc.axis(), [0.0, 20_f64.to_radians().sin(), 20_f64.to_radians().cos()]);
    let vector = nc("G43.5 H1\nG0 X10 Y0 Z0 I0 J-3 K4\nG3 X-10 Y0 I-10 J0 F500");
    let [first, second] = vector.moves() else { panic!() };
    assert_eq!((first.axis(), second.axis()), ([0.0, -0.6, 0.8], [0.0, -0.6, 0.8]));
    assert_eq!(vector.arc(second).unwrap().centre(), [0.0; 3]);
}

#[test]
fn an_arc_that_is_none_is_refused() {
    for (block, word, part) in [
        ("G3 X0 Y10 F9", "G3", "no centre"),
        ("G3 X0 Y10 I-10 R10 F9", "R10", "both"),
        ("G3 X0 Y10 I-10 K1 F9", "K1", "accepted are I and J"),
        ("G18 G3 X0 Z10 I-10 J2 F9", "J2", "accepted are K and I"),
        ("G3 X10 Y0 R5 F9", "R5", "full circle"),
        ("G90.1 G3 X0 Y10 I0 F9", "G3", "both with G90.1"),
        ("G3 X0 Y10 I-10 P0 F9", "P0", "from 1 to 1000"),
        ("G3 X0 Y10 I-10 P1.5 F9", "P1.5", "whole number"),
        ("G3 X0 Y10 I0 J0 F9", "G3", "begins at its centre"),
        ("N20 G17 G90 G3 X0 Y11 I-10 F9", "G3", "misses the circle"),
    ] {
        let error = nc_fault(&format!("G0 X10 Y0 Z0\n{block}"));
        assert_eq!((error.line, error.word.as_str()), (3, word), "{error}");
        assert!(error.detail.contains(part), "{error}");
    }
    assert!(nc_fault("G0 Z5\nG3 X0 Y10 I-10 F9").detail.contains("not known"));
    assert!(nc_fault("G3 X0 Y10 Z0 I-10 F9").detail.contains("start of the arc"));
}

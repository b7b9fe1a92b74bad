//! Tilted planes.

use verne_program::{EventKind, MoveKind, Orientation};

use crate::{assert_near, events, nc, nc_fault, tips, warnings};

#[test]
fn points_in_a_tilted_plane_come_in_the_programs_frame() {
    // Rot(z, 90) Rot(x, 30): the plane's x axis is y, its y axis is tilted.
    let program =
        nc("G0 X0 Y0 Z100\nG68.2 X10 Y20 Z30 I90 J30 K0\nG53.1\nG0 X0 Y0 Z50\nG1 Z5 F100\nX7\nY4\nG69");
    let (s, c) = (0.5, 0.75_f64.sqrt());
    let normal = [s, 0.0, c];
    let point = |x: f64, y: f64, z: f64| [10.0 - c * y + s * z, 20.0 + x, 30.0 + s * y + c * z];
    let expected = [
        [0.0, 0.0, 100.0],
        [0.0, 0.0, 100.0],
        point(0.0, 0.0, 50.0),
        point(0.0, 0.0, 5.0),
        point(7.0, 0.0, 5.0),
        point(7.0, 4.0, 5.0),
    ];
    for (actual, expected) in tips(&program).into_iter().zip(expected) {
        assert_near(actual, expected);
    }
    assert_eq!(program.moves().len(), expected.len());
    for one in &program.moves()[1..] {
        assert_near(one.axis(), normal);
        assert!(matches!(one.orientation(), Orientation::Vector(_)));
    }
    assert_eq!(program.moves()[1].kind(), MoveKind::Rapid);
    assert!(warnings(&program)[0].contains("stand still"));
    assert_eq!(events(&program), [EventKind::TiltedPlane { on: true }, EventKind::TiltedPlane { on: false }]);
}

#[test]
fn the_third_angle_turns_the_plane_about_its_normal() {
    let program = nc("G0 X0 Y0 Z9\nG68.2 I0 J90 K90\nG53.1\nG0 X5 Y0 Z0");
    // Rot(x, 90): x stays, y becomes z, z becomes -y. Then x becomes the former y.
    assert_near(tips(&program)[2], [0.0, 0.0, 5.0]);
    assert_near(program.moves()[2].axis(), [0.0, -1.0, 0.0]);
}

#[test]
fn a_tool_that_stands_still_has_other_coordinates_in_another_plane() {
    let program = nc("G0 X1 Y2 Z3\nG68.2 X1 Y2 Z0 I0 J0 K90\nG0 Z8\nX0\nG69\nX0");
    let expected = [[1.0, 2.0, 3.0], [1.0, 2.0, 8.0], [0.0, 2.0, 8.0]];
    assert_eq!(program.moves().len(), 3, "{:?}", tips(&program));
    for (actual, expected) in tips(&program).into_iter().zip(expected) {
        assert_near(actual, expected);
    }
}

#[test]
fn arcs_lie_in_the_tilted_plane() {
    let program = nc("G0 X0 Y0 Z9\nG68.2 I0 J90 K0\nG53.1\nG0 X10 Y0 Z0\nG3 X0 Y10 I-10 F100");
    let last = program.moves().last().unwrap();
    let arc = program.arc(last).unwrap();
    assert_near(arc.normal(), [0.0, -1.0, 0.0]);
    assert_near(arc.centre(), [0.0; 3]);
    assert_near(last.tip(), [0.0, 0.0, 10.0]);
}

#[test]
fn lengths_of_a_plane_are_in_inches_and_angles_are_not() {
    let program = crate::gcode(
        "G20 G0 X0 Y0 Z9\nG68.2 X1 I90 J30\nG53.1\nG0 X0 Y0 Z1\nM30\n",
        &verne_program::ReadOptions::default(),
    );
    assert_near(tips(&program)[2], [25.4 + 12.7, 0.0, 25.4 * 0.75_f64.sqrt()]);
}

#[test]
fn planes_that_are_not_read_are_refused() {
    for (text, part) in [
        ("G53.1", "needs a tilted plane"),
        ("G68.2 P1 X0 Y0 Z0 I0 J0 K0", "Euler angles"),
        ("G68.2 Q123 X0 Y0 Z0 I0 J0 K0", "Euler angles"),
        ("G68.3 X0 Y0 Z0 R5", "G68.2 with G53.1"),
        ("G68.2 J30\nG43.4 H1\nG1 X1 A5 F9", "in a tilted plane"),
    ] {
        let error = nc_fault(&format!("G0 X0 Y0 Z9\n{text}"));
        assert!(error.detail.contains(part), "{error}");
    }
}

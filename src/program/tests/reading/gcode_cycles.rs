//! Drilling cycles as moves.

use verne_program::{Dwell, EventKind, MoveKind, Program};

use crate::{assert_near, nc, nc_fault, tcp, tips};

/// The z of each move with its kind: r for a rapid, f for a feed.
fn strokes(program: &Program) -> String {
    let stroke = |one: &verne_program::Move| {
        let kind = if one.kind() == MoveKind::Rapid { 'r' } else { 'f' };
        format!("{kind}{}", one.tip()[2])
    };
    program.moves().iter().map(stroke).collect::<Vec<_>>().join(" ")
}

/// The strokes of a hole from a height of 50.
fn hole(cycle: &str) -> String {
    strokes(&nc(&format!("G0 X0 Y0 Z50\n{cycle} F100\nG80")))
}

#[test]
fn a_cycle_is_expanded() {
    for (cycle, expected) in [
        ("G81 X9 Y0 Z-5 R2", "r50 r50 r2 f-5 r50"),
        ("G98 G81 X9 Y0 Z-5 R2", "r50 r50 r2 f-5 r50"),
        ("G99 G81 X9 Y0 Z-5 R2", "r50 r50 r2 f-5 r2"),
        ("G81 Z-5 R2", "r50 r2 f-5 r50"),
        ("G99 G82 X9 Z-5 R2 P1", "r50 r50 r2 f-5 r2"),
        ("G99 G83 X9 Z-5 R1 Q4", "r50 r50 r1 f-3 r1 r-2.5 f-5 r1"),
        ("G99 G73 X9 Z-5 R1 Q4", "r50 r50 r1 f-3 r-2.5 f-5 r1"),
        ("G99 G85 X9 Z-5 R1", "r50 r50 r1 f-5 f1"),
        ("G98 G85 X9 Z-5 R1", "r50 r50 r1 f-5 f1 r50"),
        ("G99 G89 X9 Z-5 R1 P1", "r50 r50 r1 f-5 f1"),
        ("G99 G91 G81 X9 Z-5 R-48", "r50 r50 r2 f-3 r2"),
        // The retract height is never below R.
        ("G98 G81 X9 Z-5 R60", "r50 r60 r60 f-5 r60"),
        ("G81 X9 Z-5 R2 L0", "r50"),
    ] {
        assert_eq!(hole(cycle), expected, "{cycle}");
    }
}

#[test]
fn the_blocks_that_follow_are_holes_until_g80_or_a_motion() {
    let program =
        nc("G0 X0 Y0 Z50\nG99 G81 X10 Y0 Z-5 R2 F100\nM8\nX20\nG98 X30 Z-7\nG80\nX40\nG81 Z-1 R1\nG0 Z9");
    assert_eq!(
        tips(&program),
        [
            [0.0, 0.0, 50.0],
            [10.0, 0.0, 50.0],
            [10.0, 0.0, 2.0],
            [10.0, 0.0, -5.0],
            [10.0, 0.0, 2.0],
            [20.0, 0.0, 2.0],
            [20.0, 0.0, -5.0],
            [20.0, 0.0, 2.0],
            [30.0, 0.0, 2.0],
            [30.0, 0.0, -7.0],
            [30.0, 0.0, 50.0],
            [40.0, 0.0, 50.0],
            [40.0, 0.0, 1.0],
            [40.0, 0.0, -1.0],
            [40.0, 0.0, 50.0],
            [40.0, 0.0, 9.0]
        ]
    );
    assert!(program.moves()[1..5].iter().all(|one| one.line() == 3));
}

#[test]
fn repetitions_are_steps_with_g91() {
    let program = nc("G0 X0 Y0 Z10\nG99 G91 G81 X5 Y1 Z-7 R-8 L3 F100\nG80\nG90 G0 X0");
    let bottoms: Vec<_> = tips(&program).into_iter().filter(|tip| tip[2] < 0.0).collect();
    assert_eq!(bottoms, [[5.0, 1.0, -5.0], [10.0, 2.0, -5.0], [15.0, 3.0, -5.0]]);
}

#[test]
fn a_dwell_stands_at_the_bottom() {
    let program = nc("G0 X0 Y0 Z50\nG82 X9 Z-5 R2 P.5 F100");
    let event = &program.events()[0];
    assert_eq!((event.kind, event.before), (EventKind::Dwell(Dwell::Seconds(0.5)), 4));
}

#[test]
fn a_turn_about_the_tool_is_no_tilt() {
    let program = tcp("G0 X0 Y0 Z50 A0 C30\nG81 X9 Z-5 R2 F100");
    assert_near(program.moves()[3].tip(), [9.0, 0.0, -5.0]);
}

#[test]
fn a_cycle_that_cannot_be_expanded_is_refused() {
    for (text, part) in [
        ("G81 X1 Z-5 F9", "needs R"),
        ("G81 X1 R5 F9", "needs R"),
        ("G81 X1 R-9 Z-5 F9", "begins below"),
        ("G83 X1 R1 Z-5 F9", "needs Q"),
        ("G83 X1 R1 Z-5 Q0 F9", "positive"),
        ("G83 X1 R1 Z-5 Q.001 F9", "1000 pecks"),
        ("G81 X1 R1 Z-5 L2000 F9", "1000 repetitions"),
        ("G18\nG81 X1 R1 Z-5 F9", "G17"),
        ("G93\nG81 X1 R1 Z-5 F9", "G94"),
        ("G43.4 H1\nG1 A30 F9\nG81 X1 R1 Z-5", "tilted axis"),
        ("G43.4 H1\nG81 X1 R1 Z-5 A30 F9", "tilted axis"),
        ("G68.2 J30\nG53.1\nG81 X1 R1 Z-5 F9", "tilted axis"),
    ] {
        let error = nc_fault(&format!("G0 X0 Y0 Z50\n{text}"));
        assert!(error.detail.contains(part), "{error}");
    }
    assert!(nc_fault("G81 X1 R1 Z-5 F9").detail.contains("not known"));
}

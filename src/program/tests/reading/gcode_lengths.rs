//! The lengths and origins that a planner needs.

use verne_program::{EventKind, LengthSource, WorkOffset, packed};

use crate::{apt, events, nc, nc_fault, warnings};

fn length(number: Option<u32>) -> EventKind {
    EventKind::LengthOffset { number }
}

fn tool(number: Option<u32>) -> EventKind {
    EventKind::Tool { number, length: None }
}

#[test]
fn the_offset_and_not_the_tool_decides_the_length() {
    let program = nc("T5 M6\nG43 H7\nG0 X0 Y0 Z0\nT6\nM6\nX1\nH8\nX2\nG49\nX3");
    assert_eq!(program.length_source(), LengthSource::Offset);
    let places: Vec<_> = program.events()[..5].iter().map(|event| (event.kind, event.before)).collect();
    assert_eq!(
        places,
        [
            (tool(Some(5)), 0),
            (length(Some(7)), 0),
            (tool(Some(6)), 1),
            (length(Some(8)), 2),
            (length(None), 3)
        ]
    );
    assert_eq!(program.tools().iter().map(|tool| tool.number).collect::<Vec<_>>(), [Some(5), Some(6)]);
    assert_eq!(apt("UNITS/MM\nLOADTL/1\nGOTO/0,0,0\nFINI\n").length_source(), LengthSource::Tool);
}

#[test]
fn without_h_the_length_is_that_of_the_last_h_or_of_the_tool() {
    assert_eq!(events(&nc("T5 M6\nG43\nG0 X0 Y0 Z0")), [tool(Some(5)), length(Some(5))]);
    assert_eq!(events(&nc("H4\nG43\nG0 X0 Y0 Z0")), [length(Some(4))]);
    let error = nc_fault("G43\nG0 X0 Y0 Z0");
    assert_eq!((error.line, error.word.as_str()), (2, "G43"));
    assert!(nc_fault("G43 H1.5\nG0 X0 Y0 Z0").detail.contains("whole number"));
}

#[test]
fn an_unchanged_length_is_no_event() {
    let program = nc("G49\nG43 H1\nG0 X0 Y0 Z0\nG43 H1\nG43.4 H1\nG43.4 H01\nG49\nG49");
    let control = |on| EventKind::CentrePointControl { on };
    assert_eq!(events(&program), [length(Some(1)), control(true), length(None), control(false)]);
    let texts: Vec<_> = program.events().iter().map(|event| &*event.text).collect();
    assert_eq!(texts, ["G43 H1", "G43.4", "G49", "G49", "M30"]);
}

#[test]
fn another_work_offset_has_another_origin() {
    let program = nc("G54 G0 X0 Y0 Z5\nG55\nG0 Z5\nX0 Y0\nG1 X1 F9\nG59.3 G0 X0 Y0 Z0\nG54 X0 Y0 Z0");
    let offset = |name: &str| EventKind::WorkOffset(name.parse::<WorkOffset>().unwrap());
    assert_eq!(events(&program), [offset("G55"), offset("G59.3"), offset("G54")]);
    // Equal coordinates in another offset are another point, and the next move has no start in its frame.
    let starts: Vec<_> = program
        .steps()
        .filter_map(|step| match step {
            verne_program::Step::Move(segment) => Some(segment.start.is_some()),
            verne_program::Step::Event(_) => None,
        })
        .collect();
    assert_eq!(starts, [false, false, true, false, false]);
    assert!(warnings(&program)[0].contains("left out"));
    assert!(nc_fault("G0 X0 Y0 Z5\nG55\nG1 X5 F9").detail.contains("not known yet"));
    assert!(nc_fault("G0 X0 Y0 Z5\nG55\nG2 X5 I2 F9").detail.contains("not known"));
    assert_eq!(events(&nc("G54\nG0 X0 Y0 Z0\nG54\nX1")), []);
}

#[test]
fn all_events_survive_packing() {
    let program =
        nc("T1 M6\nG43.4 H1\nG59.1 G0 X1 Y2 Z3 A4 C5\nG69\nG68.2 X1 Y2 Z3 I10 J20 K30\nG69\nG49\nM8");
    let mut bytes = Vec::new();
    packed::write(&program, &mut bytes).unwrap();
    assert_eq!(packed::unpack(bytes.as_slice()).unwrap(), program);
}

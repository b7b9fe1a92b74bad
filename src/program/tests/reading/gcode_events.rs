//! Spindle, coolant, waits, stops, tools and codes that are passed on.

use verne_program::{Compensation, Coolant, Dwell, EventKind, Format, ReadOptions, Rotation, Spindle, read};

use crate::{events, nc, nc_fault, warnings};

#[test]
fn spindle_coolant_waits_and_stops_stand_in_their_places() {
    let program = nc("S630 M03\nG0 X0 Y0 Z0 M8\nM7\nG4 P1.5\nG1 X1 F9 M0\nM1\nM9 M5\nS900\nM4\nX2 M2");
    let spindle = |speed, rotation| EventKind::Spindle(Spindle { speed, rotation });
    let events: Vec<_> =
        program.events().iter().map(|event| (event.kind, event.before, &*event.text)).collect();
    assert_eq!(
        events,
        [
            (spindle(Some(630.0), Some(Rotation::Clockwise)), 0, "S630 M03"),
            (EventKind::Coolant(Coolant::Flood), 0, "M8"),
            (EventKind::Coolant(Coolant::Mist), 1, "M7"),
            (EventKind::Dwell(Dwell::Seconds(1.5)), 1, "G4 P1.5"),
            (EventKind::Stop, 2, "M0"),
            (EventKind::OptionalStop, 2, "M1"),
            (spindle(None, Some(Rotation::Off)), 2, "M5"),
            (EventKind::Coolant(Coolant::Off), 2, "M9"),
            (spindle(Some(900.0), None), 2, "S900"),
            (spindle(None, Some(Rotation::CounterClockwise)), 2, "M4"),
            (EventKind::End, 3, "M2"),
        ]
    );
    assert!(nc_fault("S-5 M3\nG0 X0 Y0 Z0").detail.contains("negative"));
}

#[test]
fn a_wait_is_in_seconds_or_as_fanuc_counts_in_milliseconds() {
    let wait = |text: &str| events(&nc(&format!("G0 X0 Y0 Z0\n{text}")))[0];
    for (text, seconds) in
        [("G4 P2", 2.0), ("G4 P500", 0.5), ("G4 P500.", 500.0), ("G04 X1.5", 1.5), ("G4 U.2", 0.2)]
    {
        assert_eq!(wait(text), EventKind::Dwell(Dwell::Seconds(seconds)), "{text}");
    }
    assert!(warnings(&nc("G0 X0 Y0 Z0\nG4 P500"))[0].contains("milliseconds"));
    assert!(nc_fault("G0 X0 Y0 Z0\nG4").detail.contains("no time"));
    assert!(nc_fault("G0 X0 Y0 Z0\nG4 P-1").detail.contains("negative"));
}

#[test]
fn m6_loads_the_tool_of_the_last_t() {
    let program = nc("M6\nT3\nG0 X0 Y0 Z0\nT4 M6\nM6 T05\nT7");
    let tools: Vec<_> = program.tools().iter().map(|tool| tool.number).collect();
    assert_eq!(tools, [None, Some(4), Some(5)]);
    assert_eq!(warnings(&program), ["T without M6 loads no tool"]);
}

#[test]
fn codes_for_the_controller_are_passed_on() {
    let program = nc("G64 P0.01\nG61\nM451\nM66 P1 L3 Q5\nG0 X0 Y0 Z0 M123");
    let texts: Vec<_> = program
        .events()
        .iter()
        .filter(|event| event.kind == EventKind::Insert)
        .map(|event| (event.line, &*event.text))
        .collect();
    assert_eq!(texts, [(2, "G64 P0.01"), (3, "G61"), (4, "M451"), (5, "M66 P1 Q5 L3"), (6, "M123")]);
    assert_eq!(program.warnings().total, 3);
    assert!(warnings(&program)[0].contains("passed on"));
}

#[test]
fn cutter_compensation_is_a_warning_or_a_fault() {
    let text = "G21 G40\nG0 X0 Y0 Z0\nG41 D3\nG1 X1 F9\nG40\nM30\n";
    let program = read(Format::Gcode, text.as_bytes(), &ReadOptions::default()).unwrap();
    let compensation = |on| EventKind::Compensation { on };
    assert_eq!(events(&program), [compensation(true), compensation(false)]);
    assert!(warnings(&program)[0].contains("tool's path"));
    let options = ReadOptions { compensation: Compensation::Refuse, ..ReadOptions::default() };
    let refused = read(Format::Gcode, text.as_bytes(), &options).unwrap_err().to_string();
    assert!(refused.starts_with("line 3, column 1, \"G41\""), "{refused}");
}

//! Tools, spindle, coolant, waits and compensation of CL text.

use verne_program::{Compensation, Coolant, Dwell, EventKind, Format, ReadOptions, Rotation, Spindle, read};

use crate::{apt, fault, mm, place, warnings};

fn kind(statement: &str) -> EventKind {
    mm(&format!("{statement}\nGOTO/0,0,0")).events()[0].kind
}

#[test]
fn tools_are_loaded_in_the_words_of_every_system() {
    let tool = |number, length| EventKind::Tool { number, length };
    for (statement, expected) in [
        ("LOADTL / 2", tool(Some(2), None)),
        ("LOADTL/2.", tool(Some(2), None)),
        ("LOADTL/1, 0, 50.000000, 1", tool(Some(1), Some(50.0))),
        ("LOADTL/1, 0, 0.000000, 1", tool(Some(1), None)),
        ("LOADTL/7,LENGTH,95.5,ADJUST,1", tool(Some(7), Some(95.5))),
        ("LOADTL/10,ADJUST,1,SPINDL,15915.4,MILL", tool(Some(10), None)),
        ("LOADTL/1,OSETNO,1", tool(Some(1), None)),
        ("LOAD/TOOL,14", tool(Some(14), None)),
        ("LOAD/TOOL,3,ADJUST,3,LENGTH,80", tool(Some(3), Some(80.0))),
    ] {
        assert_eq!(kind(statement), expected, "{statement}");
    }
    let program = mm("LOAD/TOOL,BALL_6\nRAPID\nGOTO/0,0,0");
    assert_eq!(program.tools()[0].number, None);
    assert_eq!(warnings(&program).len(), 1);
}

#[test]
fn the_length_of_a_tool_is_in_the_unit_of_the_file() {
    let program = apt("UNITS/INCHES\nLOADTL/1,LENGTH,2\nLOADTL/2\nLOADTL/1,LENGTH,2\nGOTO/0,0,0\nFINI\n");
    let tools: Vec<_> = program.tools().iter().map(|tool| (tool.number, tool.length, tool.line)).collect();
    assert_eq!(tools, [(Some(1), Some(50.8), 2), (Some(2), None, 3)]);
}

#[test]
fn a_tool_that_cannot_be_named_is_refused_at_its_word() {
    assert_eq!(place(&fault("LOADTL/1.5")), (2, 8, "1.5"));
    assert_eq!(place(&fault("LOADTL/-1")), (2, 8, "-1"));
    assert_eq!(place(&fault("LOADTL/1,LENGTH,-5")), (2, 17, "-5"));
    assert!(fault("LOADTL").detail.contains("LOADTL/number"));
}

#[test]
fn the_spindle_has_speed_and_sense_in_any_order() {
    let spindle = |speed, rotation| EventKind::Spindle(Spindle { speed, rotation });
    for (statement, expected) in [
        ("SPINDL / RPM, 7957.5,  CLW", spindle(Some(7957.5), Some(Rotation::Clockwise))),
        ("SPINDL/12000,RPM,CCLW", spindle(Some(12000.0), Some(Rotation::CounterClockwise))),
        ("SPINDL/800,CLW,RANGE,2", spindle(Some(800.0), Some(Rotation::Clockwise))),
        ("SPINDL/OFF", spindle(None, Some(Rotation::Off))),
        ("SPINDL/ON", spindle(None, None)),
        ("SPINDL/SFM,300,CLW", spindle(None, Some(Rotation::Clockwise))),
    ] {
        assert_eq!(kind(statement), expected, "{statement}");
    }
    assert_eq!(fault("SPINDL/-5,RPM").line, 2);
}

#[test]
fn coolant_waits_and_stops_are_events() {
    for (statement, expected) in [
        ("COOLNT/flood", EventKind::Coolant(Coolant::Flood)),
        ("COOLNT/ON", EventKind::Coolant(Coolant::Flood)),
        ("COOLNT/MIST", EventKind::Coolant(Coolant::Mist)),
        ("COOLNT/THRU", EventKind::Coolant(Coolant::Through)),
        ("COOLNT/OFF", EventKind::Coolant(Coolant::Off)),
        ("COOLNT/AIR", EventKind::Other),
        ("DELAY/2.5", EventKind::Dwell(Dwell::Seconds(2.5))),
        ("DELAY/REV,3", EventKind::Dwell(Dwell::Revolutions(3.0))),
        ("STOP", EventKind::Stop),
        ("OPSTOP", EventKind::OptionalStop),
        ("END", EventKind::End),
    ] {
        assert_eq!(kind(statement), expected, "{statement}");
    }
    assert_eq!(fault("DELAY/-1").word, "-1");
    assert_eq!(fault("DELAY").word, "DELAY");
}

#[test]
fn compensation_is_a_warning_or_if_asked_for_a_fault() {
    let text = "UNITS/MM\nCUTCOM/LEFT,1\nGOTO/0,0,0\nCUTCOM/OFF\nCUTCOM/RIGHT\nFINI\n";
    let program = apt(text);
    assert_eq!(program.events()[1].kind, EventKind::Compensation { on: false });
    let warning = &program.warnings().list[0];
    assert_eq!((warning.line, warning.word.as_str(), warning.occurrences), (2, "CUTCOM", 2));
    let options = ReadOptions { compensation: Compensation::Refuse, ..ReadOptions::default() };
    let refused = read(Format::Apt, text.as_bytes(), &options).unwrap_err().to_string();
    assert!(refused.starts_with("line 2, column 1, \"CUTCOM\"") && refused.contains("line 5"), "{refused}");
}

//! What the planner reads of small programs.

use std::f64::consts::PI;
use std::sync::Arc;

use serde_json::{Value, json};
use verne_program::{Format, ReadOptions, read};
use verne_solver::toolpath::{Curve, Motion, MotionKind, Motions, Turning};

use crate::operations::machine_registry::MachineRegistry;
use crate::operations::program_motions::ProgramMotions;
use crate::operations::toolpath_question::CheckedToolpath;
use crate::wire::parse::parse_body;
use crate::wire::result_id::ResultId;

fn motions_of(format: Format, text: &str, request: &Value) -> Result<ProgramMotions, (u32, String)> {
    let options = ReadOptions { tcp: true, ..ReadOptions::default() };
    let program = Arc::new(read(format, text.as_bytes(), &options).unwrap());
    let request = parse_body(request.to_string().as_bytes()).unwrap();
    let checked = CheckedToolpath::new(&request, &MachineRegistry::default()).unwrap();
    let question = checked.question(ResultId::from(blake3::hash(text.as_bytes())));
    question.motions(&program).map_err(|faults| (faults.errors[0].line, faults.errors[0].detail.clone()))
}

fn all(motions: &ProgramMotions) -> Vec<Motion> {
    (0..motions.count()).map(|index| motions.motion(index)).collect()
}

#[test]
fn each_work_offset_has_its_frame_and_a_change_begins_where_the_machine_stands() {
    let text = "G21 G90 G54\nG43.4 H1 G0 X0 Y0 Z300\nG1 X10 F500\nG55\nG0 X0 Y0 Z300\nG1 X10\n";
    let frames = json!({"setup": {"z": 5}, "offsets": {"G55": {"x": 100, "c": 90}}, "tool_length": 50});
    let motions = all(&motions_of(Format::Gcode, text, &frames).unwrap());
    let tips: Vec<_> = motions.iter().map(|motion| motion.end.tip).collect();
    assert_eq!(tips, [[0.0, 0.0, 305.0], [10.0, 0.0, 305.0], [100.0, 0.0, 300.0], [100.0, 10.0, 300.0]]);
    let kinds: Vec<_> = motions.iter().map(|motion| motion.kind).collect();
    assert_eq!(kinds, [MotionKind::Arrive, MotionKind::Feed, MotionKind::Rapid, MotionKind::Feed]);
    let (line, detail) =
        motions_of(Format::Gcode, text, &json!({"offsets": {}, "tool_length": 50})).err().unwrap();
    assert!(line == 4 && detail.contains("G55"), "{line} {detail}");
}

#[test]
fn a_cut_goes_on_when_control_of_the_tool_centre_point_begins() {
    let text = "G21 G90\nG43 H1\nG0 X-150 Y0 Z300\nG43.4 H1\nG1 X150 F100\nG55\nG1 X0 Y0 Z300\n";
    let request = json!({"tool_length": {"1": 100}, "length_before": 1, "offsets": {"G55": {"z": 1}}});
    let motions = motions_of(Format::Gcode, text, &request).unwrap();
    let kinds: Vec<_> = all(&motions).iter().map(|motion| motion.kind).collect();
    assert_eq!(kinds, [MotionKind::Arrive, MotionKind::Feed, MotionKind::Feed]);
    assert!(motions.warnings.is_empty(), "{:?}", motions.warnings);
}

#[test]
fn a_feed_move_whose_start_is_not_sure_has_a_warning() {
    let text = "G21 G90\nT1 M6\nG43.4 H1\nG0 X0 Y0 Z300\nT2 M6\nG1 Z310 F100\nT1 M6\nG0 Z320\nG28 Z0\nG1 X0 Y0 Z300\n";
    let motions = motions_of(Format::Gcode, text, &json!({"tool_length": 100})).unwrap();
    let kinds: Vec<_> = all(&motions).iter().map(|motion| motion.kind).collect();
    assert_eq!(kinds, [MotionKind::Arrive, MotionKind::Feed, MotionKind::Arrive, MotionKind::Arrive]);
    let warned: Vec<_> = motions.warnings.iter().map(|warning| (warning.line, warning.occurrences)).collect();
    assert_eq!(warned, [(6, 1), (10, 1)]);
    let is_checked = |number: usize| !motions.warnings[number].detail.contains("not checked");
    assert!(is_checked(0) && !is_checked(1), "{:?}", motions.warnings);
}

#[test]
fn held_words_turn_with_the_frame_about_z() {
    let rows = "[0, 0, 300, 0, 10]\n[5, 0, 300, 0, 90]\n";
    let held = json!({"tool_length": 50, "setup": {"c": 30}, "hold_rotary": true});
    let motions = motions_of(Format::Ndjson, rows, &held).unwrap();
    let degrees = |index: usize| match motions.motion(index).turning {
        Turning::Held { start, end } => [start, end].map(|[_, phi2]| phi2.to_degrees().round()),
        turning => panic!("{turning:?}"),
    };
    assert_eq!([degrees(0), degrees(1)], [[40.0, 40.0], [40.0, 120.0]]);
    let vectors = "[0, 0, 300, 0, 0, 1]\n[5, 0, 300, 0, 0.1, 1]\n";
    let motion = motions_of(Format::Ndjson, vectors, &held).unwrap().motion(1);
    assert_eq!(motion.turning, Turning::GreatCircle, "vectors are no words");
}

#[test]
fn lengths_follow_the_offsets_of_g_code_and_the_tools_of_cl_text() {
    let gcode = "G21 G90\nT2 M6\nG43.4 H1 G0 X0 Y0 Z300\nG43.4 H2 G0 Z310\nG49\nG1 X1 F100\n";
    let table = json!({"tool_length": {"1": 120, "2": 95}, "length_before": 2});
    let lengths = |motions: &ProgramMotions| all(motions).iter().map(|m| m.tool_length).collect::<Vec<_>>();
    assert_eq!(lengths(&motions_of(Format::Gcode, gcode, &table).unwrap()), [120.0, 95.0, 95.0]);
    let without = json!({"tool_length": {"1": 120, "2": 95}});
    assert_eq!(motions_of(Format::Gcode, gcode, &without).err().unwrap().0, 5, "after G49");
    let cl = "UNITS/MM\nLOADTL/2,LENGTH,80\nGOTO/0,0,300\nLOADTL/1,LENGTH,70\nGOTO/0,0,310\n";
    assert_eq!(lengths(&motions_of(Format::Apt, cl, &table).unwrap()), [95.0, 120.0]);
    let stated = motions_of(Format::Apt, cl, &json!({})).unwrap();
    assert_eq!((lengths(&stated), stated.warnings[0].line), (vec![80.0, 70.0], 2));
    let ball = json!({"tool_length": 60, "tip": "centre", "tool_radius": 4});
    assert_eq!(lengths(&motions_of(Format::Apt, cl, &ball).unwrap()), [56.0, 56.0]);
    let short = json!({"tool_length": 3, "tip": "centre", "tool_radius": 4});
    assert!(motions_of(Format::Apt, cl, &short).is_err());
}

#[test]
fn the_axis_turns_as_the_words_say_unless_the_request_does() {
    let rows = "[0, 0, 300, 10, 0]\n[5, 0, 300, 10, 90]\n";
    let turned = json!({"tool_length": 50, "setup": {"c": 90}});
    let motion = motions_of(Format::Ndjson, rows, &turned).unwrap().motion(1);
    let Turning::Angles { start, end, frame } = motion.turning else { panic!("{motion:?}") };
    assert_eq!((start[1], end[1], frame[0]), (0.0, 0.5 * PI, [0.0, -1.0, 0.0]));
    let vector = json!({"tool_length": 50, "orientation": "vector"});
    assert_eq!(motions_of(Format::Ndjson, rows, &vector).unwrap().motion(1).turning, Turning::GreatCircle);
}

#[test]
fn arcs_turn_with_the_set_up_and_need_a_point_to_begin_at() {
    let text = "UNITS/MM\nGOTO/10,0,300\nCIRCLE/0,0,300,0,0,1\nGOTO/-10,0,300\n";
    let request = json!({"tool_length": 50, "setup": {"x": 1, "a": 90}});
    let Curve::Arc { centre, normal, sweep } =
        motions_of(Format::Apt, text, &request).unwrap().motion(1).curve
    else {
        panic!()
    };
    assert_eq!((centre, normal), ([1.0, -300.0, 0.0], [0.0, -1.0, 0.0]));
    assert!((sweep - PI).abs() < 1e-12);
    let text = text.replace("CIRCLE", "LOADTL/1\nCIRCLE");
    assert_eq!(motions_of(Format::Apt, &text, &request).err().unwrap().0, 5);
}

#[test]
fn points_out_of_proportion_are_faults() {
    let rows = "[0, 0, 300]\n[9000000, 0, 300]\n";
    let request = json!({"tool_length": 50, "setup": {"x": 9e6}});
    let (_, detail) = motions_of(Format::Ndjson, rows, &request).err().unwrap();
    assert!(detail.contains("must be within"), "{detail}");
}

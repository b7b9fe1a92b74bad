//! The published reference sets: solutions computed with fifty digits, and the machines behind them.

use serde_json::Value;
use verne_solver::machine::{Geometry, Limits, Table};
use verne_solver::{Machine, MachineData};

/// One joint vector and all its assembly modes.
pub(crate) struct ForwardCase {
    pub(crate) tag: String,
    pub(crate) machine: Machine,
    pub(crate) rho: [f64; 3],
    pub(crate) solutions: Vec<Solution>,
}

/// One pose in some frame and all postures that reach it.
pub(crate) struct InverseCase {
    pub(crate) tag: String,
    pub(crate) machine: Machine,
    /// x, y, z and in the part frame phi1, phi2 in radians.
    pub(crate) pose: Vec<f64>,
    /// In the part frame.
    pub(crate) tool_length: Option<f64>,
    pub(crate) solutions: Vec<Solution>,
}

/// A posture with fifty-digit truth rounded to double precision. Lengths in mm, angles in radians.
pub(crate) struct Solution {
    pub(crate) platform: [f64; 3],
    pub(crate) alpha: f64,
    pub(crate) rho: [f64; 3],
    pub(crate) working: bool,
    /// theta1 and theta2, in the part frame.
    pub(crate) table: Option<[f64; 2]>,
}

/// All forward cases.
pub(crate) fn forward() -> Vec<ForwardCase> {
    cases(include_str!("../../../../tests/reference/forward.json")).iter().map(forward_case).collect()
}

/// All inverse cases.
pub(crate) fn inverse() -> Vec<InverseCase> {
    cases(include_str!("../../../../tests/reference/inverse.json")).iter().map(inverse_case).collect()
}

/// The published file of the built-in machine.
pub(crate) fn verne() -> Machine {
    machine(include_str!("../../../../tests/reference/machine-verne.json"))
}

/// The machine with legs II and III of different lengths.
pub(crate) fn asymmetric() -> Machine {
    machine(include_str!("../../../../tests/reference/machine-asymmetric.json"))
}

fn cases(text: &str) -> Vec<Value> {
    serde_json::from_str(text).unwrap()
}

fn named(case: &Value) -> Machine {
    match text(&case["machine"]).as_str() {
        "verne" => verne(),
        "asymmetric" => asymmetric(),
        other => panic!("no machine {other}"),
    }
}

fn forward_case(case: &Value) -> ForwardCase {
    let rho = three(&case["rho"]);
    let solution = |s: &Value| Solution {
        platform: [number(&s["x"]), number(&s["y"]), number(&s["z"])],
        alpha: number(&s["alpha"]).to_radians(),
        rho,
        working: s["working"].as_bool().unwrap(),
        table: None,
    };
    ForwardCase {
        tag: text(&case["tag"]),
        machine: named(case),
        rho,
        solutions: case["solutions"].as_array().unwrap().iter().map(solution).collect(),
    }
}

fn inverse_case(case: &Value) -> InverseCase {
    let mut pose = numbers(&case["pose"]);
    let part = case["frame"] == "part";
    if part {
        pose[3..].iter_mut().for_each(|angle| *angle = angle.to_radians());
    }
    let solution = |s: &Value| Solution {
        platform: if part { three(&s["platform"]) } else { three(&case["pose"]) },
        alpha: number(&s["alpha"]).to_radians(),
        rho: three(&s["rho"]),
        working: s["working"].as_bool().unwrap(),
        table: part.then(|| [number(&s["theta1"]).to_radians(), number(&s["theta2"]).to_radians()]),
    };
    InverseCase {
        tag: text(&case["tag"]),
        machine: named(case),
        pose,
        tool_length: part.then(|| number(&case["tool_length"])),
        solutions: case["solutions"].as_array().unwrap().iter().map(solution).collect(),
    }
}

#[allow(non_snake_case, reason = "the paper's symbols")]
fn machine(file: &str) -> Machine {
    let json: Value = serde_json::from_str(file).unwrap();
    let g = |name: &str| number(&json["geometry"][name]);
    let l = |name: &str| number(&json["limits"][name]);
    let degrees = |name: &str| pair(&json["limits"][name]).map(f64::to_radians);
    let stroke = json["limits"]["stroke"].as_array().unwrap();
    let data = MachineData {
        name: text(&json["name"]),
        description: text(&json["description"]),
        geometry: Geometry {
            D1: g("D1"),
            d1: g("d1"),
            D2: g("D2"),
            d2: g("d2"),
            R1: g("R1"),
            r1: g("r1"),
            R2: g("R2"),
            r4: g("r4"),
            L1: g("L1"),
            L2: g("L2"),
            L3: g("L3"),
            parallelogram_half_width: g("parallelogram_half_width"),
            parallelogram_direction: 0.0,
            rod_radius: g("rod_radius"),
        },
        table: Table { da: number(&json["table"]["da"]), dt: number(&json["table"]["dt"]) },
        limits: Limits {
            stroke: [0, 1, 2].map(|i| pair(&stroke[i])),
            slider_cone: l("slider_cone").to_radians(),
            platform_cone: l("platform_cone").to_radians(),
            serial_margin: l("serial_margin"),
            parallel_margin: l("parallel_margin"),
            tilt: degrees("tilt"),
            rotary: Some(degrees("rotary")),
            table_clearance: None,
            slider_axes: None,
            platform_axes: None,
        },
        drives: None,
    };
    Machine::new(data).expect("a published machine is valid")
}

pub(crate) fn text(value: &Value) -> String {
    value.as_str().unwrap().to_owned()
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn three(value: &Value) -> [f64; 3] {
    numbers(value)[..3].try_into().unwrap()
}

fn pair(value: &Value) -> [f64; 2] {
    numbers(value).try_into().unwrap()
}

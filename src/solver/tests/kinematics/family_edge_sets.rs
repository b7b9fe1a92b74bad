//! Machines with R1 = r1 or e1 = e2, or nearly so, against sets that an independent program computed with fifty digits:
//! every solution, and no other. `tests/reference/README.md` describes the sets.

use serde_json::Value;
use verne_solver::machine::Geometry;
use verne_solver::{KinematicsError, Machine, Posture, forward, forward_working};

use crate::reference_cases::{number, numbers, text};

/// Accuracy of a coordinate, mm, and of an angle, rad.
const LENGTH: f64 = 1e-8;
const ANGLE: f64 = 1e-11;

pub(crate) struct Case {
    pub(crate) tag: String,
    pub(crate) machine: Machine,
    pub(crate) rho: [f64; 3],
    /// x, y, z, alpha and whether the solution is in the working mode.
    pub(crate) solutions: Vec<([f64; 4], bool)>,
}

#[allow(non_snake_case, reason = "the paper's symbols")]
pub(crate) fn cases() -> Vec<Case> {
    let sets: Vec<Value> =
        serde_json::from_str(include_str!("../../../../tests/reference/family-edge.json")).unwrap();
    let case = |case: &Value| {
        let g = |name: &str| number(&case["geometry"][name]);
        let mut data = Machine::verne().data().clone();
        data.geometry = Geometry {
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
            ..data.geometry
        };
        let decimal = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
        let solution = |s: &Value| {
            let [x, y, z, alpha] = ["x", "y", "z", "alpha"].map(|name| decimal(&s[name]));
            ([x, y, z, alpha.to_radians()], s["working"].as_bool().unwrap())
        };
        Case {
            tag: text(&case["tag"]),
            machine: Machine::new(data).unwrap(),
            rho: numbers(&case["rho"]).try_into().unwrap(),
            solutions: case["solutions"].as_array().unwrap().iter().map(solution).collect(),
        }
    };
    sets.iter().map(case).collect()
}

fn is(posture: &Posture, [x, y, z, alpha]: [f64; 4]) -> bool {
    let p = &posture.pose;
    let turn = (p.alpha - alpha).sin().abs().max(1.0 - (p.alpha - alpha).cos());
    [p.x - x, p.y - y, p.z - z].iter().all(|error| error.abs() < LENGTH) && turn < ANGLE
}

#[test]
fn every_solution_near_the_familys_edge_is_found_and_none_invented() {
    let mut faults = Vec::new();
    for Case { tag, machine, rho, solutions } in cases() {
        let found = match forward(&machine, rho) {
            Ok(found) => found.to_vec(),
            Err(KinematicsError::Unreachable(_)) => Vec::new(),
            Err(refusal) => panic!("{tag}: {refusal:?}"),
        };
        let complete = found.len() == solutions.len()
            && solutions.iter().all(|(truth, working)| {
                let hits: Vec<_> = found.iter().filter(|posture| is(posture, *truth)).collect();
                hits.len() == 1 && hits[0].working == *working && !hits[0].merged
            });
        let working = solutions.iter().find(|(_, working)| *working);
        let right = match (working, forward_working(&machine, rho)) {
            (Some((truth, _)), Ok(posture)) => is(&posture, *truth) && found.first() == Some(&posture),
            (None, Err(KinematicsError::Unreachable(_))) => true,
            _ => false,
        };
        if !(complete && right) {
            faults.push(format!("{tag} {rho:?}: {solutions:?} but {found:#?}"));
        }
    }
    assert!(faults.is_empty(), "{} faults, the first: {}", faults.len(), faults[0]);
}

//! The symmetry plane y = 0 and its neighbourhood, where the cubic for cos alpha has double roots
//! and where users are most of the time.

use verne_solver::{
    Machine, Mode, PartPose, Posture, part, part_working, platform, platform_working, tool, tool_working,
};

use crate::lengths::scale;
use crate::oracle::{self, Comparison, Path};
use crate::random::Random;

/// y from exactly zero to a micrometre on a metre, on both sides.
const OFFSETS: [f64; 22] = [
    0.0, -0.0, 1e-12, -1e-12, 1e-11, -1e-11, 1e-10, -1e-10, 1e-9, -1e-9, 1e-8, -1e-8, 1e-7, -1e-7, 1e-6,
    -1e-6, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3,
];

/// Positions in the plane where the reference machine has all sixteen postures.
fn positions() -> Vec<[f64; 2]> {
    let mut draw = Random::new(41);
    let random = (0..30).map(|_| [draw.between(-350.0, 350.0), draw.between(900.0, 1600.0)]);
    let sixteen = |&[x, z]: &[f64; 2]| {
        let answer = oracle::inverse(&Machine::verne(), &Path::platform([x, 0.0, z]));
        answer.found.len() == 16
    };
    let all: Vec<_> = [[0.0, 1000.0], [-240.0, 1000.0], [100.0, 1250.5]].into_iter().chain(random).collect();
    let positions: Vec<_> = all.into_iter().filter(sixteen).collect();
    assert!(positions.len() > 15, "{positions:?}");
    positions
}

fn assert_working(question: &str, posture: &Posture, y: f64) {
    assert!(posture.working && !posture.merged, "{question}: {posture:?}");
    assert!(posture.pose.alpha.abs() <= 1.01 * y.abs() / 300.0 + 1e-15, "{question}: {posture:?}");
    assert!(posture.residual < 1e-9, "{question}: {posture:?}");
}

#[test]
fn all_sixteen_postures_are_found_in_the_plane() {
    let (machine, mut comparison) = (Machine::verne(), Comparison::default());
    for [x, z] in positions() {
        for y in OFFSETS {
            let question = format!("p {:?}", [x, y, z]);
            let all = platform(&machine, [x, y, z]);
            let answer = oracle::inverse(&machine, &Path::platform([x, y, z]));
            comparison.of(&question, &machine, &answer, &all);
            assert!(all.as_ref().is_ok_and(|all| all.len() == 16), "{question}: {all:#?}");
        }
    }
    comparison.conclude(0, 16 * comparison.tally.compared);
}

#[test]
fn sixteen_postures_have_sixteen_labels() {
    for [x, z] in positions() {
        for y in OFFSETS {
            let all = platform(&Machine::verne(), [x, y, z]).unwrap();
            let mut modes: Vec<Mode> = all.iter().map(|posture| posture.mode).collect();
            modes.sort();
            modes.dedup();
            assert_eq!(modes.len(), 16, "p {:?}: {all:#?}", [x, y, z]);
        }
    }
}

#[test]
fn the_working_posture_is_found_in_the_plane() {
    for [x, z] in positions() {
        for y in OFFSETS {
            let question = format!("p {:?}", [x, y, z]);
            let posture = platform_working(&Machine::verne(), [x, y, z]).expect(&question);
            assert_working(&question, &posture, y);
            assert_eq!([posture.pose.x, posture.pose.y, posture.pose.z], [x, y, z]);
        }
    }
}

#[test]
fn tool_positions_in_the_plane_agree_with_the_oracle() {
    let (machine, mut comparison) = (Machine::verne(), Comparison::default());
    for [x, z] in positions() {
        for (y, length) in OFFSETS.into_iter().flat_map(|y| [(y, 0.0), (y, 50.0), (y, 300.0)]) {
            let (u, question) = ([x, y, z + length], format!("u {:?} tool {length}", [x, y, z + length]));
            let answer = oracle::inverse(&machine, &Path::tool(u, length));
            comparison.of(&question, &machine, &answer, &tool(&machine, u, length));
            let posture = tool_working(&machine, u, length).expect(&question);
            assert_working(&question, &posture, 2.0 * y);
        }
    }
    comparison.conclude(0, 12 * comparison.tally.compared);
}

#[test]
fn part_poses_in_the_plane_agree_with_the_oracle() {
    let (machine, mut comparison) = (Machine::verne(), Comparison::default());
    for [x, z] in positions() {
        for (y, length) in OFFSETS.into_iter().flat_map(|y| [(y, 0.0), (y, 50.0), (y, 300.0)]) {
            // With phi1 = phi2 = 0 and the table level, the table's y is the base's, turned over.
            let target = PartPose { x, y: -y, z: 1700.0 - z - length, phi1: 0.0, phi2: 0.0 };
            let question = format!("{target:?} tool {length}");
            let answer = oracle::inverse(&machine, &Path::part(&machine, &target, length));
            comparison.of(&question, &machine, &answer, &part(&machine, &target, length));
            let posture = part_working(&machine, &target, length).expect(&question);
            assert_working(&question, &posture, 2.0 * y);
        }
    }
    comparison.conclude(0, 12 * comparison.tally.compared);
}

#[test]
fn solutions_at_any_distance_from_the_plane_agree_with_the_oracle() {
    let (mut draw, mut comparison) = (Random::new(43), Comparison::default());
    for _ in 0..2000 {
        let machine = if draw.one_in(2) { Machine::verne() } else { draw.machine() };
        let [x, _, z] = draw.point(&machine);
        let y = scale(&machine) * draw.magnitude(1e-9, 1e-2) * draw.pick(&[1.0, -1.0]);
        let (p, length) = ([x, y, z], draw.tool_length(&machine));
        let answer = oracle::inverse(&machine, &Path::platform(p));
        comparison.of(&format!("p {p:?}"), &machine, &answer, &platform(&machine, p));
        comparison.of_working(&format!("p {p:?}"), &machine, &answer, &platform_working(&machine, p));
        let answer = oracle::inverse(&machine, &Path::tool(p, length));
        comparison.of(&format!("u {p:?} tool {length}"), &machine, &answer, &tool(&machine, p, length));
        let alone = tool_working(&machine, p, length);
        comparison.of_working(&format!("u {p:?} tool {length}"), &machine, &answer, &alone);
        let target = PartPose { x, y, z: draw.between(-0.5, 0.5) * scale(&machine), ..PartPose::default() };
        let answer = oracle::inverse(&machine, &Path::part(&machine, &target, length));
        let question = format!("{target:?} tool {length}");
        comparison.of(&question, &machine, &answer, &part(&machine, &target, length));
        comparison.of_working(&question, &machine, &answer, &part_working(&machine, &target, length));
    }
    comparison.conclude(20, 12_000);
}

#[test]
fn random_machines_in_the_plane_agree_with_the_oracle() {
    let (mut draw, mut comparison) = (Random::new(42), Comparison::default());
    for _ in 0..1500 {
        let machine = draw.machine();
        let [x, _, z] = draw.point(&machine);
        let p = [x, draw.pick(&OFFSETS) * scale(&machine) / 1000.0, z];
        let answer = oracle::inverse(&machine, &Path::platform(p));
        comparison.of(&format!("p {p:?}"), &machine, &answer, &platform(&machine, p));
    }
    comparison.conclude(15, 4000);
}

//! The symmetry plane y = 0 and its neighbourhood, where the cubic for cos alpha has double roots
//! and where users are most of the time.

use verne_solver::{
    Machine, Mode, PartPose, Posture, part, part_working, platform, platform_working, tool, tool_working,
};

use crate::machines::{Draw, scale};
use crate::oracle::{self, Path, Tally, agree};

/// y from exactly zero to a micrometre on a metre, on both sides.
const OFFSETS: [f64; 22] = [
    0.0, -0.0, 1e-12, -1e-12, 1e-11, -1e-11, 1e-10, -1e-10, 1e-9, -1e-9, 1e-8, -1e-8, 1e-7, -1e-7, 1e-6,
    -1e-6, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3,
];

/// Positions in the plane where the reference machine has all sixteen postures.
fn positions() -> Vec<[f64; 2]> {
    let mut draw = Draw::seeded(41);
    let random = (0..20).map(|_| [draw.between(-350.0, 350.0), draw.between(900.0, 1600.0)]);
    [[0.0, 1000.0], [-240.0, 1000.0], [100.0, 1250.5]].into_iter().chain(random).collect()
}

fn assert_working(question: &str, posture: &Posture, y: f64) {
    assert!(posture.working && !posture.merged, "{question}: {posture:?}");
    assert!(posture.pose.alpha.abs() <= 1.01 * y.abs() / 300.0, "{question}: {posture:?}");
    assert!(posture.residual < 1e-9, "{question}: {posture:?}");
}

#[test]
fn platform_has_all_sixteen_postures() {
    let (machine, mut tally) = (Machine::verne(), Tally::default());
    for [x, z] in positions() {
        for y in OFFSETS {
            let question = format!("p {:?}", [x, y, z]);
            let all =
                platform(&machine, [x, y, z]).unwrap_or_else(|refusal| panic!("{question}: {refusal:?}"));
            assert_eq!(all.len(), 16, "{question}: {all:#?}");
            let answer = oracle::inverse(&machine, &Path::platform([x, y, z]));
            agree(&machine, &answer, &all, &mut tally).unwrap_or_else(|what| panic!("{question}: {what}"));
        }
    }
    assert_eq!(tally.lenient, 0);
}

#[test]
fn sixteen_postures_carry_sixteen_labels() {
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
fn platform_has_its_working_posture() {
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
fn tool_frame_agrees_with_the_oracle() {
    let (machine, mut tally) = (Machine::verne(), Tally::default());
    for [x, z] in positions() {
        for (y, length) in OFFSETS.into_iter().flat_map(|y| [(y, 0.0), (y, 50.0), (y, 300.0)]) {
            let (u, question) = ([x, y, z + length], format!("u {:?} tool {length}", [x, y, z + length]));
            let all = tool(&machine, u, length).unwrap_or_else(|refusal| panic!("{question}: {refusal:?}"));
            assert!(all.len() >= 16, "{question}: {all:#?}");
            let answer = oracle::inverse(&machine, &Path::tool(u, length));
            agree(&machine, &answer, &all, &mut tally).unwrap_or_else(|what| panic!("{question}: {what}"));
            let posture = tool_working(&machine, u, length).expect(&question);
            assert_working(&question, &posture, 2.0 * y);
        }
    }
    assert_eq!(tally.lenient, 0);
}

#[test]
fn part_frame_agrees_with_the_oracle() {
    let (machine, mut tally) = (Machine::verne(), Tally::default());
    for [x, z] in positions() {
        for (y, length) in OFFSETS.into_iter().flat_map(|y| [(y, 0.0), (y, 50.0), (y, 300.0)]) {
            // With phi1 = phi2 = 0 and the table level, the table's y is the base's, turned over.
            let target = PartPose { x, y: -y, z: 1700.0 - z - length, phi1: 0.0, phi2: 0.0 };
            let question = format!("{target:?} tool {length}");
            let all =
                part(&machine, &target, length).unwrap_or_else(|refusal| panic!("{question}: {refusal:?}"));
            let answer = oracle::inverse(&machine, &Path::part(&machine, &target, length));
            agree(&machine, &answer, &all, &mut tally).unwrap_or_else(|what| panic!("{question}: {what}"));
            let posture = part_working(&machine, &target, length).expect(&question);
            assert_working(&question, &posture, 2.0 * y);
        }
    }
    assert_eq!(tally.lenient, 0);
}

#[test]
fn platform_of_random_machines_agrees_with_the_oracle() {
    let (mut draw, mut tally) = (Draw::seeded(42), Tally::default());
    for _ in 0..1500 {
        let machine = draw.machine();
        let [x, _, z] = draw.point(&machine);
        let p = [x, draw.pick(&OFFSETS) * scale(&machine) / 1000.0, z];
        let all = platform(&machine, p).unwrap_or_default();
        let answer = oracle::inverse(&machine, &Path::platform(p));
        agree(&machine, &answer, &all, &mut tally).unwrap_or_else(|what| panic!("p {p:?}: {what}"));
    }
    assert!(tally.lenient < 15 && tally.solutions > 4000, "{tally:?}");
}

//! Lifting the sliders and the platform together changes nothing else.

use verne_solver::{Machine, Posture, forward, platform, tool};

use crate::random::Random;

/// Levels that keep every sum below exact in double precision.
const LEVELS: [f64; 5] = [1024.0, -4096.0, 65_536.0, -1_048_576.0, 0.5];

/// A number with few enough binary digits that adding a level is exact.
fn short(number: f64) -> f64 {
    (number * 1024.0).round() / 1024.0
}

fn lifted(posture: &Posture, level: f64) -> Posture {
    let mut lifted = *posture;
    lifted.pose.z += level;
    lifted.rho = posture.rho.map(|rho| rho + level);
    lifted
}

fn assert_same(question: &str, level: f64, low: &[Posture], high: &[Posture]) {
    assert_eq!(low.len(), high.len(), "{question} and {level} higher: {low:#?} {high:#?}");
    let tolerance = 1e-9 + 8.0 * f64::EPSILON * level.abs();
    for posture in low.iter().map(|posture| lifted(posture, level)) {
        let same = |other: &&Posture| {
            let (a, b) = (posture.pose, other.pose);
            let turn = 500.0 * (a.alpha - b.alpha);
            let moved = [a.x - b.x, a.y - b.y, a.z - b.z, turn];
            let slid = [0, 1, 2].map(|i| posture.rho[i] - other.rho[i]);
            moved.iter().chain(&slid).all(|d| d.abs() < tolerance)
        };
        let twin =
            high.iter().find(same).unwrap_or_else(|| panic!("{question} and {level}: {posture:?} {high:#?}"));
        assert_eq!((twin.mode, twin.working), (posture.mode, posture.working), "{question} and {level}");
    }
}

#[test]
fn a_common_lift_does_not_change_assembly_modes() {
    let (machine, mut draw) = (Machine::verne(), Random::new(171));
    for _ in 0..200 {
        let rho = [0; 3].map(|_| short(draw.between(0.0, 750.0)));
        let low = forward(&machine, rho).unwrap();
        for level in LEVELS {
            let high = forward(&machine, rho.map(|rho| rho + level)).unwrap();
            assert_same(&format!("rho {rho:?}"), level, &low, &high);
        }
    }
}

#[test]
fn a_common_lift_does_not_change_postures() {
    let (machine, mut draw) = (Machine::verne(), Random::new(172));
    for _ in 0..200 {
        let [x, y, z] =
            [draw.between(-300.0, 300.0), draw.between(-300.0, 300.0), short(draw.between(800.0, 1500.0))];
        let low = platform(&machine, [x, y, z]).unwrap();
        let low_tool = tool(&machine, [x, y, z], 150.0).unwrap();
        for level in LEVELS {
            let high = platform(&machine, [x, y, z + level]).unwrap();
            assert_same(&format!("p {:?}", [x, y, z]), level, &low, &high);
            let high = tool(&machine, [x, y, z + level], 150.0).unwrap();
            assert_same(&format!("u {:?}", [x, y, z]), level, &low_tool, &high);
        }
    }
}

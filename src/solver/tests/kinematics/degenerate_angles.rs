//! Angles at which a formula divides by zero: alpha = π, R1 cos alpha = r1, and those where the
//! elimination's numerator and denominator vanish together.

use std::f64::consts::PI;

use verne_solver::{KinematicsError, Machine, Postures, forward, platform, tool, tool_point};

use crate::oracle::constructed_postures::{hung, leaning, upright};
use crate::oracle::{self, Answer, Comparison, Found, Legs, Path, distance};
use crate::random::Random;
use crate::reference_cases;

const SIDES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// The posture is found by forward, platform and tool, once, and the answers are the oracle's.
fn check(machine: &Machine, found: &Found, comparison: &mut Comparison) {
    let legs = Legs::of(machine);
    let mut once = |name: &str, answer: &Answer, got: Result<Postures, KinematicsError>| {
        comparison.of(&format!("{name} of {found:?}"), machine, answer, &got);
        let hits = got.iter().flatten().filter(|posture| distance(&legs, found, posture) < 1e-9).count();
        assert!(hits <= 1, "{name} of {found:?}: {got:#?}");
    };
    once("forward", &oracle::forward(machine, found.rho), forward(machine, found.rho));
    let p = [found.q[0], found.q[1], found.q[2]];
    once("platform", &oracle::inverse(machine, &Path::platform(p)), platform(machine, p));
    let length = 120.0;
    let tip = tool_point(&found.posture(&legs).pose, length);
    once("tool", &oracle::inverse(machine, &Path::tool(tip, length)), tool(machine, tip, length));
}

#[test]
fn solutions_at_alpha_180_are_found() {
    for machine in [reference_cases::verne(), reference_cases::asymmetric()] {
        let (legs, mut comparison, mut draw) = (Legs::of(&machine), Comparison::default(), Random::new(61));
        for (x, sides) in (0..40).map(|i| (draw.between(-250.0, 250.0), SIDES[i % 4])) {
            for s1 in [1.0, -1.0] {
                let found = hung(&legs, upright(&legs, PI, x, 1200.0, s1).unwrap(), sides).unwrap();
                check(&machine, &found, &mut comparison);
            }
        }
        comparison.conclude(5, 4 * comparison.tally.compared);
    }
}

#[test]
fn solutions_near_alpha_180_are_found() {
    for machine in [reference_cases::verne(), reference_cases::asymmetric()] {
        let (legs, mut comparison) = (Legs::of(&machine), Comparison::default());
        for (exponent, sides) in (1..13).flat_map(|e| SIDES.map(|sides| (e, sides))) {
            let alpha = PI - 10_f64.powi(-exponent);
            // y goes with sin alpha, so that w1 stays in reach.
            let y = 500.0 * alpha.sin();
            for (alpha, y) in [(alpha, y), (alpha, -y), (-alpha, y), (-alpha, -y)] {
                let found = hung(&legs, leaning(&legs, alpha, y, 1200.0, -1.0).unwrap(), sides).unwrap();
                check(&machine, &found, &mut comparison);
            }
        }
        comparison.conclude(5, 4 * comparison.tally.compared);
    }
}

#[test]
fn solutions_with_crossed_rods_of_leg_one_are_found() {
    // R1 cos alpha = r1, Eq (23): then y u + w1 v = 0 leaves w1 = 0.
    for machine in [reference_cases::verne(), reference_cases::asymmetric()] {
        let (legs, mut comparison, mut draw) = (Legs::of(&machine), Comparison::default(), Random::new(62));
        let upright = (legs.g.r1 / legs.g.R1).acos();
        let mut checked = 0;
        for (y, sides) in (0..60).map(|i| (draw.between(-600.0, 600.0), SIDES[i % 4])) {
            for alpha in [upright, -upright, upright + 1e-9, upright - 1e-6] {
                let leg1 = leaning(&legs, alpha, y, 1000.0, -1.0).unwrap();
                let Some(found) = hung(&legs, leg1, sides) else { continue };
                if found.weak() {
                    continue;
                }
                check(&machine, &found, &mut comparison);
                checked += 1;
            }
        }
        assert!(checked > 60, "{checked}");
        comparison.conclude(5, 4 * checked);
    }
}

/// Sliders for which numerator and denominator of the elimination vanish together at alpha:
/// D = 4 sin a (R2 r1 - R1 r4) + 2 (rho3 - rho2) u and N = L2² - L3² - m S.
fn both_vanish(legs: &Legs, alpha: f64, level: f64) -> [f64; 3] {
    let g = &legs.g;
    let (s, c) = alpha.sin_cos();
    let across = -2.0 * s * (g.R2 * g.r1 - g.R1 * g.r4) / (g.R1 * c - g.r1);
    let m = across - 2.0 * g.R2 * s;
    let sum = (g.L2 * g.L2 - g.L3 * g.L3) / m;
    [f64::midpoint(sum, 2.0 * level + across), level, level + across]
}

#[test]
fn solutions_are_found_where_numerator_and_denominator_vanish() {
    let (machine, mut comparison, mut pairs) = (reference_cases::asymmetric(), Comparison::default(), 0);
    let (legs, mut draw) = (Legs::of(&machine), Random::new(63));
    for _ in 0..300 {
        let (alpha, level) = (draw.between(-PI, PI), draw.between(0.0, 700.0));
        let rho = both_vanish(&legs, alpha, level);
        if rho.iter().any(|r| r.abs() > 5000.0) {
            continue;
        }
        let answer = oracle::forward(&machine, rho);
        let all = forward(&machine, rho);
        comparison.of(&format!("rho {rho:?}"), &machine, &answer, &all);
        let here = all.iter().flatten().filter(|posture| (posture.pose.alpha - alpha).abs() < 1e-9).count();
        assert!(here == 0 || here == 2, "rho {rho:?}: {all:#?}");
        pairs += here / 2;
    }
    assert!(pairs > 20, "{pairs}");
    comparison.conclude(5, comparison.tally.compared);
}

#[test]
fn solutions_are_found_where_numerator_and_denominator_nearly_vanish() {
    let (machine, mut comparison) = (reference_cases::asymmetric(), Comparison::default());
    let (legs, mut draw) = (Legs::of(&machine), Random::new(64));
    for _ in 0..300 {
        let mut rho = both_vanish(&legs, draw.between(-1.2, 1.2), draw.between(0.0, 700.0));
        if rho.iter().any(|r| r.abs() > 5000.0) {
            continue;
        }
        let slider = draw.pick(&[0, 1, 2]);
        rho[slider] += draw.magnitude(1e-12, 1e-1) * draw.pick(&[1.0, -1.0]);
        let answer = oracle::forward(&machine, rho);
        comparison.of(&format!("rho {rho:?}"), &machine, &answer, &forward(&machine, rho));
    }
    comparison.conclude(5, 200);
}

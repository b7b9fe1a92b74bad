//! Leg I nearly level: its rods nearly horizontal, alpha near 0 or half a turn, w1 near zero.
//!
//! The postures are built from alpha and w1, so that every one of them must be found.

use std::f64::consts::PI;

use verne_solver::{
    KinematicsError, Machine, PartPose, PlatformPose, Posture, Postures, TableAngles, part, part_pose,
    platform, tool, tool_point,
};

use crate::lengths::scale;
use crate::random::Random;

/// Leg I closed at a platform angle with the drop w1: P, but for its z. `None` if the leg does not
/// reach or leg II or III does not.
fn built(machine: &Machine, alpha: f64, w1: f64, side: f64) -> Option<[f64; 2]> {
    let g = &machine.data().geometry;
    let (u, v) = (g.R1 * alpha.cos() - g.r1, g.R1 * alpha.sin());
    let y = -w1 * v / u;
    let square = g.L1 * g.L1 - y * y - u * u - v * v - w1 * w1;
    let x = (square > 0.0).then(|| side * square.sqrt() - (g.D1 - g.d1))?;
    let (x2, p) = (x + g.D2 - g.d2, g.R2 * alpha.cos() - g.r4);
    let reaches = |length: f64, across: f64| x2.hypot(across) < 0.99 * length;
    (reaches(g.L2, y - p) && reaches(g.L3, y + p)).then_some([x, y])
}

/// Both mirror images of an angle and a drop with all choices of legs II and III are among the
/// postures, and no two postures are one.
fn check(machine: &Machine, question: &str, found: Result<Postures, KinematicsError>, alpha: f64, w1: f64) {
    let found = found.unwrap_or_else(|refusal| panic!("{question}: {refusal:?}"));
    let lever = machine.data().geometry.R1;
    let apart = |posture: &Posture, alpha: f64, w1: f64| {
        let turn = (posture.pose.alpha - alpha + PI).rem_euclid(2.0 * PI) - PI;
        (lever * turn).hypot(posture.pose.z - posture.rho[0] - w1)
    };
    // x is rounded, and holds w1² and the square of the arc R1 alpha to no more than this.
    let size = w1.hypot(lever * alpha.sin());
    let near = 100.0 * f64::EPSILON * scale(machine).powi(2) / size + 1e-6 * size;
    let count = found.iter().filter(|posture| apart(posture, alpha, w1) < near).count();
    assert_eq!(count, 4, "{question}: {alpha} {w1} in {found:?}");
    assert!(!found.iter().any(|posture| posture.merged), "{question}: {found:?}");
    let differ = |a: &Posture, b: &Posture| {
        apart(a, b.pose.alpha, b.pose.z - b.rho[0]) > 0.0 || a.rho[1..] != b.rho[1..]
    };
    for (i, a) in found.iter().enumerate() {
        assert!(found[..i].iter().all(|b| differ(a, b)), "{question}: twice in {found:?}");
    }
}

#[test]
fn sixteen_postures_are_found_with_almost_horizontal_rods() {
    let (machine, x) = (Machine::verne(), -530.776_406_204_323_2);
    for (y, expected) in
        [(1e-6, vec![-0.007_819, -0.002_126, 0.002_126, 0.007_819]), (0.0, vec![-0.008_103, 0.0, 0.008_103])]
    {
        let found = platform(&machine, [x, y, 1000.0]).unwrap();
        assert_eq!(found.len(), 16, "{found:?}");
        assert!(found.iter().all(|posture| !posture.merged), "{found:?}");
        let mut angles: Vec<f64> = found.iter().map(|posture| posture.pose.alpha.to_degrees()).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        assert_eq!(angles.len(), expected.len(), "{angles:?}");
        assert!(angles.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-6), "{angles:?}");
    }
}

/// A random machine with leg I nearly level at alpha near `middle`, and the point P.
fn nearly_level(draw: &mut Random, middle: f64) -> Option<(Machine, [f64; 3], f64, f64)> {
    let machine = draw.any_machine();
    let size = draw.magnitude(1e-6, 1e-4) * scale(&machine);
    // Neither of the two so small beside the other that x could not hold it.
    let part = draw.between(0.1, 1.47);
    let w1 = size * part.sin();
    let alpha = middle + draw.pick(&[-1.0, 1.0]) * size * part.cos() / machine.data().geometry.R1;
    let side = draw.pick(&[-1.0, 1.0]);
    // Nor so near to merging with the other posture that x could not tell them apart.
    let g = &machine.data().geometry;
    let (drop, turn) = (w1 * w1, g.R1 * g.r1 * alpha.sin().powi(2));
    if (drop - turn).abs() < 0.3 * (drop + turn) {
        return None;
    }
    let [x, y] = built(&machine, alpha, w1, side)?;
    let z = scale(&machine) * draw.between(0.0, 2.0);
    Some((machine, [x, y, z], alpha, w1))
}

fn around(middle: f64, seed: u64) {
    let (mut draw, mut checked) = (Random::new(seed), 0);
    while checked < 1500 {
        let Some((machine, p, alpha, w1)) = nearly_level(&mut draw, middle) else { continue };
        checked += 1;
        check(&machine, &format!("platform {p:?}"), platform(&machine, p), alpha, w1);
        let pose = PlatformPose { x: p[0], y: p[1], z: p[2], alpha };
        let length = scale(&machine) * draw.magnitude(0.01, 1.0);
        let u = tool_point(&pose, length);
        check(&machine, &format!("tool {u:?} {length}"), tool(&machine, u, length), alpha, w1);
        let target: PartPose = part_pose(&machine, &pose, TableAngles { theta1: alpha, theta2: 0.0 }, length);
        let target = PartPose { phi1: 0.0, phi2: 0.0, ..target };
        let question = format!("part {target:?} {length}");
        check(&machine, &question, part(&machine, &target, length), alpha, w1);
    }
}

#[test]
fn postures_near_alpha_zero_are_found_in_every_frame() {
    around(0.0, 171);
}

#[test]
fn postures_near_alpha_180_are_found_in_every_frame() {
    around(PI, 172);
}

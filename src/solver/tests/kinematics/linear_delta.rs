//! Linear deltas, R1 = r1, against closed forms: the platform translates on branch P, and turns by 2 atan2(w1, y) on
//! branch Q, where the rods of leg I cross.

use verne_solver::machine::Geometry;
use verne_solver::{
    Constraint, KinematicsError, Machine, Margins, PartPose, forward, forward_working, part, part_working,
    platform, platform_working, table_angles, tool, tool_point, tool_working,
};

use crate::machines::changed;
use crate::random::Random;

/// A delta with three columns on a circle of radius `radius` + `effector`, joints of the platform on one of radius
/// `effector`, and rods of one length.
fn with_columns_on_a_circle(radius: f64, effector: f64, rod: f64) -> Machine {
    let half_root = 0.75_f64.sqrt();
    changed(|data| {
        data.geometry = Geometry {
            D1: effector,
            d1: radius + effector,
            D2: -0.5 * effector,
            d2: -0.5 * (radius + effector),
            R1: 20.0,
            r1: 20.0,
            R2: half_root * effector,
            r4: half_root * (radius + effector),
            L1: rod,
            L2: rod,
            L3: rod,
            parallelogram_half_width: 20.0,
            parallelogram_direction: -30_f64.to_radians(),
            rod_radius: 3.0,
        };
    })
}

fn random_delta(draw: &mut Random) -> Machine {
    loop {
        let mut data = Machine::linear_delta().data().clone();
        let g = &mut data.geometry;
        for length in [&mut g.L1, &mut g.L2, &mut g.L3, &mut g.D2, &mut g.d2, &mut g.R2, &mut g.r4] {
            *length *= draw.between(0.8, 1.3);
        }
        (g.R1, g.r1) = (40.0, 40.0);
        g.R1 *= draw.between(0.3, 4.0);
        g.r1 = g.R1;
        if let Ok(machine) = Machine::new(data) {
            return machine;
        }
    }
}

#[test]
fn the_platform_has_eight_postures_that_translate_and_eight_that_turn() {
    let mut draw = Random::new(201);
    for _ in 0..500 {
        let machine = random_delta(&mut draw);
        let g = machine.data().geometry;
        let [x, y, z] = [draw.between(-200.0, 200.0), draw.between(-200.0, 200.0), 900.0];
        let Ok(found) = platform(&machine, [x, y, z]) else { continue };
        let x1 = x + g.D1 - g.d1;
        let height = (g.L1 * g.L1 - x1 * x1 - y * y).sqrt();
        let translating: Vec<_> = found.iter().filter(|posture| posture.pose.alpha == 0.0).collect();
        for posture in &translating {
            assert!(((z - posture.rho[0]).abs() - height).abs() < 1e-11 * g.L1, "{posture:?}");
            assert!(!posture.mode.crossed && posture.pose.alpha.is_sign_positive());
        }
        let e = g.L1 * g.L1 - x1 * x1 - 4.0 * g.R1 * g.R1;
        let root = (e * e + 16.0 * g.R1 * g.R1 * y * y).sqrt();
        let m_square = if e > 0.0 { 0.5 * (e + root) } else { 8.0 * (g.R1 * y).powi(2) / (root - e) };
        let w1 = (m_square - y * y).sqrt();
        for posture in found.iter().filter(|posture| posture.pose.alpha != 0.0) {
            let side = (z - posture.rho[0]).signum();
            let alpha = 2.0 * (side * w1).atan2(y);
            let turn = (0.5 * (posture.pose.alpha - alpha)).sin();
            assert!(turn.abs() < 1e-10, "{posture:?}: {alpha}");
            assert!(posture.mode.crossed && !posture.working);
        }
        let turning = found.len() - translating.len();
        assert!(translating.len() == 8 || translating.is_empty(), "{found:#?}");
        assert!(turning == 8 || turning == 0, "{found:#?}");
        assert_eq!(found.iter().filter(|posture| posture.working).count(), 1);
    }
}

#[test]
fn a_tool_or_a_part_has_the_translating_platform_in_the_working_mode() {
    let (mut draw, mut count) = (Random::new(202), 0);
    for _ in 0..500 {
        let machine = random_delta(&mut draw);
        let u = [draw.between(-150.0, 150.0), draw.between(-150.0, 150.0), 1000.0];
        let length = draw.between(-200.0, 200.0);
        if let Ok(working) = tool_working(&machine, u, length) {
            assert!(working.pose.alpha == 0.0 && working.working);
            let all = tool(&machine, u, length).unwrap();
            assert!(all.contains(&working), "{working:?} in {all:#?}");
            assert_eq!(all.iter().filter(|posture| posture.pose.alpha == 0.0).count(), 8);
            for posture in &all {
                let back = tool_point(&posture.pose, length);
                assert!((0..3).all(|i| (back[i] - u[i]).abs() < 1e-9), "{posture:?}");
            }
            count += 1;
        }
        let [x, y] = [draw.between(-100.0, 100.0), draw.between(-100.0, 100.0)];
        let target =
            PartPose { x, y, z: 150.0, phi1: draw.between(-0.2, 0.2), phi2: draw.between(-3.0, 3.0) };
        if let Ok(working) = part_working(&machine, &target, 50.0) {
            assert_eq!(working.pose.alpha, 0.0);
            let table = table_angles(&machine, working.pose.alpha, target.phi1, target.phi2);
            assert!((table.theta1 + target.phi1).abs() < 1e-15);
            let all = part(&machine, &target, 50.0).unwrap();
            assert!(all.contains(&working) && all.len() <= 24);
        }
    }
    assert!(count > 300, "{count}");
}

#[test]
fn crossed_rods_are_no_limit_of_the_translating_platform() {
    let machine = Machine::linear_delta();
    let p = [40.0, -70.0, 800.0];
    let margins = Margins::of(&machine, &platform_working(&machine, p).unwrap(), None);
    assert!(margins.rod_crossing.is_none() && margins.feasible(), "{margins:?}");
    assert!(margins.worst(&machine).value.is_finite());
    for posture in platform(&machine, p).unwrap().iter().filter(|posture| posture.mode.crossed) {
        let margins = Margins::of(&machine, posture, None);
        assert!(margins.rod_crossing.unwrap() < 0.0 && !margins.feasible());
    }
    assert_ne!(margins.worst(&machine).constraint, Constraint::RodCrossing);
}

#[test]
fn forward_of_the_translating_platform_turns_by_exactly_nothing() {
    let (mut draw, mut count) = (Random::new(203), 0);
    for _ in 0..2000 {
        let machine = random_delta(&mut draw);
        let p = [draw.between(-200.0, 200.0), draw.between(-200.0, 200.0), 900.0];
        let Ok(posture) = platform_working(&machine, p) else { continue };
        let back = forward_working(&machine, posture.rho).unwrap();
        assert!((0..3).all(|i| ([back.pose.x, back.pose.y, back.pose.z][i] - p[i]).abs() < 1e-8), "{back:?}");
        assert_eq!(back.pose.alpha, 0.0);
        assert_eq!(forward(&machine, posture.rho).unwrap().first(), Some(&back));
        count += 1;
    }
    assert!(count > 1500, "{count}");
}

/// With e1 = e2 besides, sliders exist at which the platform moves along a curve.
#[test]
fn a_platform_that_can_move_is_reported_as_such() {
    let machine = changed(|data| {
        let g = &mut data.geometry;
        (g.R1, g.r1, g.D2, g.d2) = (100.0, 100.0, 200.0, 700.0);
        (g.L2, g.L3) = (1200.0, 1150.0);
    });
    let g = machine.data().geometry;
    let p0 = g.R2 - g.r4;
    let a = (0.5 * (g.L2 * g.L2 + g.L3 * g.L3) - g.L1 * g.L1 - p0 * p0).abs().sqrt();
    assert!(0.5 * (g.L2 * g.L2 + g.L3 * g.L3) > g.L1 * g.L1 + p0 * p0);
    assert_eq!(forward(&machine, [0.0, -a, a]), Err(KinematicsError::SelfMotion));
}

/// The rod length and the radius of `config/example-delta.cfg` of the printer firmware Klipper
/// (<https://github.com/Klipper3d/klipper>), and the formula of its inverse kinematics for towers at 90°, 210° and 330°.
#[test]
fn the_sliders_are_those_of_a_printers_firmware_to_the_last_digits() {
    let (rod, radius) = (333.0, 174.75);
    let machine = with_columns_on_a_circle(radius, 25.0, rod);
    let mut draw = Random::new(204);
    for _ in 0..1000 {
        let [x, y] = [draw.between(-80.0, 80.0), draw.between(-80.0, 80.0)];
        let z = draw.between(0.0, 250.0);
        // The firmware's z points up and its y to the tower at 90°, which is leg I.
        let found = platform_working(&machine, [y, x, -z]).unwrap();
        for (leg, angle) in [90_f64, 210.0, 330.0].map(f64::to_radians).into_iter().enumerate() {
            let (tower_x, tower_y) = (radius * angle.cos(), radius * angle.sin());
            let height = (rod * rod - (x - tower_x).powi(2) - (y - tower_y).powi(2)).sqrt() + z;
            assert!((height + found.rho[leg]).abs() < 5e-13, "{height} {found:?}");
        }
    }
}

//! Forward of inverse near R1 = r1 and near e1 = e2: no working posture is lost.

use verne_solver::{Machine, forward, forward_working, jacobian, platform_working};

use crate::machines::near_the_edge;
use crate::random::Random;

/// Numbers of poses that the forward problem does not return at all, or not as the first posture.
fn lost(seed: u64, poses: u32) -> [u32; 2] {
    let (mut draw, mut count, mut lost, mut others) = (Random::new(seed), 0, 0, 0);
    while count < poses {
        let Some(machine) = near_the_edge(&mut draw) else { continue };
        let g = machine.data().geometry;
        for _ in 0..10 {
            let p = [draw.between(-600.0, 600.0), draw.between(-600.0, 600.0), draw.between(500.0, 1500.0)];
            let Ok(posture) = platform_working(&machine, p) else { continue };
            let state = jacobian::conditioning(&machine, &posture);
            // Beyond the parallel singularity another posture is the working one; on it two have merged.
            let home = jacobian::conditioning(&machine, &home(&machine)).det;
            let (e1, e2) = (g.D1 - g.d1, g.D2 - g.d2);
            let beyond = (e1 - e2).abs() < 1e-2 * g.L1.max(g.L2).max(g.L3)
                && (2.0 * p[0] + e1 + e2) * (e1 + e2) <= 0.0;
            if beyond || state.det * home <= 0.0 || state.condition_number.is_none_or(|number| number > 1e5) {
                continue;
            }
            count += 1;
            let is_it = |x: f64, y: f64, z: f64| (x - p[0]).hypot(y - p[1]).hypot(z - p[2]) < 1e-6;
            let back = forward_working(&machine, posture.rho);
            let found = back.is_ok_and(|back| is_it(back.pose.x, back.pose.y, back.pose.z));
            let all = || forward(&machine, posture.rho).unwrap_or_default();
            // Two postures may be on home's side, both in the working mode.
            let is_other = || {
                let mut all = all().into_iter();
                all.any(|other| other.working && is_it(other.pose.x, other.pose.y, other.pose.z))
            };
            others += u32::from(!found);
            let first = count % 10 != 0 || all().first().is_some_and(|first| Ok(*first) == back);
            if !(first && (found || is_other())) {
                eprintln!("{:?} {p:?} {:?} {back:?} {state:?}", machine.data().geometry, posture.rho);
                lost += 1;
            }
        }
    }
    [lost, others]
}

fn home(machine: &Machine) -> verne_solver::Posture {
    platform_working(machine, [0.0, 0.0, 1000.0]).unwrap()
}

#[test]
fn forward_of_inverse_returns_the_pose() {
    assert_eq!(lost(211, 10_000), [0, 0]);
}

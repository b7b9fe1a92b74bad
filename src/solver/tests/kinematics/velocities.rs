//! Velocities of the pose against central differences of the forward problem.

use verne_solver::jacobian::velocities;
use verne_solver::{Machine, Posture, forward_working};

use crate::lengths::scale;
use crate::oracle::Legs;
use crate::oracle::constructed_postures::postures;
use crate::random::Random;

fn pose(posture: &Posture) -> [f64; 4] {
    let p = &posture.pose;
    [p.x, p.y, p.z, p.alpha]
}

/// The rates with one slider, of fourth order; `None` where the working mode ends within the step.
fn differences(machine: &Machine, rho: [f64; 3], slider: usize, step: f64) -> Option<[f64; 4]> {
    let at = |times: f64| {
        let mut moved = rho;
        moved[slider] += times * step;
        forward_working(machine, moved).ok().map(|posture| pose(&posture))
    };
    let [far, near, back, away] = [at(1.0)?, at(0.5)?, at(-0.5)?, at(-1.0)?];
    Some([0, 1, 2, 3].map(|i| (8.0 * (near[i] - back[i]) - (far[i] - away[i])) / (6.0 * step)))
}

fn check(machine: &Machine, posture: &Posture, step: f64, tolerance: f64) -> usize {
    let rates = velocities(machine, posture).expect("a regular posture");
    let unit = scale(machine);
    for slider in 0..3 {
        let Some(expected) = differences(machine, posture.rho, slider, step) else { return 0 };
        for (i, lever) in [1.0, 1.0, 1.0, unit].into_iter().enumerate() {
            let off = (rates[i][slider] - expected[i]).abs() * lever;
            assert!(
                off < tolerance,
                "rate {i} with slider {slider} of {posture:?}: {rates:?}, expected {expected:?}"
            );
        }
    }
    1
}

#[test]
fn velocities_of_the_reference_machine_equal_central_differences() {
    let (machine, mut draw, mut checked) = (Machine::verne(), Random::new(111), 0);
    for _ in 0..1000 {
        let rho = [0, 1, 2].map(|_| draw.between(50.0, 700.0));
        let Ok(posture) = forward_working(&machine, rho) else { continue };
        checked += check(&machine, &posture, 0.5, 1e-7);
    }
    assert!(checked > 800, "{checked}");
}

#[test]
fn velocities_of_random_machines_equal_central_differences() {
    let mut checked = 0;
    for (machine, found) in postures(112, 4000) {
        let legs = Legs::of(&machine);
        if !found.working || found.amplification > 30.0 || scale(&machine) > 20.0 * legs.g.R1 {
            continue;
        }
        let alone = forward_working(&machine, found.rho).expect("a working posture");
        checked += check(&machine, &alone, 2e-4 * scale(&machine), 1e-5);
    }
    assert!(checked > 300, "{checked}");
}

#[test]
fn equal_slider_velocities_move_the_platform_along_z() {
    for (machine, found) in postures(113, 300) {
        let Some(rates) = velocities(&machine, &found.posture(&Legs::of(&machine))) else { continue };
        let together = rates.map(|row| row.iter().sum::<f64>());
        let tolerance = 1e-12 * found.amplification.max(1.0) * scale(&machine) / machine.data().geometry.R1;
        for (rate, expected) in together.into_iter().zip([0.0, 0.0, 1.0, 0.0]) {
            // alpha's rate in turns a machine length.
            assert!(
                (rate - expected).abs() < tolerance * 1e3_f64.max(1.0 / scale(&machine)),
                "{together:?} {found:?}"
            );
        }
    }
}

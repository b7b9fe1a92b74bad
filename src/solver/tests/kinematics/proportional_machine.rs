//! A machine with R2 r1 = R1 r4: the elimination's denominator is then 2 (rho3 - rho2) u, zero for
//! every alpha when rho2 = rho3; and with all sliders level nothing holds the platform's tilt.

use verne_solver::{KinematicsError, Machine, MachineData, forward, forward_working};

use crate::oracle::{self, Comparison};
use crate::random::Random;

fn data() -> MachineData {
    let mut data = Machine::verne().data().clone();
    let g = &mut data.geometry;
    (g.R1, g.r1, g.R2, g.r4) = (300.0, 100.0, 150.0, 50.0);
    (g.L1, g.L2, g.L3) = (1000.0, 900.0, 900.0);
    data
}

pub(crate) fn machine() -> Machine {
    Machine::new(data()).expect("its home pose is regular")
}

fn check(rho: [f64; 3], comparison: &mut Comparison) {
    let machine = machine();
    let answer = oracle::forward(&machine, rho);
    comparison.of(&format!("rho {rho:?}"), &machine, &answer, &forward(&machine, rho));
}

#[test]
fn all_assembly_modes_are_found_at_any_sliders() {
    let (mut draw, mut comparison) = (Random::new(71), Comparison::default());
    for _ in 0..300 {
        check([0, 1, 2].map(|_| draw.between(0.0, 800.0)), &mut comparison);
    }
    comparison.conclude(5, 600);
}

#[test]
fn all_assembly_modes_are_found_at_equal_rho2_and_rho3() {
    let (mut draw, mut comparison) = (Random::new(72), Comparison::default());
    for _ in 0..300 {
        let [rho1, rho2] = [draw.between(0.0, 800.0), draw.between(0.0, 800.0)];
        check([rho1, rho2, rho2], &mut comparison);
    }
    comparison.conclude(5, 600);
}

#[test]
fn all_assembly_modes_are_found_at_rho1_half_way() {
    let (mut draw, mut comparison) = (Random::new(73), Comparison::default());
    for _ in 0..300 {
        let (middle, apart) = (draw.between(0.0, 800.0).round(), draw.between(10.0, 500.0).round());
        check([middle, middle - apart, middle + apart], &mut comparison);
    }
    comparison.conclude(5, 600);
}

#[test]
fn level_sliders_do_not_determine_the_platform() {
    let machine = machine();
    for level in [0.0, 300.0, 512.75] {
        assert!(oracle::forward(&machine, [level; 3]).continuum);
        assert_eq!(forward(&machine, [level; 3]), Err(KinematicsError::SelfMotion));
        assert_eq!(forward_working(&machine, [level; 3]), Err(KinematicsError::SelfMotion));
    }
}

#[test]
fn level_sliders_at_home_are_refused() {
    // L1² - (R1 - r1)² = L2² - (R2 - r4)²: the sliders are level at home, which is then singular.
    let mut data = data();
    data.geometry.L1 = (900_f64.powi(2) - 100_f64.powi(2) + 200_f64.powi(2)).sqrt();
    let faults = Machine::new(data).expect_err("its home pose is singular");
    assert!(faults.iter().all(|fault| fault.field.starts_with("geometry")), "{faults:?}");
}

//! The parallel matrix against numerical differentiation of the rods' lengths, and what is read
//! off it.

use nalgebra::{Matrix4, Vector4};
use verne_solver::jacobian::{conditioning, parallel_matrix, velocities};
use verne_solver::{Machine, MachineData, PlatformPose, Posture};

use crate::lengths::scale;
use crate::oracle::constructed_postures::{hung, postures, upright};
use crate::oracle::{Found, Legs};

/// Rates of the four rods' lengths with x, y, z, R1 alpha by central differences.
fn differences(legs: &Legs, found: &Found) -> Matrix4<f64> {
    let step = 1e-4 * legs.scale();
    Matrix4::from_fn(|row, column| {
        let mut shift = Vector4::zeros();
        shift[column] = if column == 3 { step / legs.g.R1 } else { step };
        let at = |times: f64| legs.errors(&(found.q + shift * times), &found.rho)[row];
        // Fourth order.
        (8.0 * (at(0.5) - at(-0.5)) - (at(1.0) - at(-1.0))) / (6.0 * step)
    })
}

/// Laplace's expansion.
fn determinant(m: &Matrix4<f64>) -> f64 {
    let minor = |column: usize| {
        let c: Vec<usize> = (0..4).filter(|&i| i != column).collect();
        let at = |row: usize, i: usize| m[(row, c[i])];
        at(1, 0) * (at(2, 1) * at(3, 2) - at(2, 2) * at(3, 1))
            - at(1, 1) * (at(2, 0) * at(3, 2) - at(2, 2) * at(3, 0))
            + at(1, 2) * (at(2, 0) * at(3, 1) - at(2, 1) * at(3, 0))
    };
    m[(0, 0)] * minor(0) - m[(0, 1)] * minor(1) + m[(0, 2)] * minor(2) - m[(0, 3)] * minor(3)
}

#[test]
fn the_parallel_matrix_is_the_rate_of_the_rod_lengths() {
    for (machine, found) in postures(101, 1000) {
        let legs = Legs::of(&machine);
        let expected = differences(&legs, &found);
        let got = parallel_matrix(&machine, &found.posture(&legs));
        for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
            let (e, g) = (expected[(row, column)], got[row][column]);
            // A short R1 makes a unit of R1 alpha a large turn.
            let coarse = 1e-7 * (scale(&machine) / legs.g.R1).powi(2);
            assert!(
                (e - g).abs() < coarse.min(1e-3),
                "({row}, {column}): {g}, expected {e}: {found:?} {:?}",
                legs.g
            );
        }
    }
}

#[test]
fn determinant_and_condition_number_belong_to_the_matrix() {
    for (machine, found) in postures(102, 1000) {
        let legs = Legs::of(&machine);
        let rates = legs.rates(&found.q, &found.rho);
        let got = conditioning(&machine, &found.posture(&legs));
        let tolerance = 1e-12 * rates.norm().powi(4);
        assert!((got.det - determinant(&rates)).abs() < tolerance, "{} {}", got.det, determinant(&rates));
        let singular = rates.singular_values();
        let expected = singular[0] / singular[3];
        let number = got.condition_number.expect("a regular posture");
        assert!((number / expected - 1.0).abs() < 1e-13 * expected + 1e-9, "{number}, expected {expected}");
    }
}

#[test]
fn serial_cosines_are_those_between_rods_and_guideways() {
    for (machine, found) in postures(103, 1000) {
        let legs = Legs::of(&machine);
        let got = conditioning(&machine, &found.posture(&legs)).serial;
        for (cosine, rod) in got.into_iter().zip([11, 12, 21, 31]) {
            let d = legs.rod(rod, &found.q, &found.rho);
            assert!((cosine - d.z / d.norm()).abs() < 1e-12, "rod {rod}: {cosine} {d:?}");
        }
    }
}

/// A posture of a machine at which the rods' rates are exactly dependent: u R2 w2 = R1 p w1 in the
/// symmetry plane.
fn singular() -> (Machine, Posture) {
    let mut data: MachineData = Machine::verne().data().clone();
    let g = &mut data.geometry;
    (g.R1, g.r1, g.R2, g.r4) = (300.0, 100.0, 150.0, 50.0);
    (g.L1, g.L2, g.L3) = (1000.0, 900.0, 900.0);
    let machine = Machine::new(data).expect("its home pose is regular");
    let legs = Legs::of(&machine);
    // Both legs as high at this x: L1² - X1² - u² = L2² - X2² - p².
    let g = &legs.g;
    let (e1, e2) = (g.D1 - g.d1, g.D2 - g.d2);
    let x =
        (g.L1 * g.L1 - 200.0 * 200.0 - e1 * e1 - (g.L2 * g.L2 - 100.0 * 100.0 - e2 * e2)) / (2.0 * (e1 - e2));
    let found = hung(&legs, upright(&legs, 0.0, x, 1000.0, 1.0).unwrap(), [1.0, 1.0]).unwrap();
    (machine, found.posture(&legs))
}

#[test]
fn a_singular_posture_has_no_velocities() {
    let (machine, posture) = singular();
    let conditioning = conditioning(&machine, &posture);
    assert!(conditioning.det.abs() < 1e-15, "{conditioning:?}");
    assert!(conditioning.condition_number.is_none_or(|number| number > 1e14), "{conditioning:?}");
    assert_eq!(velocities(&machine, &posture), None);
}

#[test]
fn the_reference_machine_is_regular_at_home() {
    let machine = Machine::verne();
    let legs = Legs::of(&machine);
    let home = hung(&legs, upright(&legs, 0.0, 0.0, 1000.0, 1.0).unwrap(), [1.0, 1.0]).unwrap();
    let at_home = conditioning(&machine, &home.posture(&legs));
    let PlatformPose { x, y, z, alpha } = home.posture(&legs).pose;
    assert_eq!((x, y, z, alpha), (0.0, 0.0, 1000.0, 0.0));
    // The matrix splits at home into x, z and y, alpha: two rods' inclinations and two levers.
    let [w1, w2] = [home.q[2] - home.rho[0], home.q[2] - home.rho[1]];
    let (e1, e2, u, p) = (-500.0, 500.0, 200.0, -350.0);
    let expected = 4.0 * (e1 * w2 - e2 * w1) * (u * 150.0 / 275.0 * w2 - p * w1) / 1050_f64.powi(4);
    assert!((at_home.det.abs() - expected.abs()).abs() < 1e-12, "{at_home:?}, expected {expected}");
}

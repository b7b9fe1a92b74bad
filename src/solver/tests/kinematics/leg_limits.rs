//! The ends of the legs' reach in the inverse problem: leg I, where two angles merge, and legs II
//! and III at full stretch across the guideways, where the slider's two positions merge.

use std::f64::consts::PI;

use verne_solver::{Constraint, Element, KinematicsError, Machine, Posture, platform, platform_working};

use crate::oracle::Legs;
use crate::oracle::constructed_postures::{drops_squared, hung, leaning};
use crate::random::Random;

/// Distances from a limit, mm.
const DISTANCES: [f64; 10] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];
/// Down to here two merging postures are well apart in double precision: some 1e-2 mm.
const APART: f64 = 1e-7;

/// The alpha in (0, π) at which leg I reaches farthest from its guideway, and X1 there: beyond it
/// no angle solves (A). `y` is not zero.
fn farthest(legs: &Legs, y: f64) -> (f64, f64) {
    let g = &legs.g;
    let x1_squared = |alpha: f64| {
        let (u, v) = (g.R1 * alpha.cos() - g.r1, g.R1 * alpha.sin());
        g.L1 * g.L1 - y * y - u * u - v * v - (y * u / v).powi(2)
    };
    let coarse = (1..3000).map(|i| PI * f64::from(i) / 3000.0);
    let start = coarse.max_by(|&a, &b| x1_squared(a).total_cmp(&x1_squared(b))).unwrap();
    let (mut low, mut high) = (start - PI / 3000.0, start + PI / 3000.0);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if x1_squared(a) < x1_squared(b) { low = a } else { high = b }
    }
    (low, x1_squared(low).sqrt())
}

/// The postures near an angle, their number with merged ones counted twice, and their residuals
/// checked.
fn near(all: &[Posture], alpha: f64, within: f64) -> (usize, usize) {
    let near: Vec<_> = all.iter().filter(|posture| (posture.pose.alpha - alpha).abs() < within).collect();
    for posture in &near {
        assert!(posture.residual < 1e-9, "{posture:?}");
    }
    (near.len(), near.iter().map(|posture| if posture.merged { 2 } else { 1 }).sum())
}

#[test]
fn solutions_at_the_greatest_reach_of_leg_one_are_found() {
    let (machine, mut draw) = (Machine::verne(), Random::new(81));
    let legs = Legs::of(&machine);
    let offset = legs.g.D1 - legs.g.d1;
    for _ in 0..20 {
        let y = draw.between(30.0, 400.0) * draw.pick(&[1.0, -1.0]);
        let (alpha, x1) = farthest(&legs, y);
        // On the far side of the guideway, where legs II and III reach easily.
        let p = |inward: f64| [-(x1 - inward) - offset, y, 1200.0];
        for distance in DISTANCES {
            let apart = 20.0 * (distance / 1000.0).sqrt() + 1e-5;
            let inside = platform(&machine, p(distance)).expect("within reach");
            let (found, counted) = near(&inside, alpha, apart);
            let exact = distance >= APART;
            assert!(
                if exact { found == 8 && counted == 8 } else { counted == 8 },
                "{distance:e} inside {:?}: {inside:#?}",
                p(0.0)
            );
            match platform(&machine, p(-distance)) {
                Err(KinematicsError::Unreachable(margin)) => {
                    assert_eq!(margin.constraint, Constraint::LegLength, "{distance:e} outside: {margin:?}");
                    assert_eq!(margin.element, Element::Leg(1), "{distance:e} outside: {margin:?}");
                    assert!(margin.value < 0.0, "{margin:?}");
                }
                Err(other) => panic!("{distance:e} outside: {other:?}"),
                Ok(outside) => {
                    assert!(!exact && outside.iter().all(|p| p.merged && p.residual < 1e-9), "{outside:#?}");
                }
            }
        }
        if let Ok(limit) = platform(&machine, p(0.0)) {
            let (found, counted) = near(&limit, alpha, 1e-5);
            assert!(counted == 8 && (found == 4 || found == 8), "at {:?}: {limit:#?}", p(0.0));
        }
    }
}

/// The reference machine with leg II so long that it is stretched across the guideways at a
/// posture, but for a height `drop` squared (negative: out of reach), and that posture's platform.
fn stretched(alpha: f64, y: f64, drop_squared: f64) -> (Machine, [f64; 3], f64) {
    let mut data = Machine::verne().data().clone();
    let legs = Legs::of(&Machine::verne());
    let (q, rho1) = leaning(&legs, alpha, y, 1200.0, -1.0).expect("leg I reaches");
    let across = legs.g.L2 * legs.g.L2 - drops_squared(&legs, &q)[0];
    data.geometry.L2 = (across + drop_squared).sqrt();
    (Machine::new(data).expect("leg II reaches home"), [q[0], q[1], q[2]], rho1)
}

#[test]
fn solutions_at_the_greatest_reach_of_leg_two_are_found() {
    for (alpha, y) in [(-0.2, 200.0), (-0.3, 250.0), (-0.25, 300.0)] {
        for slack in DISTANCES {
            // A length longer by `slack` leaves a height of sqrt(2 L slack), some 1e-6 mm at least.
            let drop_squared = 2.0 * 600.0 * slack;
            let (machine, p, rho1) = stretched(alpha, y, drop_squared);
            let all = platform(&machine, p).expect("within reach");
            let (found, counted) = at(&all, alpha, rho1);
            let exact = slack >= APART;
            assert!(
                if exact { found == 4 && counted == 4 } else { counted == 4 },
                "{slack:e} inside, alpha {alpha}: {found} {counted} {all:#?}"
            );

            let (machine, p, rho1) = stretched(alpha, y, -drop_squared);
            let (found, counted) = at(&platform(&machine, p).unwrap_or_default(), alpha, rho1);
            assert!(
                found == 0 || !exact && counted == 2 * found,
                "{slack:e} outside, alpha {alpha}: {found}"
            );
        }
        let (machine, p, rho1) = stretched(alpha, y, 0.0);
        let all = platform(&machine, p).expect("within reach");
        let (found, counted) = at(&all, alpha, rho1);
        assert!(counted == 4 && (found == 2 || found == 4), "alpha {alpha}: {all:#?}");
    }
}

/// The postures at an angle and a slider 1, and their number with merged ones counted twice.
fn at(all: &[Posture], alpha: f64, rho1: f64) -> (usize, usize) {
    let here: Vec<Posture> =
        all.iter().filter(|posture| (posture.rho[0] - rho1).abs() < 1e-3).copied().collect();
    near(&here, alpha, 1e-6)
}

#[test]
fn a_position_beyond_a_leg_names_the_leg() {
    // Leg III's guideway is at y = +500: it is the one that does not reach there.
    let machine = Machine::verne();
    let legs = Legs::of(&machine);
    let mut named = 0;
    for (alpha, y) in [(0.2, -200.0), (0.3, -250.0), (0.25, -300.0)] {
        let (q, rho1) = leaning(&legs, alpha, y, 1200.0, -1.0).expect("leg I reaches");
        let mut data = machine.data().clone();
        let across = legs.g.L3 * legs.g.L3 - drops_squared(&legs, &q)[1];
        data.geometry.L3 = across.sqrt() - 1.0;
        let Ok(short) = Machine::new(data) else { continue };
        assert!(hung(&Legs::of(&short), (q, rho1), [1.0, 1.0]).is_none());
        let Err(KinematicsError::Unreachable(margin)) = platform_working(&short, [q[0], q[1], q[2]]) else {
            panic!("leg III is a millimetre short at {q:?}")
        };
        assert_eq!(
            (margin.constraint, margin.element),
            (Constraint::LegLength, Element::Leg(3)),
            "{margin:?}"
        );
        // A signed root: the millimetre lacking is a deficit of sqrt(2 L) under the root.
        let deficit = -(2.0 * (across.sqrt() - 0.5)).sqrt();
        assert!((margin.value - deficit).abs() < 1e-3, "{margin:?}, expected {deficit}");
        named += 1;
    }
    assert!(named > 0);
}

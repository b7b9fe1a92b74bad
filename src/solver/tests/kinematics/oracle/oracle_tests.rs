//! The oracle against the published reference sets, and against constructed postures.

use std::f64::consts::PI;

use nalgebra::Vector4;
use verne_solver::PartPose;

use super::constructed_postures::postures;
use super::inverse::{Path, inverse};
use super::solution::{Answer, Found, wrapped};
use super::{Legs, forward};
use crate::reference_cases::{self, Solution};

fn check(legs: &Legs, tag: &str, answer: &Answer, solutions: &[Solution]) {
    assert!(!answer.continuum && answer.touches.is_empty(), "{tag}: {answer:?}");
    assert_eq!(answer.found.len(), solutions.len(), "{tag}: {answer:?}");
    for truth in solutions {
        let [x, y, z] = truth.platform;
        let truth_q = Vector4::new(x, y, z, truth.alpha);
        let hit = answer.found.iter().find(|found| {
            let turned = wrapped(found.q[3] - truth.alpha).abs();
            let off = (found.q - truth_q).xyz().amax();
            let sliders = (0..3).map(|i| (found.rho[i] - truth.rho[i]).abs()).fold(0.0, f64::max);
            turned < 1e-9 * PI / 180.0 && off < 1e-9 && sliders < 1e-9
        });
        let found = hit.unwrap_or_else(|| panic!("{tag}: no {truth_q:?} in {answer:?}"));
        assert_eq!(found.working, truth.working, "{tag}");
        assert!(legs.residual(&found.q, &found.rho) < 1e-12 * legs.scale(), "{tag}");
    }
}

#[test]
fn the_oracle_finds_the_reference_forward_solutions() {
    for case in reference_cases::forward() {
        check(&Legs::of(&case.machine), &case.tag, &forward(&case.machine, case.rho), &case.solutions);
    }
}

#[test]
fn the_oracle_finds_the_reference_inverse_solutions() {
    for case in reference_cases::inverse() {
        let path = if let Some(tool_length) = case.tool_length {
            let [x, y, z, phi1, phi2] = case.pose[..] else { panic!("{}", case.tag) };
            Path::part(&case.machine, &PartPose { x, y, z, phi1, phi2 }, tool_length)
        } else {
            Path::platform(case.pose[..].try_into().unwrap())
        };
        check(&Legs::of(&case.machine), &case.tag, &inverse(&case.machine, &path), &case.solutions);
    }
}

/// The posture is among the answer's, once.
fn found_once(built: &Found, answer: &Answer, unit: f64) {
    let same = |found: &&Found| {
        let sliders = (0..3).map(|i| (found.rho[i] - built.rho[i]).abs()).fold(0.0, f64::max);
        (found.q - built.q).xyz().amax().max(sliders) < 1e-7 * unit
            && wrapped(found.q[3] - built.q[3]).abs() < 1e-6
    };
    assert_eq!(answer.found.iter().filter(same).count(), 1, "{built:?} in {answer:?}");
}

#[test]
fn the_oracle_finds_every_constructed_posture() {
    let mut checked = 0;
    for (machine, built) in postures(1, 2000) {
        let legs = Legs::of(&machine);
        let drops = [11, 12, 21, 31].map(|rod| legs.rod(rod, &built.q, &built.rho).z.abs() / legs.scale());
        if built.amplification > 1e4 || drops.into_iter().any(|drop| drop < 1e-3) {
            continue; // about to merge with another
        }
        found_once(&built, &forward(&machine, built.rho), legs.scale());
        let path = Path::platform([built.q[0], built.q[1], built.q[2]]);
        found_once(&built, &inverse(&machine, &path), legs.scale());
        checked += 1;
    }
    assert!(checked > 1800, "{checked}");
}

//! The postures along a locus of P.

use std::f64::consts::PI;

use super::infeasibility;
use super::leg_one_closure::LegOneClosure;
use super::platform::{platform, platform_working};
use super::platform_locus::PlatformLocus;
use super::solutions::{add_postures, working_posture};
use crate::error::KinematicsError;
use crate::fast_math::{sin_cos, wrapped};
use crate::loop_closure::{Root, Roots, find_roots, from_level_platform, polish};
use crate::machine::Machine;
use crate::posture::{Posture, Postures, postures_or_error};

/// All postures along the locus.
pub(super) fn every(machine: &Machine, locus: &PlatformLocus) -> Result<Postures, KinematicsError> {
    if let Some(p) = locus.fixed_point() {
        return platform(machine, p);
    }
    let mechanism = &machine.mechanism;
    let closure = LegOneClosure::new(mechanism, locus);
    let mut roots = Roots::new();
    // The working mode's posture is the one that `working` answers, to the last bit.
    find_roots(&closure, PI, from_level_platform(&closure), &mut roots);
    postures_or_error(
        |found| {
            roots.iter().for_each(|root| add_postures(mechanism, &locus.pose(mechanism, root), found));
        },
        || infeasibility::of_every_mode(machine, locus),
    )
}

/// The posture in the working mode along the locus.
#[inline]
pub(super) fn working(machine: &Machine, locus: &PlatformLocus) -> Result<Posture, KinematicsError> {
    if let Some(p) = locus.fixed_point() {
        return platform_working(machine, p);
    }
    let closure = LegOneClosure::new(&machine.mechanism, locus);
    let level = from_level_platform(&closure);
    if let Some(root) = &level {
        let answer = working_posture(machine, &locus.pose(&machine.mechanism, root));
        if answer.is_ok() {
            return answer;
        }
    }
    working_among_all(machine, locus, &closure, level).map(|postures| postures[0])
}

/// The posture in the working mode that Newton's method finds from alpha of another one, its sine and cosine, and the
/// height of leg I; with sine and cosine of its own alpha.
#[inline]
pub(super) fn working_near(
    machine: &Machine,
    locus: &PlatformLocus,
    (alpha, [s, c], height): (f64, [f64; 2], f64),
) -> Option<(Posture, [f64; 2])> {
    if let Some(p) = locus.fixed_point() {
        let posture = platform_working(machine, p).ok()?;
        let (sine, cosine) = sin_cos(posture.pose.alpha);
        return Some((posture, [sine, cosine]));
    }
    let closure = LegOneClosure::new(&machine.mechanism, locus);
    let root = polish(&closure, Root::at(alpha, [c, s], height))?;
    let pose = locus.pose(&machine.mechanism, &root);
    let [cosine, sine] = pose.checked;
    Some((working_posture(machine, &pose).ok()?, [sine, cosine]))
}

/// All postures in the working mode along the locus, that of [`working`] first. There is at least one, or the function
/// returns an error.
pub(super) fn every_working(machine: &Machine, locus: &PlatformLocus) -> Result<Postures, KinematicsError> {
    if let Some(p) = locus.fixed_point() {
        return platform_working(machine, p).map(|posture| [posture].into_iter().collect());
    }
    let closure = LegOneClosure::new(&machine.mechanism, locus);
    let level = from_level_platform(&closure);
    let mut found = working_among_all(machine, locus, &closure, level)?;
    let first =
        level.and_then(|level| found.iter().position(|posture| posture.pose.alpha == wrapped(level.a)));
    found.swap(0, first.unwrap_or(0));
    Ok(found)
}

/// The postures in the working mode among all roots at which leg I's rods do not cross.
#[cold]
fn working_among_all(
    machine: &Machine,
    locus: &PlatformLocus,
    closure: &LegOneClosure,
    known: Option<Root>,
) -> Result<Postures, KinematicsError> {
    let mechanism = &machine.mechanism;
    let (mut found, mut first_error) = (Postures::new(), None);
    let mut roots = Roots::new();
    find_roots(closure, mechanism.uncrossed, known, &mut roots);
    for root in roots.iter().filter(|root| root.w >= 0.0) {
        match working_posture(machine, &locus.pose(mechanism, root)) {
            Ok(posture) => found.push(posture),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    if found.is_empty() {
        return Err(first_error
            .unwrap_or_else(|| KinematicsError::Unreachable(infeasibility::of_leg_one(machine, locus))));
    }
    Ok(found)
}

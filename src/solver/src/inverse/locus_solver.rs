//! The postures along a locus of P.

use std::f64::consts::PI;

use super::infeasibility;
use super::leg_one_closure::LegOneClosure;
use super::platform::{platform, platform_working};
use super::platform_locus::PlatformLocus;
use super::solutions::{add_postures, working_posture};
use crate::error::KinematicsError;
use crate::fast_math::{sin_cos, wrapped};
use crate::loop_closure::{LoopClosure, Root, Roots, find_roots, from_level_platform, polish};
use crate::machine::Machine;
use crate::posture::{Posture, Postures, postures_or_error};

/// Angle, and height over the machine's size, within which a root is one of the platform that does not turn.
const LEVEL_ANGLE: f64 = 1e-9;

/// All postures along the locus.
pub(super) fn every(machine: &Machine, locus: &PlatformLocus) -> Result<Postures, KinematicsError> {
    if let Some(p) = locus.fixed_point() {
        return platform(machine, p);
    }
    let mechanism = &machine.mechanism;
    let closure = LegOneClosure::new(mechanism, locus);
    let mut roots = Roots::new();
    // The working mode's posture is the one that `working` answers, to the last bit.
    let level = from_level_platform(&closure);
    find_roots(&closure, PI, level, &mut roots);
    if let Some(level) = level.filter(|_| mechanism.is_delta()) {
        replace_level_roots(&closure, &level, &mut roots);
    }
    postures_or_error(
        |found| {
            roots.iter().for_each(|root| add_postures(mechanism, &locus.pose(mechanism, root), found));
        },
        || infeasibility::of_every_mode(machine, locus),
    )
}

/// With R1 = r1 the platform that does not turn closes leg I from both sides. Its angle is zero without a rounding
/// error.
#[cold]
fn replace_level_roots(closure: &LegOneClosure, level: &Root, roots: &mut Roots) {
    let is_level = |root: &Root| {
        let apart = (root.w.abs() - level.w).abs();
        wrapped(root.a).abs() < LEVEL_ANGLE && apart < LEVEL_ANGLE * closure.w_scale()
    };
    roots.retain(|root| !is_level(root));
    let both = [*level, Root { w: -level.w, ..*level }];
    roots.extend(both.into_iter().take(roots.remaining_capacity()));
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
    if mechanism.is_delta() {
        // Only the platform that does not turn has uncrossed rods.
        roots.extend(known);
    } else {
        find_roots(closure, mechanism.uncrossed, known, &mut roots);
    }
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

//! Comparison of one answer of the solver with the oracle's.

use std::fmt::Write as _;

use verne_solver::{Machine, Posture};

use super::legs::Legs;
use super::solution::{Answer, Found, wrapped};

/// Error allowed where a solution is well separated from the others, in machine lengths: just
/// below 1e-9 mm on the reference machine.
const ERROR: f64 = 9e-13;
/// Amplification of errors up to which that holds; beyond, the error may grow with it.
const PLAIN: f64 = 1e3;
/// How near to a merging pair an answer counts as part of it, in machine lengths.
const NEAR_A_PAIR: f64 = 1e-3;

/// How many answers were compared, and how many of them leniently.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) compared: usize,
    pub(crate) lenient: usize,
    pub(crate) solutions: usize,
    pub(crate) most: usize,
    pub(crate) empty: usize,
}

/// Compares; the error says what differs.
///
/// Where the oracle sees no two solutions within a hundredth of a millimetre (on a metre), the
/// answers must be the same, one to one, labels included. Where it does, that is counted as
/// lenient: solutions away from the pair must still be the same, and whatever else the solver
/// returns must lie at the pair.
pub(crate) fn agree(
    machine: &Machine,
    answer: &Answer,
    postures: &[Posture],
    tally: &mut Tally,
) -> Result<(), String> {
    let legs = Legs::of(machine);
    let lenient = !answer.touches.is_empty() || answer.found.iter().any(Found::weak);
    tally.compared += 1;
    tally.lenient += usize::from(lenient);
    tally.solutions += answer.found.len();
    tally.most = tally.most.max(answer.found.len());
    tally.empty += usize::from(answer.found.is_empty());
    let compared = compare(&legs, answer, postures);
    compared.map_err(|what| {
        let (oracle, solver) = (listed_found(&answer.found), listed(postures));
        format!("{what}\noracle:\n{oracle}touches: {:?}\nsolver:\n{solver}{:?}", answer.touches, legs.g)
    })
}

fn compare(legs: &Legs, answer: &Answer, postures: &[Posture]) -> Result<(), String> {
    let mut unmatched: Vec<&Posture> = postures.iter().collect();
    for found in answer.found.iter().filter(|found| !found.weak()) {
        let allowed = legs.scale() * ERROR * (found.amplification / PLAIN).max(1.0);
        let Some((at, distance)) = nearest(legs, found, &unmatched) else {
            return Err(format!("a solution is missing: {found:?}"));
        };
        if distance > allowed {
            return Err(format!("{distance:e} mm off, {allowed:e} allowed, or missing: {found:?}"));
        }
        same_labels(found, unmatched.remove(at))?;
    }
    let weak = answer.found.iter().filter(|found| found.weak());
    let pairs: Vec<_> = weak.map(|found| found.q).chain(answer.touches.iter().copied()).collect();
    for posture in unmatched {
        let p = &posture.pose;
        let at_pair = |q: &nalgebra::Vector4<f64>| {
            let lever = legs.g.R1 * wrapped(p.alpha - q[3]);
            let distance =
                [p.x - q[0], p.y - q[1], p.z - q[2], lever].map(f64::abs).into_iter().fold(0.0, f64::max);
            distance < NEAR_A_PAIR * legs.scale()
        };
        if !pairs.iter().any(at_pair) {
            return Err(format!("not a solution, or one too many: {posture:?}"));
        }
    }
    Ok(())
}

fn nearest(legs: &Legs, found: &Found, postures: &[&Posture]) -> Option<(usize, f64)> {
    let distances = postures.iter().enumerate().map(|(i, p)| (i, distance(legs, found, p)));
    distances.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Largest difference of a coordinate, alpha on the lever R1.
pub(crate) fn distance(legs: &Legs, found: &Found, posture: &Posture) -> f64 {
    let (p, q) = (&posture.pose, &found.q);
    let sliders = (0..3).map(|i| posture.rho[i] - found.rho[i]);
    [p.x - q[0], p.y - q[1], p.z - q[2], legs.g.R1 * wrapped(p.alpha - q[3])]
        .into_iter()
        .chain(sliders)
        .fold(0.0, |most, d| if d.is_nan() { f64::INFINITY } else { d.abs().max(most) })
}

fn same_labels(found: &Found, posture: &Posture) -> Result<(), String> {
    let same = found.working == posture.working && found.mode == posture.mode;
    if posture.merged || found.signs_certain && !same {
        return Err(format!("labels differ: oracle {found:?}, solver {posture:?}"));
    }
    Ok(())
}

/// The solver's postures, one a line, with all digits.
pub(crate) fn listed(postures: &[Posture]) -> String {
    let mut text = String::new();
    for posture in postures {
        let p = &posture.pose;
        let flags = (posture.working, posture.merged);
        writeln!(
            text,
            "  {:?} rho {:?} {flags:?} {:e}",
            (p.x, p.y, p.z, p.alpha),
            posture.rho,
            posture.residual
        )
        .unwrap();
    }
    text
}

fn listed_found(found: &[Found]) -> String {
    let mut text = String::new();
    for f in found {
        let q = (f.q[0], f.q[1], f.q[2], f.q[3]);
        writeln!(text, "  {q:?} rho {:?} {} amplified {:.1e}", f.rho, f.working, f.amplification).unwrap();
    }
    text
}

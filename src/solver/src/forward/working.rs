//! The one posture in the working mode among several that its conditions on rods allow.

use arrayvec::ArrayVec;

use crate::machine::Machine;
use crate::parallel_matrix::{determinant, matrix};
use crate::posture::{MAX_POSTURES, Posture, Postures};
use crate::rods::Rods;

/// Whether `det_P` has the sign of home. With equal offsets, or nearly so, X1 = 0 is a singularity that separates two
/// mirror images, and X1 has the sign of home, too.
pub(super) fn on_home_side(machine: &Machine, posture: &Posture) -> bool {
    let (e1, e2) = (machine.mechanism.e1, machine.mechanism.e2);
    if machine.mechanism.offsets_nearly_equal && (2.0 * posture.pose.x + e1 + e2) * (e1 + e2) <= 0.0 {
        return false;
    }
    let rods = Rods::of(&machine.mechanism, &posture.pose, posture.rho);
    determinant(&matrix(machine.geometry(), &rods)) * machine.home.det > 0.0
}

/// Of several postures with all sliders above and uncrossed rods, those on home's side of the singularity are in the
/// working mode, if there is one. The posture that `known` returns becomes the first, or the first of them.
#[inline]
pub(super) fn put_working_first(
    machine: &Machine,
    known: impl FnOnce() -> Option<Posture>,
    postures: &mut Postures,
) {
    let mut working = postures.iter().enumerate().filter(|(_, posture)| posture.working).map(|(i, _)| i);
    match (working.next(), working.next()) {
        (None | Some(0), None) => {}
        (Some(i), None) => postures.swap(0, i),
        _ => choose(machine, known(), postures),
    }
}

/// The same if there are several.
#[cold]
fn choose(machine: &Machine, known: Option<Posture>, postures: &mut Postures) {
    let sides: ArrayVec<bool, MAX_POSTURES> =
        postures.iter().map(|posture| posture.working && on_home_side(machine, posture)).collect();
    if sides.contains(&true) {
        postures.iter_mut().zip(sides).for_each(|(posture, is_home)| posture.working = is_home);
    }
    let is_known = |posture: &Posture| known.is_some_and(|known| known.pose == posture.pose);
    let first = postures
        .iter()
        .position(|posture| posture.working && is_known(posture))
        .or_else(|| postures.iter().position(|posture| posture.working));
    postures.swap(0, first.unwrap_or(0));
}

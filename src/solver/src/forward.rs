//! Forward kinematics: from the sliders to the platform (section III.D).

mod elimination;
mod obstacle;

use std::f64::consts::PI;

use crate::closure::{Root, Roots, determinant, find_roots, from_level, wrapped};
use crate::jacobian::at_home;
use crate::limit::{Refusal, in_domain};
use crate::machine::{Derived, Geometry, Machine};
use crate::pose::PlatformPose;
use crate::posture::{Mode, Posture, Postures, Side, gathered};
use crate::residual::{Checked, RESIDUAL_TOLERANCE, checked, size};
use elimination::Assembly;

/// Finds all assembly modes (up to 8) for slider positions `rho`.
///
/// # Units
///
/// `rho` is the sliders' z in the base frame, mm; z points down. The poses are in millimetres and radians.
///
/// # Errors
///
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::SelfMotion`]: the platform can move with all sliders locked.
/// - [`Refusal::Blocked`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (24), section III.D,
/// Fig. 6.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, forward};
///
/// let modes = forward(&Machine::verne(), [674.0, 685.0, 250.0])?;
/// assert_eq!(modes.len(), 4);
/// assert_eq!(modes.iter().filter(|posture| posture.working).count(), 1);
/// # Ok::<(), Refusal>(())
/// ```
pub fn forward(machine: &Machine, rho: [f64; 3]) -> Result<Postures, Refusal> {
    let assembly = question(machine, rho)?;
    let mut roots = Roots::new();
    // The working mode's posture is the one that `forward_working` answers, to the last bit.
    find_roots(&assembly, PI, from_level(&assembly), &mut roots);
    gathered(
        |found| found.extend(roots.iter().filter_map(|root| posture(machine, &assembly, rho, root))),
        || obstacle::nearest(machine, &assembly),
    )
}

/// Finds the assembly mode in the working mode. It needs no start value.
///
/// If there are two, which takes sliders far outside their strokes, it is the one whose det_P has the sign of home.
///
/// # Units
///
/// `rho` is the sliders' z in the base frame, mm; z points down. The poses are in millimetres and radians.
///
/// # Errors
///
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::SelfMotion`]: the platform can move with all sliders locked.
/// - [`Refusal::Blocked`]: no assembly mode is in the working mode; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), section III.D.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, forward_working};
///
/// let posture = forward_working(&Machine::verne(), [674.0, 685.0, 250.0])?;
/// assert!((posture.pose.z - 1316.470).abs() < 1e-3);
/// assert!(posture.residual < 1e-9);
/// # Ok::<(), Refusal>(())
/// ```
pub fn forward_working(machine: &Machine, rho: [f64; 3]) -> Result<Posture, Refusal> {
    let assembly = question(machine, rho)?;
    // Newton's method on the sheet λ > 0 from the level platform finds the working mode in practice. Its result
    // counts only if it is in the working mode and on home's side of the singularity.
    let level = from_level(&assembly);
    if let Some(root) = level
        && on_home_side(machine, &assembly, &root)
        && let Some(posture) = posture(machine, &assembly, rho, &root)
        && posture.working
    {
        return Ok(posture);
    }
    among_all(machine, &assembly, rho, level)
}

/// The working mode among all roots of the sheet, wherever they are.
#[cold]
fn among_all(
    machine: &Machine,
    assembly: &Assembly,
    rho: [f64; 3],
    level: Option<Root>,
) -> Result<Posture, Refusal> {
    // The rods of leg I cross beyond this angle.
    let uncrossed = machine.derived.uncrossed;
    let mut found: Option<Posture> = None;
    let mut roots = Roots::new();
    find_roots(assembly, uncrossed, level, &mut roots);
    for root in roots {
        let working = posture(machine, assembly, rho, &root).filter(|posture| posture.working);
        if let Some(posture) = working
            && (found.is_none() || on_home_side(machine, assembly, &root))
        {
            found = Some(posture);
        }
    }
    found.ok_or_else(|| Refusal::Blocked(obstacle::out_of_mode(machine, rho, assembly)))
}

#[inline]
fn on_home_side(machine: &Machine, assembly: &Assembly, root: &Root) -> bool {
    determinant(assembly, root) * machine.derived.home_turn > 0.0
}

/// The closure's determinant at home, all sliders above: its sign is the machine's.
pub(crate) fn turn_at_home(g: &Geometry, derived: &Derived) -> f64 {
    let [w1, w2, w3] = at_home(g).drops;
    let assembly = Assembly::new(g, derived, [-w1, -w2, -w3]);
    determinant(&assembly, &Root::at(0.0, [1.0, 0.0], w1 / (g.R1 - g.r1)))
}

fn question(machine: &Machine, rho: [f64; 3]) -> Result<Assembly, Refusal> {
    in_domain(machine, &rho, &[])?;
    let assembly = Assembly::new(machine.geometry(), &machine.derived, rho);
    if assembly.is_free(machine.derived.scale) { Err(Refusal::SelfMotion) } else { Ok(assembly) }
}

/// The posture of one root of the loop closure; `None` if it does not satisfy Eqs (3)-(6).
#[inline]
fn posture(machine: &Machine, assembly: &Assembly, rho: [f64; 3], root: &Root) -> Option<Posture> {
    let g = machine.geometry();
    let (u, v) = (g.R1 * root.c - g.r1, g.R1 * root.s);
    let w1 = root.w * u;
    let pose = PlatformPose {
        x: assembly.x1(root.c, root.s, root.w) - machine.derived.e1,
        y: -root.w * v,
        z: rho[0] + w1,
        alpha: wrapped(root.a),
    };
    let Checked { pose, residual } = checked(machine, pose, rho);
    let q = g.R2 * root.s;
    let drops = [w1, pose.z - q - rho[1], pose.z + q - rho[2]];
    let legs = drops.map(Side::of);
    let working = u > 0.0 && w1 > v.abs() && drops[1] > 0.0 && drops[2] > 0.0;
    let mode = Mode { legs, crossed: u < 0.0 };
    // A NaN is not a residual either.
    let holds = residual <= RESIDUAL_TOLERANCE * size(machine, pose.z);
    holds.then_some(Posture { pose, rho, mode, working, merged: root.merged, residual })
}

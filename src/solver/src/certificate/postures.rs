//! The proof of the inverse problem's solutions.

use arrayvec::ArrayVec;

use super::answer::{Certification, Incomplete, PostureBox, Scope, Unproved};
use super::circle_search;
use super::leg_one_equations::LegOneEquations;
use super::leg_one_root::LegOneRoot;
use super::locus::EnclosedLocus;
use super::orientation::EnclosedOrientation;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{MAX_POSTURES, Posture};

/// Proves what can be proved of the solutions of [`platform`](crate::platform) (all) or
/// [`platform_working`](crate::platform_working) (working) for P at `p`. If they returned
/// [`KinematicsError::Unreachable`](crate::KinematicsError::Unreachable), `postures` is empty.
///
/// # Units
///
/// Millimetres and radians; z points down.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (15). The derivation
/// is in [`certificate`](crate::certificate).
///
/// # Examples
///
/// ```
/// use verne_solver::certificate::{Scope, certify_platform};
/// use verne_solver::{KinematicsError, Machine, platform};
///
/// let (machine, p) = (Machine::verne(), [-240.0, -86.0, 1000.0]);
/// let proof = certify_platform(&machine, p, &platform(&machine, p)?, Scope::All);
/// assert!(proof.complete.is_ok() && proof.boxes.iter().all(Result::is_ok), "sixteen, as the paper's Fig. 5 shows");
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn certify_platform(machine: &Machine, p: Point, postures: &[Posture], scope: Scope) -> Certification {
    certify(machine, &EnclosedLocus::fixed(p), postures, scope)
}

/// The same for [`tool`](crate::tool) or [`tool_every_working`](crate::tool_every_working): the tool centre point is at
/// `u` in the base frame.
///
/// # Units
///
/// Millimetres and radians; z points down.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (27).
///
/// # Examples
///
/// ```
/// use verne_solver::certificate::{Scope, certify_tool};
/// use verne_solver::{KinematicsError, Machine, tool_every_working};
///
/// let (machine, u) = (Machine::verne(), [50.0, 120.0, 1300.0]);
/// let proof = certify_tool(&machine, u, 150.0, &tool_every_working(&machine, u, 150.0)?, Scope::Working);
/// assert_eq!(proof.complete, Ok(()));
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn certify_tool(
    machine: &Machine,
    u: Point,
    tool_length: f64,
    postures: &[Posture],
    scope: Scope,
) -> Certification {
    certify(machine, &EnclosedLocus::tool(u, tool_length), postures, scope)
}

/// The same for [`part`](crate::part) or [`part_every_working`](crate::part_every_working): the tool is at `point` in
/// the part frame with an orientation that is known within bounds. The proof holds for each orientation within them.
///
/// # Units
///
/// Millimetres and radians; Z of the part frame points up.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (9), (14), (26).
///
/// # Examples
///
/// ```
/// use verne_solver::certificate::{EnclosedOrientation, Scope, certify_part};
/// use verne_solver::{KinematicsError, Machine, PartPose, part};
///
/// let (machine, point) = (Machine::verne(), [100.0, 50.0, 300.0]);
/// let target = PartPose { x: point[0], y: point[1], z: point[2], phi1: 0.35, phi2: 0.5 };
/// let orientation = EnclosedOrientation::within([0.35; 2], [0.5; 2]).ok_or(KinematicsError::OutOfDomain)?;
/// let proof = certify_part(&machine, point, &orientation, 150.0, &part(&machine, &target, 150.0)?, Scope::All);
/// assert_eq!((proof.boxes.len(), proof.complete), (16, Ok(())));
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn certify_part(
    machine: &Machine,
    point: Point,
    orientation: &EnclosedOrientation,
    tool_length: f64,
    postures: &[Posture],
    scope: Scope,
) -> Certification {
    certify(machine, &EnclosedLocus::part(machine, point, orientation, tool_length), postures, scope)
}

fn certify(machine: &Machine, locus: &EnclosedLocus, postures: &[Posture], scope: Scope) -> Certification {
    let mechanism = &machine.mechanism;
    let equations = LegOneEquations::new(mechanism, locus, scope);
    let mut roots = ArrayVec::<LegOneRoot, MAX_POSTURES>::new();
    let mut boxes = ArrayVec::new();
    for posture in postures.iter().take(MAX_POSTURES) {
        let known = roots.iter().position(|root| root.is_of(posture));
        let index = known.or_else(|| {
            roots.push(LegOneRoot::prove(mechanism, locus, &equations, posture)?);
            Some(roots.len() - 1)
        });
        let found: Option<PostureBox> = index.and_then(|index| roots[index].posture_box(locus.x, posture));
        boxes.push(found.ok_or(if posture.merged { Unproved::Merged } else { Unproved::NearSingularity }));
    }
    let complete = if boxes.iter().any(Result::is_err) {
        Err(Incomplete::Unproved)
    } else {
        is_complete(&equations, &roots, scope)
    };
    Certification { boxes, complete }
}

/// Whether the postures of these roots are all that there are.
fn is_complete(
    equations: &LegOneEquations<'_>,
    roots: &[LegOneRoot],
    scope: Scope,
) -> Result<(), Incomplete> {
    let known: ArrayVec<_, MAX_POSTURES> = roots.iter().map(LegOneRoot::bounds).collect();
    if !circle_search::knows_all(equations, &known) {
        return Err(Incomplete::Undecided);
    }
    match scope {
        Scope::All if roots.iter().all(LegOneRoot::has_all_postures) => Ok(()),
        Scope::All => Err(Incomplete::Undecided),
        Scope::Working if roots.iter().all(|root| root.is_in_working_mode(equations)) => Ok(()),
        Scope::Working => Err(Incomplete::UndecidedMode),
    }
}

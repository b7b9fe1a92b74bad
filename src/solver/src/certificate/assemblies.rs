//! The proof of the forward problem's solutions.

use arrayvec::ArrayVec;

use super::angle::directions;
use super::answer::{ALPHA_MARGIN, Certification, Incomplete, PostureBox, Scope, Unproved};
use super::assembly_equations::AssemblyEquations;
use super::chart_equations::ChartEquations;
use super::circle_search;
use super::enclosure::Enclosure;
use super::krawczyk::{ProvedZero, prove};
use super::rod_equations::RodEquations;
use crate::error::KinematicsError;
use crate::forward::forward;
use crate::machine::Machine;
use crate::parallel_matrix::determinant;
use crate::posture::{MAX_POSTURES, Posture};

type Zeros = ArrayVec<ProvedZero<4>, MAX_POSTURES>;

/// Proves what can be proved of the solutions of [`forward`] (all) or
/// [`forward_working`](crate::forward_working) (working) for slider positions `rho`. If they returned
/// [`KinematicsError::Unreachable`], `postures` is empty.
///
/// # Units
///
/// Millimetres and radians; z points down.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6). The derivation is in
/// [`certificate`](crate::certificate).
///
/// # Examples
///
/// ```
/// use verne_solver::certificate::{Scope, certify_forward};
/// use verne_solver::{KinematicsError, Machine, forward};
///
/// let (machine, rho) = (Machine::verne(), [674.0, 685.0, 250.0]);
/// let postures = forward(&machine, rho)?;
/// let proof = certify_forward(&machine, rho, &postures, Scope::All);
/// assert_eq!(proof.complete, Ok(()), "these four assembly modes and no others");
/// for (posture, found) in postures.iter().zip(&proof.boxes) {
///     let [low, high] = found.map_err(|_| KinematicsError::SelfMotion)?.z;
///     assert!(low <= posture.pose.z && posture.pose.z <= high && high - low < 1e-9);
/// }
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn certify_forward(
    machine: &Machine,
    rho: [f64; 3],
    postures: &[Posture],
    scope: Scope,
) -> Certification {
    let assembly = Assembly { machine, rho, rods: RodEquations::new(&machine.mechanism, rho) };
    let proved: ArrayVec<Result<(ProvedZero<4>, PostureBox), Unproved>, MAX_POSTURES> =
        postures.iter().map(|posture| assembly.proved(posture)).collect();
    let zeros: Result<Zeros, Unproved> = proved.iter().map(|found| found.map(|(zero, _)| zero)).collect();
    let complete = match (zeros, scope) {
        (Err(_), _) => Err(Incomplete::Unproved),
        (Ok(zeros), Scope::All) => assembly.is_complete(&zeros),
        (Ok(zeros), Scope::Working) => assembly.is_complete_in_working_mode(&zeros, postures),
    };
    Certification { boxes: proved.into_iter().map(|found| found.map(|(_, found)| found)).collect(), complete }
}

/// The forward problem of a request.
struct Assembly<'a> {
    machine: &'a Machine,
    rho: [f64; 3],
    rods: RodEquations<'a>,
}

impl Assembly<'_> {
    /// The zero of Eqs (3)-(6) at a posture, and its box.
    fn proved(&self, posture: &Posture) -> Result<(ProvedZero<4>, PostureBox), Unproved> {
        let pose = &posture.pose;
        let rho1 = Enclosure::of(self.rho[0]);
        let found = prove(&self.rods, [pose.x, pose.y, pose.z - self.rho[0], pose.alpha]).and_then(|zero| {
            let [x, y, w, alpha] = zero.bounds;
            let with = |bounds: Enclosure, number: f64| bounds.hull(Enclosure::of(number));
            let (x, y) = (with(x, pose.x), with(y, pose.y));
            let (z, alpha) = (with(rho1 + w, pose.z), with(alpha, pose.alpha));
            let alone = zero.is_alone_in(0, x)
                && zero.is_alone_in(1, y)
                && zero.is_alone_in(2, z - rho1)
                && zero.is_alone_in(3, alpha.widened(ALPHA_MARGIN));
            let rho = self.rho.map(|rho| [rho, rho]);
            alone.then(|| {
                (zero, PostureBox { x: x.into(), y: y.into(), z: z.into(), alpha: alpha.into(), rho })
            })
        });
        found.ok_or(if posture.merged { Unproved::Merged } else { Unproved::NearSingularity })
    }

    /// Whether Eqs (3)-(6) have no other zeros.
    fn is_complete(&self, zeros: &[ProvedZero<4>]) -> Result<(), Incomplete> {
        if self.knows_all(zeros, Scope::All) { Ok(()) } else { Err(Incomplete::Undecided) }
    }

    fn knows_all(&self, zeros: &[ProvedZero<4>], scope: Scope) -> bool {
        let mechanism = &self.machine.mechanism;
        if mechanism.at_family_edge {
            let chart = ChartEquations::new(mechanism, self.rho, scope);
            let known: Option<ArrayVec<_, MAX_POSTURES>> =
                zeros.iter().map(|zero| chart.coordinates(zero.bounds)).collect();
            return known.is_some_and(|known| chart.knows_all(&known));
        }
        let Some(equations) = AssemblyEquations::new(mechanism, self.rho, scope) else { return false };
        let known: Option<ArrayVec<_, MAX_POSTURES>> =
            zeros.iter().map(|zero| equations.coordinates(zero.bounds)).collect();
        known.is_some_and(|known| circle_search::knows_all(&equations, &known))
    }

    /// Whether all postures in the working mode are known, and those that are known are in it.
    fn is_complete_in_working_mode(
        &self,
        zeros: &[ProvedZero<4>],
        postures: &[Posture],
    ) -> Result<(), Incomplete> {
        // Equal offsets have mirror images: both satisfy the conditions on rods.
        if !self.machine.mechanism.offsets_nearly_equal && self.knows_all(zeros, Scope::Working) {
            let in_mode = zeros.iter().all(|zero| self.rods.hang_uncrossed(zero.bounds) == Some(true));
            return if in_mode { Ok(()) } else { Err(Incomplete::UndecidedMode) };
        }
        self.is_complete_among_all(postures)
    }

    /// The same by the proof of all assemblies.
    #[cold]
    fn is_complete_among_all(&self, working: &[Posture]) -> Result<(), Incomplete> {
        let all = match forward(self.machine, self.rho) {
            Ok(all) => all,
            Err(KinematicsError::Unreachable(_)) => ArrayVec::new(),
            Err(_) => return Err(Incomplete::Undecided),
        };
        let proved: Result<Zeros, Unproved> = all.iter().map(|posture| Ok(self.proved(posture)?.0)).collect();
        let zeros = proved.map_err(|_| Incomplete::Unproved)?;
        self.is_complete(&zeros)?;
        let is_working = |posture: &Posture| working.iter().any(|known| known.pose == posture.pose);
        let plausible: ArrayVec<_, MAX_POSTURES> = all
            .iter()
            .zip(&zeros)
            .map(|(posture, zero)| (is_working(posture), self.rods.hang_uncrossed(zero.bounds), zero.bounds))
            .filter(|(_, hang, _)| *hang != Some(false))
            .collect();
        let alone = plausible.iter().all(|(working, hang, _)| *working && *hang == Some(true));
        // Of several, those on home's side are meant. A single one is in the working mode on any side.
        let on_other_sides = !working.is_empty()
            && plausible.iter().all(|(working, hang, bounds)| {
                self.is_on_home_side(*bounds) == Some(*working) && (!working || *hang == Some(true))
            });
        let found = plausible.iter().filter(|(working, ..)| *working).count() == working.len();
        if found && (alone || on_other_sides) { Ok(()) } else { Err(Incomplete::UndecidedMode) }
    }

    /// Whether a zero is on home's side of the parallel singularity, and with nearly equal offsets of X1 = 0. `None` if
    /// that is not decided.
    fn is_on_home_side(&self, bounds: [Enclosure; 4]) -> Option<bool> {
        let mechanism = &self.machine.mechanism;
        let [x, y, w, alpha] = bounds;
        let turn = directions(alpha);
        let det =
            determinant(&self.rods.rows(&self.rods.rods([x, y, w], turn), turn)).times(self.machine.home.det);
        let side = self.rods.mirror_side(x).times(mechanism.e1 + mechanism.e2);
        let mirrored = mechanism.offsets_nearly_equal && side.high < 0.0;
        if mirrored || det.high < 0.0 {
            Some(false)
        } else if det.low > 0.0 && (!mechanism.offsets_nearly_equal || side.low > 0.0) {
            Some(true)
        } else {
            None
        }
    }
}

//! The answer of `/fk` and `/ik` from the solver's postures: order, labels and margins of the solutions, or the reason
//! why there is none.

use std::cmp::Ordering;

use verne_solver::certificate::{Certification, PostureBox, Unproved};
use verne_solver::{
    Clearance, Constraint, Element, KinematicsError, Machine, Margin, Margins, PartPose, Posture,
    TableAngles, jacobian, part_pose, tool_point,
};

use crate::operations::jacobians::jacobian_object;
use crate::operations::machine_registry::IdentifiedMachine;
use crate::operations::nearest::squared_distance;
use crate::operations::table_angles::TablePosition;
use crate::wire::answer::{Answer, Free, ModeObject, PartObject, PlatformObject, Reason, Solution};
use crate::wire::certificate::{CertificateObject, IncompleteReason};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::too_far;
use crate::wire::fixed_array::FixedArray;
use crate::wire::jacobian::JacobianObject;
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::margins::MarginsObject;
use crate::wire::request::{Joints, Near, SolutionFilter};
use crate::wire::windings::Windings;

/// A posture with the table's angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolvedPosture {
    pub(crate) posture: Posture,
    /// The table's angles, if the request determines them.
    pub(crate) table: Option<TablePosition>,
    /// `[phi1, phi2]`, rad, as in the request.
    pub(crate) requested: Option<[f64; 2]>,
    /// How many windings of theta2 are within its range, if the request has an orientation.
    pub(crate) windings: Option<Windings>,
    /// What is proved, if the request asks for it.
    pub(crate) proof: Option<Result<PostureBox, Unproved>>,
}

/// The solver's postures for all orientations of a request.
#[derive(Debug, Default)]
pub(crate) struct SolutionSet {
    pub(crate) postures: Vec<SolvedPosture>,
    /// The first refusal.
    pub(crate) refusal: Option<KinematicsError>,
    /// Whether there are no others, if the request asks for a proof.
    completeness: Option<Result<(), IncompleteReason>>,
}

impl SolutionSet {
    /// Adds the postures of one call of the solver, with their proofs if `certify` is given.
    pub(crate) fn add<P: AsRef<[Posture]>>(
        &mut self,
        outcome: Result<P, KinematicsError>,
        certify: Option<impl FnOnce(&[Posture]) -> Certification>,
        complete: impl Fn(Posture) -> SolvedPosture,
    ) {
        let postures = outcome.as_ref().map_or(&[][..], AsRef::as_ref);
        self.postures.extend(postures.iter().copied().map(complete));
        if let Some(certify) = certify {
            let proved = match &outcome {
                Ok(_) | Err(KinematicsError::Unreachable(_)) => {
                    let Certification { boxes, complete } = certify(postures);
                    let first = self.postures.len() - postures.len();
                    for (solved, found) in self.postures[first..].iter_mut().zip(boxes) {
                        solved.proof = Some(found);
                    }
                    complete.map_err(Into::into)
                }
                // Other refusals are errors of the request.
                Err(_) => Err(IncompleteReason::SelfMotion),
            };
            self.completeness = Some(self.completeness.unwrap_or(Ok(())).and(proved));
        }
        self.refusal = self.refusal.or(outcome.err());
    }
}

/// The parts of a request that decide which solutions are answered, and in which order.
#[derive(Debug)]
pub(crate) struct AnswerBuilder<'a> {
    pub(crate) machine: &'a IdentifiedMachine,
    pub(crate) tool_length: f64,
    /// The table clearance to check; only if the solutions have table angles.
    pub(crate) clearance: Option<Clearance>,
    pub(crate) filter: SolutionFilter,
    pub(crate) near: Option<Near>,
    /// Whether phi2 is free.
    pub(crate) free: bool,
    /// Whether the solutions have joints, as in answers of /ik.
    pub(crate) joints: bool,
    /// The characteristic length of the request, if the solutions have their Jacobians.
    pub(crate) jacobian: Option<f64>,
}

impl AnswerBuilder<'_> {
    /// The answer.
    pub(crate) fn answer(&self, mut set: SolutionSet) -> Result<Answer, OperationError> {
        set.postures.sort_by(order);
        let mut answered = Vec::with_capacity(set.postures.len());
        let mut violated = None;
        for (i, solved) in set.postures.iter().enumerate() {
            let table = solved.table.map(|table| table.angles);
            let margins = Margins::above_table(self.machine, &solved.posture, table, self.clearance.as_ref());
            if self.filter == SolutionFilter::Feasible && !margins.feasible() {
                violated.get_or_insert_with(|| margins.worst(self.machine));
            } else {
                let equal_before = set.postures[..i].iter().filter(|other| same_label(solved, other));
                answered.push((solved, self.solution(solved, equal_before.count(), &margins)));
            }
        }
        if let Some(near) = &self.near {
            let radius = self.machine.data().geometry.R1;
            let distance = |solved: &SolvedPosture| {
                squared_distance(near, radius, &solved.posture, solved.table.map(|table| table.angles))
            };
            answered.sort_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
        }
        let (reason, constraint) =
            if answered.is_empty() { self.reason(violated, set.refusal)? } else { (None, None) };
        let solutions = answered.into_iter().map(|(_, solution)| solution).collect();
        let free = if self.free { vec![Free::Phi2] } else { Vec::new() };
        let not_checked = Unchecked::beside(self.clearance.is_some());
        let machine = self.machine.id.clone();
        let of_family = if self.free { Err(IncompleteReason::FreePhi2) } else { Ok(()) };
        let completeness = set.completeness.map(|complete| complete.and(of_family).into());
        Ok(Answer { machine, solutions, completeness, not_checked, free, reason, constraint })
    }

    fn solution(&self, solved: &SolvedPosture, index: usize, margins: &Margins) -> Solution {
        let posture = &solved.posture;
        let platform = PlatformObject::from(posture.pose);
        let certificate =
            solved.proof.as_ref().map(|proof| CertificateObject::new(proof, platform.alpha, self.joints));
        Solution {
            joints: self.joints.then(|| Joints {
                rho: FixedArray(posture.rho),
                theta1: solved.table.map(|table| table.degrees[0]),
                theta2: solved.table.map(|table| table.degrees[1]),
            }),
            platform,
            tool: tool_point(&posture.pose, self.tool_length).into(),
            part: solved.table.map(|table| self.part(solved, table.angles)),
            windings: solved.windings,
            mode: ModeObject::new(posture, index),
            working: posture.working,
            merged: posture.merged,
            feasible: margins.feasible(),
            margins: MarginsObject::new(self.machine, margins),
            conditioning: jacobian::conditioning(self.machine, posture).into(),
            jacobian: self.jacobian(solved),
            residual: posture.residual,
            certificate,
        }
    }

    fn jacobian(&self, solved: &SolvedPosture) -> Option<JacobianObject> {
        let (table, length) = (solved.table?.angles, self.jacobian?);
        Some(jacobian_object(self.machine, (&solved.posture, table), self.tool_length, length))
    }

    fn part(&self, solved: &SolvedPosture, table: TableAngles) -> PartObject {
        let pose = part_pose(self.machine, &solved.posture.pose, table, self.tool_length);
        match solved.requested {
            // The angles from the table may differ from the requested ones by whole turns.
            Some([phi1, phi2]) => PartPose { phi1, phi2, ..pose }.into(),
            None => pose.into(),
        }
    }

    /// Why there is no solution, and the constraint that prevents it.
    fn reason(
        &self,
        violated: Option<Margin>,
        refusal: Option<KinematicsError>,
    ) -> Result<(Option<Reason>, Option<Limit>), OperationError> {
        let (reason, margin) = match (violated, refusal) {
            (Some(margin), _) => (Reason::Infeasible, margin),
            (None, Some(KinematicsError::Unreachable(margin))) => (Reason::Unreachable, margin),
            (None, Some(KinematicsError::SelfMotion)) => {
                (Reason::SelfMotion, self_motion_margin(self.machine))
            }
            (None, Some(KinematicsError::OutOfDomain)) => {
                return Err(OperationError::Fields(vec![FieldError::new(
                    "",
                    "the numbers together are too large",
                )]));
            }
            (None, Some(KinematicsError::OutOfProportion)) => {
                let detail = format!("pose, tool and table together {}", too_far(self.machine));
                return Err(OperationError::Fields(vec![FieldError::new("", detail)]));
            }
            (None, None) => return Err(OperationError::Internal),
        };
        Ok((Some(reason), Some(margin.into())))
    }
}

/// The margin of a platform that can move while all sliders are locked: its conditioning is zero.
pub(crate) fn self_motion_margin(machine: &Machine) -> Margin {
    let value = -machine.data().limits.parallel_margin;
    Margin { constraint: Constraint::ParallelSingularity, element: Element::Platform, value }
}

/// Working postures first, then by alpha, then by rho. The index of a label counts in this order, so a working solution
/// has the same index whichever solutions are requested.
fn order(a: &SolvedPosture, b: &SolvedPosture) -> Ordering {
    let (a, b) = (&a.posture, &b.posture);
    let by_rho = || a.rho.iter().zip(&b.rho).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
    b.working
        .cmp(&a.working)
        .then(a.pose.alpha.total_cmp(&b.pose.alpha))
        .then_with(|| by_rho().unwrap_or(Ordering::Equal))
}

fn same_label(a: &SolvedPosture, b: &SolvedPosture) -> bool {
    a.posture.mode == b.posture.mode
}

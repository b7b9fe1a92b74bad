//! From postures to the answer: order, labels, margins, or why there is nothing.

use std::cmp::Ordering;

use verne_solver::{
    Clearance, Constraint, Element, KinematicsError, Machine, Margin, Margins, PartPose, Posture, Postures,
    TableAngles, jacobian, part_pose, tool_point,
};

use crate::operations::nearest;
use crate::operations::registry::Published;
use crate::operations::table_angles::Stand;
use crate::wire::answer::{Answer, Free, ModeObject, PartObject, Reason, Solution};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::too_far;
use crate::wire::fixed_array::Exactly;
use crate::wire::limit::{Limit, Unchecked};
use crate::wire::margins::MarginsObject;
use crate::wire::request::{Joints, Near, Wanted};

/// A posture with the table's part in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) posture: Posture,
    /// Where the table takes part.
    pub(crate) table: Option<Stand>,
    /// `[phi1, phi2]` as the question put them.
    pub(crate) asked: Option<[f64; 2]>,
}

/// What the solver found, over all orientations of a question.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    pub(crate) found: Vec<Found>,
    /// The first refusal.
    pub(crate) refusal: Option<KinematicsError>,
}

impl Findings {
    /// Adds all that one question to the solver found.
    pub(crate) fn add(
        &mut self,
        outcome: Result<Postures, KinematicsError>,
        complete: impl Fn(Posture) -> Found,
    ) {
        match outcome {
            Ok(postures) => self.found.extend(postures.into_iter().map(complete)),
            Err(refusal) => self.refuse(refusal),
        }
    }

    /// Adds the one posture that was wanted.
    pub(crate) fn add_one(
        &mut self,
        outcome: Result<Posture, KinematicsError>,
        complete: impl Fn(Posture) -> Found,
    ) {
        match outcome {
            Ok(posture) => self.found.push(complete(posture)),
            Err(refusal) => self.refuse(refusal),
        }
    }

    fn refuse(&mut self, refusal: KinematicsError) {
        self.refusal.get_or_insert(refusal);
    }
}

/// What is needed to put findings into an answer.
#[derive(Debug)]
pub(crate) struct Presentation<'a> {
    pub(crate) published: &'a Published,
    pub(crate) tool_length: f64,
    /// The clearance over the table that is checked: only where the findings have the table in them.
    pub(crate) clearance: Option<Clearance>,
    pub(crate) wanted: Wanted,
    pub(crate) near: Option<Near>,
    pub(crate) free: bool,
    /// Whether solutions carry their joints: /ik's do.
    pub(crate) joints: bool,
}

impl Presentation<'_> {
    /// The answer.
    pub(crate) fn answer(&self, mut findings: Findings) -> Result<Answer, OperationError> {
        findings.found.sort_by(order);
        let mut kept = Vec::with_capacity(findings.found.len());
        let mut violated = None;
        for (i, found) in findings.found.iter().enumerate() {
            let table = found.table.map(|table| table.angles);
            let margins =
                Margins::above_table(self.machine(), &found.posture, table, self.clearance.as_ref());
            if self.wanted == Wanted::Feasible && !margins.feasible() {
                violated.get_or_insert_with(|| margins.worst(self.machine()));
            } else {
                let equal_before = findings.found[..i].iter().filter(|other| same_label(found, other));
                kept.push((found, self.solution(found, equal_before.count(), &margins)));
            }
        }
        if let Some(near) = &self.near {
            let radius = self.machine().data().geometry.R1;
            let distance = |found| nearest::distance(near, radius, found);
            kept.sort_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
        }
        let (reason, constraint) =
            if kept.is_empty() { self.why_nothing(violated, findings.refusal)? } else { (None, None) };
        let solutions = kept.into_iter().map(|(_, solution)| solution).collect();
        let free = if self.free { vec![Free::Phi2] } else { Vec::new() };
        let not_checked = Unchecked::beside(self.clearance.is_some());
        let machine = self.published.id.clone();
        Ok(Answer { machine, solutions, not_checked, free, reason, constraint })
    }

    fn machine(&self) -> &Machine {
        &self.published.machine
    }

    fn solution(&self, found: &Found, index: usize, margins: &Margins) -> Solution {
        let posture = &found.posture;
        Solution {
            joints: self.joints.then(|| Joints {
                rho: Exactly(posture.rho),
                theta1: found.table.map(|table| table.degrees[0]),
                theta2: found.table.map(|table| table.degrees[1]),
            }),
            platform: posture.pose.into(),
            tool: tool_point(&posture.pose, self.tool_length).into(),
            part: found.table.map(|table| self.part(found, table.angles)),
            mode: ModeObject::new(posture, index),
            working: posture.working,
            merged: posture.merged,
            feasible: margins.feasible(),
            margins: MarginsObject::new(self.machine(), margins),
            conditioning: jacobian::conditioning(self.machine(), posture).into(),
            residual: posture.residual,
        }
    }

    fn part(&self, found: &Found, table: TableAngles) -> PartObject {
        let pose = part_pose(self.machine(), &found.posture.pose, table, self.tool_length);
        match found.asked {
            // The table may stand whole revolutions away; the caller knows the angles asked for.
            Some([phi1, phi2]) => PartPose { phi1, phi2, ..pose }.into(),
            None => pose.into(),
        }
    }

    fn why_nothing(
        &self,
        violated: Option<Margin>,
        refusal: Option<KinematicsError>,
    ) -> Result<(Option<Reason>, Option<Limit>), OperationError> {
        let (reason, margin) = match (violated, refusal) {
            (Some(margin), _) => (Reason::Infeasible, margin),
            (None, Some(KinematicsError::Unreachable(margin))) => (Reason::Unreachable, margin),
            (None, Some(KinematicsError::SelfMotion)) => (Reason::SelfMotion, unheld(self.machine())),
            (None, Some(KinematicsError::OutOfDomain)) => {
                return Err(OperationError::Fields(vec![FieldError::new(
                    "",
                    "the numbers together are too large",
                )]));
            }
            (None, Some(KinematicsError::OutOfProportion)) => {
                let detail = format!("pose, tool and table together {}", too_far(self.machine()));
                return Err(OperationError::Fields(vec![FieldError::new("", detail)]));
            }
            (None, None) => return Err(OperationError::Internal),
        };
        Ok((Some(reason), Some(margin.into())))
    }
}

/// The margin of a platform that the sliders do not hold: its conditioning is zero.
pub(crate) fn unheld(machine: &Machine) -> Margin {
    let value = -machine.data().limits.parallel_margin;
    Margin { constraint: Constraint::ParallelSingularity, element: Element::Platform, value }
}

/// Working first, then by alpha, then by rho. Indices count in this order, so the working
/// solution's is the same whichever solutions are asked for.
fn order(a: &Found, b: &Found) -> Ordering {
    let (a, b) = (&a.posture, &b.posture);
    let by_rho = || a.rho.iter().zip(&b.rho).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
    b.working
        .cmp(&a.working)
        .then(a.pose.alpha.total_cmp(&b.pose.alpha))
        .then_with(|| by_rho().unwrap_or(Ordering::Equal))
}

fn same_label(a: &Found, b: &Found) -> bool {
    a.posture.mode == b.posture.mode
}

//! What is found out about a program.

use super::joint_segment::Deviation;
use super::node::Node;
use crate::fast_math::{greater, lesser};
use crate::limit::{Constraint, Margin};
use crate::machine::Machine;
use crate::margins::lesser_margins::{ClosedPosture, Known, Reference, worst_and_lesser};
use crate::pose::{PartPose, TableAngles};

/// Greatest number of failures that a report lists.
pub const MOST_FAILURES: usize = 1_000;
/// Greatest number of rapids with straight joints that a report lists.
pub const MOST_DEPARTURES: usize = 1_000;

/// Consecutive motions that the machine cannot make for the same reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// Indices of the first and the last motion.
    pub motions: [usize; 2],
    /// The worst margin among them; negative.
    pub margin: Margin,
    /// The margin as a fraction of its constraint's range.
    pub fraction: f64,
    /// Index of the motion with this margin.
    pub motion: usize,
    /// The pose with this margin: the inverse problem for it, with the motion's tool, reproduces the failure but for
    /// the winding of theta2.
    pub pose: PartPose,
    /// The joints there: sliders, mm, and table. `None`: the pose has none in the working mode.
    pub joints: Option<([f64; 3], TableAngles)>,
}

/// The least margin of a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastMargin {
    /// The margin.
    pub margin: Margin,
    /// Index of the motion where it is.
    pub motion: usize,
}

/// The least margin of each constraint so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastMargins {
    known: Known,
    reference: Option<Reference>,
    found: [Option<LeastMargin>; Constraint::COUNT],
}

impl LeastMargins {
    pub(super) fn new() -> Self {
        Self { known: [f64::INFINITY; Constraint::COUNT], reference: None, found: [None; Constraint::COUNT] }
    }

    /// Notes the margins of a place of a motion. The answer is the worst of them, and its fraction of its constraint's
    /// range.
    pub(super) fn meet(
        &mut self,
        machine: &Machine,
        motion: usize,
        posture: &ClosedPosture<'_>,
    ) -> (Margin, f64) {
        let known = (&mut self.known, &mut self.reference);
        worst_and_lesser(machine, posture, known, |margin| {
            self.found[margin.constraint as usize] = Some(LeastMargin { margin, motion });
        })
    }

    pub(super) fn found(&self) -> Vec<LeastMargin> {
        self.found.iter().copied().flatten().collect()
    }
}

/// A rapid whose joints move straight to its end, because preimage or winding change, or on request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Index of the motion.
    pub motion: usize,
    /// Greatest distance of the tool's end from the straight line, mm; `None` if the forward problem has no solution
    /// along the motion.
    pub distance: Option<f64>,
    /// Unit vector from the line to the tool's end there, in the part frame.
    pub direction: [f64; 3],
}

/// The report on a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Stretches that the machine cannot move along, in order; at most [`MOST_FAILURES`].
    pub failures: Vec<Failure>,
    /// Number of all such stretches.
    pub failure_count: u64,
    /// Number of rows.
    pub rows: u64,
    /// Length of the feed paths and of the rapid paths, mm.
    pub length: [f64; 2],
    /// The least margin of each constraint.
    pub least: Vec<LeastMargin>,
    /// Least and greatest value of rho1-3 (mm), theta1 and theta2 (rad); `None` without rows.
    pub ranges: Option<[[f64; 2]; 5]>,
    /// Angles through which theta1 and theta2 turn, rad.
    pub turning: [f64; 2],
    /// Smallest |phi1|, rad; `None` without rows.
    pub least_inclination: Option<f64>,
    /// Greatest deviation of feed motions.
    pub deviation: Deviation,
    /// Number of changes of the preimage.
    pub preimage_changes: u64,
    /// Number of times that the tool leaves the part within a cut, so that the rotary axis turns by whole turns.
    pub retracts: u64,
    /// Rapids with straight joints; at most [`MOST_DEPARTURES`].
    pub departures: Vec<Departure>,
    /// Number of all such rapids.
    pub departure_count: u64,
}

impl Report {
    pub(super) fn new() -> Self {
        Self {
            failures: Vec::new(),
            failure_count: 0,
            rows: 0,
            length: [0.0; 2],
            least: Vec::new(),
            ranges: None,
            turning: [0.0; 2],
            least_inclination: None,
            deviation: Deviation::default(),
            preimage_changes: 0,
            retracts: 0,
            departures: Vec::new(),
            departure_count: 0,
        }
    }

    /// Whether the machine can run the program.
    pub fn is_feasible(&self) -> bool {
        self.failure_count == 0
    }

    /// The margin of the program that is the least as a fraction of its constraint's range, on its rows and between
    /// them. A place that the machine does not reach counts with the margin of the constraint that prevents it. `None`:
    /// the plan has no place.
    ///
    /// # Units
    ///
    /// mm, rad, or none, by the constraint.
    pub fn worst(&self, machine: &Machine) -> Option<LeastMargin> {
        let failing =
            self.failures.iter().map(|&Failure { margin, motion, .. }| LeastMargin { margin, motion });
        let all = self.least.iter().copied().chain(failing);
        let fraction = |least: &LeastMargin| least.margin.fraction(machine);
        all.min_by(|a, b| fraction(a).total_cmp(&fraction(b)))
    }

    /// Notes a place outside a limit, with its margin as a fraction of the constraint's range.
    pub(super) fn fail(
        &mut self,
        motion: usize,
        (pose, node): (PartPose, Option<&Node>),
        (margin, fraction): (Margin, f64),
    ) {
        let joints = node.map(|node| (node.rho, node.table));
        if let Some(last) = self.failures.last_mut()
            && last.margin.constraint == margin.constraint
            && motion <= last.motions[1] + 1
        {
            last.motions[1] = motion;
            if fraction < last.fraction {
                (last.margin, last.fraction) = (margin, fraction);
                (last.motion, last.pose, last.joints) = (motion, pose, joints);
            }
            return;
        }
        self.failure_count += 1;
        if self.failures.len() < MOST_FAILURES {
            self.failures.push(Failure { motions: [motion; 2], margin, fraction, motion, pose, joints });
        }
    }

    /// Notes a row's joints.
    pub(super) fn add_row(&mut self, node: &Node, before: Option<&Node>) {
        self.rows += 1;
        let joints = [node.rho[0], node.rho[1], node.rho[2], node.table.theta1, node.table.theta2];
        let ranges = self.ranges.get_or_insert(joints.map(|joint| [joint; 2]));
        for (range, joint) in ranges.iter_mut().zip(joints) {
            *range = [lesser(range[0], joint), greater(range[1], joint)];
        }
        if let Some(before) = before {
            self.turning[0] += (node.table.theta1 - before.table.theta1).abs();
            self.turning[1] += (node.table.theta2 - before.table.theta2).abs();
        }
        // phi1 = alpha - theta1.
        let inclination = (node.pose.alpha - node.table.theta1).abs();
        let least = self.least_inclination.get_or_insert(inclination);
        *least = lesser(*least, inclination);
    }
}

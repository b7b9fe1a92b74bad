//! What is found out about a program.

use super::joint_segment::Deviation;
use super::node::Node;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::margins::worst::{FAMILY_ROD, least};
use crate::pose::PartPose;
use crate::table::part_pose;

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
    /// The pose with this margin: the inverse problem for it, with the motion's tool, reproduces the failure.
    pub pose: PartPose,
}

/// The least margin of a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastMargin {
    /// The margin.
    pub margin: Margin,
    /// Index of the motion where it is.
    pub motion: usize,
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
            departures: Vec::new(),
            departure_count: 0,
        }
    }

    /// Whether the machine can run the program.
    pub fn is_feasible(&self) -> bool {
        self.failure_count == 0
    }

    /// Notes a place outside a limit.
    pub(super) fn fail(&mut self, motion: usize, pose: PartPose, margin: Margin, fraction: f64) {
        if let Some(last) = self.failures.last_mut()
            && last.margin.constraint == margin.constraint
            && motion <= last.motions[1] + 1
        {
            last.motions[1] = motion;
            if fraction < last.fraction {
                (last.margin, last.fraction) = (margin, fraction);
                (last.motion, last.pose) = (motion, pose);
            }
            return;
        }
        self.failure_count += 1;
        if self.failures.len() < MOST_FAILURES {
            self.failures.push(Failure { motions: [motion; 2], margin, fraction, motion, pose });
        }
    }

    /// Notes the margins of a place, which is given by its joints and the tool's length; those of limits that are
    /// broken are failures.
    pub(super) fn meet(
        &mut self,
        machine: &Machine,
        motion: usize,
        place: (&Node, f64),
        margins: &Margins,
    ) -> (Margin, f64) {
        for margin in each(margins) {
            let same = self.least.iter_mut().find(|least| least.margin.constraint == margin.constraint);
            match same {
                Some(least) if margin.value < least.margin.value => *least = LeastMargin { margin, motion },
                Some(_) => {}
                None => self.least.push(LeastMargin { margin, motion }),
            }
        }
        let (margin, fraction) = margins.worst_with_fraction(machine);
        if margin.value < 0.0 {
            let (node, tool_length) = place;
            self.fail(motion, part_pose(machine, &node.pose, node.table, tool_length), margin, fraction);
        }
        (margin, fraction)
    }

    /// Notes a row's joints.
    pub(super) fn add_row(&mut self, node: &Node, before: Option<&Node>, inclination: f64) {
        self.rows += 1;
        let joints = [node.rho[0], node.rho[1], node.rho[2], node.table.theta1, node.table.theta2];
        let ranges = self.ranges.get_or_insert(joints.map(|joint| [joint; 2]));
        for (range, joint) in ranges.iter_mut().zip(joints) {
            *range = [range[0].min(joint), range[1].max(joint)];
        }
        if let Some(before) = before {
            self.turning[0] += (node.table.theta1 - before.table.theta1).abs();
            self.turning[1] += (node.table.theta2 - before.table.theta2).abs();
        }
        let least = self.least_inclination.get_or_insert(inclination.abs());
        *least = least.min(inclination.abs());
    }
}

/// The least margin of each constraint of one place.
fn each(margins: &Margins) -> impl Iterator<Item = Margin> {
    let of_rods = |constraint, values: &[f64; 4]| {
        let (i, value) = least(values);
        Margin { constraint, element: FAMILY_ROD[i], value }
    };
    let strokes: [f64; 6] = std::array::from_fn(|i| margins.stroke[i / 2][i % 2]);
    let (stroke, value) = least(&strokes);
    let slider = [1, 2, 3][stroke / 2];
    let stroke = Margin {
        constraint: Constraint::Stroke,
        element: Element::Stroke { slider, high: stroke % 2 == 1 },
        value,
    };
    let (leg, value) = least(&margins.leg_length);
    let leg = Margin { constraint: Constraint::LegLength, element: Element::Leg([1, 2, 3][leg]), value };
    let [a, b] = margins.nearest_rods;
    let single = |constraint, element, value| Margin { constraint, element, value };
    let range = |constraint, ends: Option<[f64; 2]>| {
        ends.map(|ends| {
            let (end, value) = least(&ends);
            Margin { constraint, element: Element::Range { high: end == 1 }, value }
        })
    };
    [
        Some(stroke),
        Some(leg),
        Some(of_rods(Constraint::SerialSingularity, &margins.serial_singularity)),
        Some(single(Constraint::ParallelSingularity, Element::Platform, margins.parallel_singularity)),
        Some(of_rods(Constraint::SliderJoint, &margins.slider_joint)),
        Some(of_rods(Constraint::PlatformJoint, &margins.platform_joint)),
        Some(single(Constraint::RodCrossing, Element::Leg(1), margins.rod_crossing)),
        Some(single(Constraint::RodInterference, Element::Rods(a, b), margins.rod_interference)),
        range(Constraint::Tilt, margins.tilt),
        range(Constraint::Rotary, margins.rotary),
        margins.table_clearance,
    ]
    .into_iter()
    .flatten()
}

//! The joints at one place of the path.

use std::f64::consts::PI;

use super::azimuth::inclination;
use super::meridian::Span;
use super::motion::ToolPosition;
use super::stretches::Stretch;
use crate::clearance::Clearance;
use crate::error::KinematicsError;
use crate::inverse::{part_every_working, part_working, part_working_near};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::margins::lesser_margins::ClosedPosture;
use crate::parallel_matrix::{determinant, matrix};
use crate::pose::{PartPose, PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::rods::Rods;
use crate::tool_motion::ToolMotion;
use crate::turns::{Turns, difference, direction};

/// The difference of alpha to the place before above which other working solutions are looked for, rad.
const NEAR: f64 = 0.05;

/// Greatest number of half turns to each side of the middle of a range of theta2.
const MOST_HALF_TURNS: i32 = 16;

/// What does not change along a program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting<'a> {
    pub(super) machine: &'a Machine,
    pub(super) stretches: &'a [Stretch],
    pub(super) table_clearance: Option<f64>,
    pub(super) tool_radius: f64,
}

/// Joints and platform pose at a place of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) pose: PlatformPose,
    pub(super) rho: [f64; 3],
    pub(super) table: TableAngles,
    pub(super) turns: Turns,
}

/// The rods at a place, and `det_P`.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosedRods {
    pub(super) rods: Rods,
    pub(super) det: f64,
}

impl ClosedRods {
    pub(super) fn of(machine: &Machine, rods: Rods) -> Self {
        Self { rods, det: determinant(&matrix(machine.geometry(), &rods)) }
    }
}

/// A pose of the tool in the part frame, with sine and cosine of phi1 and phi2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    pub(super) pose: PartPose,
    turns: [[f64; 2]; 2],
}

impl Setting<'_> {
    /// The pose of the tool at a place, for h half turns at the beginning and the end of a stretch.
    pub(super) fn target(&self, span: &Span, s: f64, at: &ToolPosition, h: [i32; 2]) -> Target {
        let (phi2, meridian) = span.meridian(self.stretches, s, at.axis, h);
        let (phi1, inclination) = inclination(at.axis, meridian);
        let [x, y, z] = at.tip;
        Target { pose: PartPose { x, y, z, phi1, phi2 }, turns: [inclination, meridian] }
    }

    /// The joints at a place in the working solution that continues `alpha`.
    pub(super) fn node(
        &self,
        target: &Target,
        tool_length: f64,
        alpha: Option<f64>,
    ) -> Result<Node, KinematicsError> {
        let posture = part_working(self.machine, &target.pose, tool_length)?;
        let distance = |posture: &Posture, alpha: f64| (posture.pose.alpha - alpha).abs();
        match alpha {
            Some(alpha) if distance(&posture, alpha) > NEAR => {
                let all = part_every_working(self.machine, &target.pose, tool_length)?;
                let nearest = all.iter().min_by(|a, b| distance(a, alpha).total_cmp(&distance(b, alpha)));
                Ok(Node::new_at(nearest.unwrap_or(&posture), target))
            }
            _ => Ok(Node::new_at(&posture, target)),
        }
    }

    /// The joints at a place in the working solution that continues that of another place.
    pub(super) fn node_near(
        &self,
        target: &Target,
        tool_length: f64,
        before: &Node,
    ) -> Result<Node, KinematicsError> {
        let alpha = before.pose.alpha;
        let start = (alpha, before.turns.platform, before.pose.z - before.rho[0]);
        match part_working_near(self.machine, &target.pose, target.turns, tool_length, start) {
            Some((posture, turn)) if (posture.pose.alpha - alpha).abs() <= NEAR => {
                Ok(Node::of(&posture, turn, target))
            }
            _ => self.node(target, tool_length, Some(alpha)),
        }
    }

    /// The joints of every working solution at a place.
    pub(super) fn nodes(&self, target: &Target, tool_length: f64) -> Result<Vec<Node>, KinematicsError> {
        let all = part_every_working(self.machine, &target.pose, tool_length)?;
        Ok(all.iter().map(|posture| Node::new_at(posture, target)).collect())
    }

    /// All margins of a place.
    pub(super) fn margins(&self, node: &Node, tool_length: f64) -> Margins {
        let clearance = self.clearance(tool_length);
        let rods = node.rods(self.machine);
        Margins::of_rods(self.machine, &node.pose, node.rho, &rods, node.table, clearance.as_ref())
    }

    /// The joints at a place, with what margins need of them.
    pub(super) fn closed<'n>(
        &self,
        node: &'n Node,
        closed: &'n ClosedRods,
        tool_length: f64,
    ) -> ClosedPosture<'n> {
        let (Node { pose, rho, table, .. }, ClosedRods { rods, det }) = (node, closed);
        let clearance = self.clearance(tool_length);
        let clearance = clearance.map(|clearance| clearance.margin(self.machine, pose, *table));
        let (theta1, theta2) = (table.theta1, Some(table.theta2));
        ClosedPosture { pose, rho: *rho, rods, det: *det, theta1, theta2, clearance }
    }

    fn clearance(&self, tool_length: f64) -> Option<Clearance> {
        Clearance::of(self.machine, self.table_clearance, tool_length, self.tool_radius)
    }
}

impl Node {
    pub(super) fn new(pose: PlatformPose, rho: [f64; 3], table: TableAngles) -> Self {
        Self { pose, rho, table, turns: Turns::of(pose.alpha, table) }
    }

    fn new_at(posture: &Posture, target: &Target) -> Self {
        Self::of(posture, direction(posture.pose.alpha), target)
    }

    /// `platform` is sine and cosine of alpha.
    fn of(posture: &Posture, platform: [f64; 2], target: &Target) -> Self {
        let PartPose { phi1, phi2, .. } = target.pose;
        let [inclination, [sine, cosine]] = target.turns;
        let table = TableAngles { theta1: posture.pose.alpha - phi1, theta2: -phi2 };
        let turns = Turns { platform, tilt: difference(platform, inclination), rotary: [-sine, cosine] };
        Self { pose: posture.pose, rho: posture.rho, table, turns }
    }

    /// The tool at this place.
    pub(super) fn tool(&self, machine: &Machine, tool_length: f64) -> ToolMotion {
        ToolMotion::at(machine, &self.pose, self.turns, tool_length)
    }

    pub(super) fn closed_rods(&self, machine: &Machine) -> ClosedRods {
        ClosedRods::of(machine, self.rods(machine))
    }

    pub(super) fn rods(&self, machine: &Machine) -> Rods {
        let [sine, cosine] = self.turns.platform;
        Rods::with_angle(&machine.mechanism, &self.pose, self.rho, (sine, cosine))
    }

    /// The same joints but for whole turns of the table.
    pub(super) fn wound_to(self, phi2: f64) -> Self {
        Self { table: TableAngles { theta2: -phi2, ..self.table }, ..self }
    }

    /// The same joints but for theta2, which turns by this many half turns.
    pub(super) fn wound_by(self, half_turns: i32) -> Self {
        let theta2 = self.table.theta2 + PI * f64::from(half_turns);
        Self { table: TableAngles { theta2, ..self.table }, ..self }
    }

    /// The same joints with platform and sliders higher in the base frame, mm.
    pub(super) fn lifted(self, height: f64) -> Self {
        let pose = PlatformPose { z: self.pose.z - height, ..self.pose };
        Self { pose, rho: self.rho.map(|rho| rho - height), ..self }
    }

    /// How far the platform and the sliders are from another node, as a fraction of the machine's longest dimension,
    /// with the angles that the platform and the table tilt through.
    pub(super) fn way_from(&self, other: &Self, longest: f64) -> f64 {
        let (a, b) = (&self.pose, &other.pose);
        let platform = (a.x - b.x).abs().max((a.y - b.y).abs()).max((a.z - b.z).abs());
        let length = (0..3).fold(platform, |way, i| way.max((self.rho[i] - other.rho[i]).abs()));
        length / longest + (a.alpha - b.alpha).abs() + (self.table.theta1 - other.table.theta1).abs()
    }

    /// The angle that the table's axes turn through from another node, weighted by `weights`.
    pub(super) fn turning_from(&self, other: &Self, weights: [f64; 2]) -> f64 {
        weights[0] * (self.table.theta1 - other.table.theta1).abs()
            + weights[1] * (self.table.theta2 - other.table.theta2).abs()
    }
}

/// h for which theta2 is within a range, or nearest to it: any, or odd or even ones only.
pub(super) fn half_turns(
    phi2: f64,
    is_odd: Option<bool>,
    [low, high]: [f64; 2],
) -> impl Iterator<Item = i32> {
    let (step, offset) = is_odd.map_or((1, 0), |is_odd| (2, i32::from(is_odd)));
    let [width, first_phi2] = [PI * f64::from(step), phi2 + PI * f64::from(offset)];
    let turns = |theta2: f64| (-theta2 - first_phi2) / width;
    let (first, last) = ((turns(high) - 1e-12).ceil(), (turns(low) + 1e-12).floor());
    let middle = turns(0.5 * (low + high)).round();
    let most = f64::from(MOST_HALF_TURNS);
    let [first, last] =
        if first <= last { [first.max(middle - most), last.min(middle + most)] } else { [middle, middle] };
    (whole(first)..=whole(last)).map(move |number| offset + step * number)
}

#[allow(clippy::cast_possible_truncation, reason = "clamped to the range of the type")]
fn whole(number: f64) -> i32 {
    number.clamp(-1e6, 1e6) as i32
}

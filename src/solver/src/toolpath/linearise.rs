//! The rows between two stops: so few that between any two of them the joints may change linearly.

use super::bound::{InverseBound, second_derivatives};
use super::joint_segment::{Deviation, JointSegment, Stop, Surroundings, Track};
use super::motion::ToolPosition;
use super::node::{ClosedRods, Node, Target};
use crate::error::KinematicsError;
use crate::machine::Machine;
use crate::rods::Rods;

/// The fraction of the tolerance that is used: the greatest deviation may lie between the places that are examined.
const USED: f64 = 0.97;
/// The fraction of the tolerance that a step aims at.
const AIM: f64 = 0.88;
/// Expected fraction of the tolerance above which the bound, which is several times as great, is not tried.
const BOUNDABLE: f64 = 0.1;
/// Greatest and least ratio of a step to the one before.
const RATIOS: [f64; 2] = [0.2, 2.5];
/// Part of a step by which the rest of a path may be longer than whole steps.
const ROUNDING: f64 = 1e-6;
/// Least step, as a fraction of a motion. At the edge of the smallest cap theta2 turns within a billionth of a motion.
const LEAST_STEP: f64 = 1e-13;

/// Why a path between two stops cannot be divided into rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LineariseError {
    /// A place between the stops has no solution.
    Refused(f64, KinematicsError),
    /// The joints jump at this parameter: however short a segment is, the tool leaves the path.
    Jump(f64),
}

/// What the segments before tell about the next one: the deviation grows with the square of a segment.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bend {
    /// Fraction of the tolerance over the square of the joints' way, in the last segment.
    known: Option<f64>,
    inverse: Option<InverseBound>,
}

/// Divides the path between two stops into segments, and calls `found` with the end of each.
pub(super) fn linearise(
    track: &Track<'_>,
    start: Stop,
    end: &Stop,
    tolerance: &Deviation,
    bend: &mut Bend,
    mut found: impl FnMut(&Stop, &ClosedRods, Option<&JointSegment<'_>>, Deviation),
) -> Result<(), LineariseError> {
    let machine = track.setting.machine;
    let way = square_way(machine, &start.node, &end.node);
    let expected = bend.known.map(|known| known * way);
    if expected.is_none_or(|expected| expected <= BOUNDABLE) {
        let rods = [&start, end].map(|stop| stop.node.rods(machine));
        if let Some(deviation) = bounded(track, [&start, end], [&rods[0], &rods[1]], &mut bend.inverse)
            && deviation.ratio(tolerance) <= USED
        {
            found(end, &ClosedRods::of(machine, rods[1]), None, deviation);
            return Ok(());
        }
    }
    let mut places = [start, *end].map(|stop| Place { stop, surroundings: None });
    let [first, last] = &mut places;
    let (mut now, mut next) = (first, last);
    now.surround(track);
    // Fraction of the tolerance over the square of the parameter.
    let mut curvature = expected.map_or(0.0, |expected| expected / (end.s - start.s).powi(2));
    while now.stop.s < end.s {
        let (from, rest) = (now.stop.s, end.s - now.stop.s);
        let count = (rest * (curvature / AIM).sqrt() - ROUNDING).ceil().max(1.0);
        let width = rest / count;
        if count == 1.0 {
            next.stop = *end;
            next.surround(track);
        } else {
            next.move_to(track, from + width, &now.stop.node)?;
        }
        let segment = Place::segment([now, next], track, tolerance);
        let ratio = segment.as_ref().map_or(f64::INFINITY, |(.., deviation)| deviation.ratio(tolerance));
        let bounds = RATIOS.map(|ratio| AIM / (ratio * ratio));
        curvature = ratio.clamp(bounds[1], bounds[0]) / (width * width);
        match segment {
            Some((segment, rods, deviation)) if ratio <= USED => {
                found(&next.stop, rods, Some(&segment), deviation);
                let way = square_way(machine, &now.stop.node, &next.stop.node);
                bend.known = (way > 0.0).then(|| ratio / way).or(bend.known);
                std::mem::swap(&mut now, &mut next);
            }
            _ if width < LEAST_STEP => return Err(LineariseError::Jump(from)),
            _ => {}
        }
    }
    Ok(())
}

/// The square of the joints' way between two nodes; an angle of a radian counts as much as the machine's longest
/// dimension.
fn square_way(machine: &Machine, a: &Node, b: &Node) -> f64 {
    let sliders = (0..3).map(|i| (b.rho[i] - a.rho[i]) / machine.longest());
    let table = [b.table.theta1 - a.table.theta1, b.table.theta2 - a.table.theta2];
    sliders.chain(table).map(|way| way * way).sum()
}

/// An upper bound of the deviation of a single segment between two stops.
fn bounded(
    track: &Track<'_>,
    [start, end]: [&Stop; 2],
    rods: [&Rods; 2],
    inverse: &mut Option<InverseBound>,
) -> Option<Deviation> {
    let ends = [&start.node, &end.node];
    let joints = second_derivatives(track.setting.machine, ends, rods, track.tool_length, inverse)?;
    let width = end.s - start.s;
    let [tip, axis] = track.path.second_derivatives().map(|second| second * width * width);
    // Inside a cap the axis is off its path at the ends, too.
    let off =
        if track.span.stretch().is_some() { track.axis_off(start).max(track.axis_off(end)) } else { 0.0 };
    Some(Deviation { tip: 0.125 * (joints.tip + tip), axis: off + 0.125 * (joints.axis + axis) })
}

/// A stop on the path, with what the segments on both sides need of it, unless it is at a parallel singularity.
struct Place {
    stop: Stop,
    surroundings: Option<Surroundings>,
}

impl Place {
    fn surround(&mut self, track: &Track<'_>) {
        self.surroundings = Surroundings::of(track, &self.stop, track.path.with_rates(self.stop.s).1);
    }

    /// Moves to a parameter; `before` is a node nearby.
    fn move_to(&mut self, track: &Track<'_>, s: f64, before: &Node) -> Result<(), LineariseError> {
        let ([tip, axis], rates) = track.path.with_rates(s);
        let at = ToolPosition { tip: tip.into(), axis: axis.into() };
        let target = track.setting.target(&track.span, s, &at, track.h);
        let node = track.setting.node_near(&target, track.tool_length, before);
        self.stop = Stop { s, node: node.map_err(|refusal| LineariseError::Refused(s, refusal))? };
        self.surroundings = Surroundings::of(track, &self.stop, rates);
        Ok(())
    }

    /// The joint segment between two places, with the rods at its end and its deviation.
    fn segment<'p>(
        [now, next]: [&'p Self; 2],
        track: &Track<'_>,
        tolerance: &Deviation,
    ) -> Option<(JointSegment<'p>, &'p ClosedRods, Deviation)> {
        let surroundings = [now.surroundings.as_ref()?, next.surroundings.as_ref()?];
        let ends = [&now.stop.node, &next.stop.node];
        let differentials = surroundings.map(|surroundings| &surroundings.differential);
        let segment = JointSegment::new(track.setting.machine, ends, differentials)?;
        let deviation = segment.deviation(track, [now.stop.s, next.stop.s], surroundings, tolerance)?;
        Some((segment, &surroundings[1].closed, deviation))
    }
}

impl Track<'_> {
    /// The joints at a parameter, in the working solution that continues that of another place.
    pub(super) fn node(&self, s: f64, before: Option<&Node>) -> Result<Node, KinematicsError> {
        let target = self.target(s);
        match before {
            Some(before) => self.setting.node_near(&target, self.tool_length, before),
            None => self.setting.node(&target, self.tool_length, None),
        }
    }

    /// The distance of the axis at a stop from that of the path: its part off the meridian.
    fn axis_off(&self, stop: &Stop) -> f64 {
        let [i, j, k] = self.path.at(stop.s).axis;
        let [l, m, n] = stop.node.turns.axis();
        ((i - l).powi(2) + (j - m).powi(2) + (k - n).powi(2)).sqrt()
    }

    /// The pose of the tool at a parameter.
    pub(super) fn target(&self, s: f64) -> Target {
        self.setting.target(&self.span, s, &self.path.at(s), self.h)
    }
}

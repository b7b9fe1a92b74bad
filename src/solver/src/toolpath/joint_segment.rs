//! The motion between two rows: all joints change linearly, and the tool leaves the path.

use nalgebra::Vector3;

use super::differential::Differential;
use super::golden_section::{STEPS, beside, least};
use super::meridian::Span;
use super::nearby_pose::{hermite_middle, parabola, solved};
use super::node::{ClosedRods, Node, Setting};
use super::path::Path;
use crate::machine::Machine;
use crate::pose::{PlatformPose, TableAngles};
use crate::tool_motion::ToolMotion;
use crate::turns::Turns;

/// Number of intervals between the places where the forward problem is solved, if the deviation is not interpolated.
const FINE_INTERVALS: u32 = 16;
/// Part of the tolerance that the last term of an interpolated deviation may be.
const SMALL: f64 = 0.02;
/// The greatest value of t (1 - t) (1 - 2 t).
const GREATEST_ODD: f64 = 0.096_225_1;
/// Greatest deviations from a path: of the tool's end, mm, and of its axis, rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Deviation of the tool's end, mm.
    pub tip: f64,
    /// Of the axis, rad.
    pub axis: f64,
}

impl Deviation {
    /// The greater of both, each as a fraction of its tolerance.
    pub(super) fn ratio(&self, tolerance: &Self) -> f64 {
        (self.tip / tolerance.tip).max(self.axis / tolerance.axis)
    }

    /// The greater of each.
    pub(super) fn with(self, other: Self) -> Self {
        Self { tip: self.tip.max(other.tip), axis: self.axis.max(other.axis) }
    }
}

/// A path on which phi2 follows one rule, and the tool that moves along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Track<'a> {
    pub(super) setting: Setting<'a>,
    pub(super) path: &'a Path,
    pub(super) span: Span,
    pub(super) h: [i32; 2],
    pub(super) tool_length: f64,
}

/// The end of a segment: a parameter of the path and the joints there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    pub(super) s: f64,
    pub(super) node: Node,
}

/// What the segments on both sides of a stop need of it.
pub(super) struct Surroundings {
    pub(super) closed: ClosedRods,
    pub(super) differential: Differential,
    tool: ToolMotion,
    /// The rates of the path by its parameter.
    path: [Vector3<f64>; 2],
}

impl Surroundings {
    /// `None` at a parallel singularity.
    pub(super) fn of(track: &Track<'_>, stop: &Stop, path: [Vector3<f64>; 2]) -> Option<Self> {
        let machine = track.setting.machine;
        let rods = stop.node.rods(machine);
        let differential = Differential::of(machine, &rods)?;
        let closed = ClosedRods { rods, det: differential.det };
        let tool = stop.node.tool(machine, track.tool_length);
        Some(Self { closed, differential, tool, path })
    }
}

/// The motion between two rows.
pub(super) struct JointSegment<'a> {
    ends: [&'a Node; 2],
    differentials: [&'a Differential; 2],
    /// The rates of the platform's pose at both ends, by the fraction of the segment.
    rates: [PlatformPose; 2],
    middle: PlatformPose,
}

impl<'a> JointSegment<'a> {
    /// Solves the forward problem in the middle. `None` if there is a parallel singularity on the segment, or nearly.
    pub(super) fn new(
        machine: &Machine,
        ends: [&'a Node; 2],
        differentials: [&'a Differential; 2],
    ) -> Option<Self> {
        let change = std::array::from_fn(|i| ends[1].rho[i] - ends[0].rho[i]);
        let rates = differentials.map(|differential| differential.pose_rates(change));
        let guess = hermite_middle(ends.map(|end| &end.pose), &rates);
        let (rho, _) = between(ends, 0.5);
        let middle = solved(machine, rho, guess, differentials[0])?;
        Some(Self { ends, differentials, rates, middle })
    }

    /// The joints and the pose at places between the ends, with their fraction of the segment. `None` where the
    /// forward problem has no solution.
    pub(super) fn places(&self, machine: &Machine) -> impl Iterator<Item = Option<(f64, Node)>> {
        (1..FINE_INTERVALS).map(move |i| {
            let t = f64::from(i) / f64::from(FINE_INTERVALS);
            self.node(machine, t).map(|node| (t, node))
        })
    }

    /// The joints and the pose at a fraction of the segment. `None` if the forward problem has no solution there.
    pub(super) fn node(&self, machine: &Machine, t: f64) -> Option<Node> {
        let (rho, table) = between(self.ends, t);
        let guess = parabola([&self.ends[0].pose, &self.middle, &self.ends[1].pose], t);
        let pose = solved(machine, rho, guess, self.differentials[usize::from(t > 0.5)])?;
        Some(Node::new(pose, rho, table))
    }

    /// The place between the ends at which `distance`, which is zero at both of them, is greatest.
    pub(super) fn farthest(&self, machine: &Machine, distance: impl Fn(&Node) -> f64) -> Option<Node> {
        let at = |t: f64| self.node(machine, t).map_or(0.0, |node| distance(&node));
        let places =
            (1..FINE_INTERVALS).map(|place| (place, at(f64::from(place) / f64::from(FINE_INTERVALS))));
        let (place, _) = places.max_by(|a, b| a.1.total_cmp(&b.1))?;
        self.node(machine, least(beside(place, FINE_INTERVALS), STEPS, |t| -at(t)))
    }

    /// The greatest deviation from the track between two stops. At each place one path parameter is compared for both
    /// the tool's end and its axis: that which fits both best in proportion to their tolerances.
    ///
    /// The deviation in the middle and its rates at the ends determine a polynomial of degree four, which vanishes at
    /// both ends. Where its last term is small, its greatest value is the answer, with this term added. Elsewhere the
    /// forward problem is solved at fifteen places. `None` if it has no solution there.
    pub(super) fn deviation(
        &self,
        track: &Track<'_>,
        parameters: [f64; 2],
        surroundings: [&Surroundings; 2],
        tolerance: &Deviation,
    ) -> Option<Deviation> {
        let machine = track.setting.machine;
        let weights = [tolerance.tip, tolerance.axis].map(|tolerance| 1.0 / (tolerance * tolerance));
        let at = |t: f64, node: &Node| {
            let tool = node.tool(machine, track.tool_length).position();
            from_path(track.path, parameters, t, tool, weights)
        };
        let (rho, table) = between(self.ends, 0.5);
        let tables = self.ends.map(|end| end.table);
        let turns = Turns::in_middle(tables, self.ends.map(|end| &end.turns), self.middle.alpha);
        let middle = at(0.5, &Node { pose: self.middle, rho, table, turns });
        // Inside a cap the axis is off its path at the ends, too.
        let held = if track.span.stretch().is_some() {
            [at(0.0, self.ends[0])[1], at(1.0, self.ends[1])[1]]
        } else {
            [Vector3::zeros(); 2]
        };
        let width = parameters[1] - parameters[0];
        let rates = [0, 1].map(|end| {
            let [tip, axis] = self.rates_from_path(surroundings[end], width, end, weights);
            [tip, axis - (held[1] - held[0])]
        });
        let tips = Interpolated::new(middle[0], [rates[0][0], rates[1][0]]);
        let axes = Interpolated::new(middle[1] - (held[0] + held[1]) * 0.5, [rates[0][1], rates[1][1]]);
        let last = Deviation { tip: tips.last(), axis: axes.last() };
        if last.ratio(tolerance) <= SMALL {
            let [tip, axis] = [tips.greatest() + last.tip, axes.greatest() + last.axis];
            return Some(Deviation { tip, axis: axis + held[0].norm().max(held[1].norm()) });
        }
        let mut found = Deviation::default();
        for place in self.places(machine) {
            let (t, node) = place?;
            let [tip, axis] = at(t, &node).map(|offset| offset.norm());
            found = found.with(Deviation { tip, axis });
        }
        Some(found)
    }

    /// The rates at which the tool leaves the path at an end, by the fraction of the segment.
    fn rates_from_path(
        &self,
        &Surroundings { tool, path, .. }: &Surroundings,
        width: f64,
        end: usize,
        weights: [f64; 2],
    ) -> [Vector3<f64>; 2] {
        let [a, b] = self.ends;
        let turn = [b.table.theta1 - a.table.theta1, b.table.theta2 - a.table.theta2];
        let tool = tool.rates(&self.rates[end], turn);
        let off = [tool[0] - path[0] * width, tool[1] - path[1] * width];
        across_path(off, path, weights, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// The place of the worst margin along the segment, as a fraction of its constraint's range.
    pub(super) fn worst(&self, setting: &Setting<'_>, tool_length: f64) -> Option<Node> {
        let margins = self.places(setting.machine).flatten().map(|(_, node)| {
            let margins = setting.margins(&node, tool_length);
            (margins.worst_with_fraction(setting.machine).1, node)
        });
        margins.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, worst)| worst)
    }
}

/// The joints between two nodes.
fn between([a, b]: [&Node; 2], t: f64) -> ([f64; 3], TableAngles) {
    let mix = |a: f64, b: f64| a + (b - a) * t;
    let table = TableAngles {
        theta1: mix(a.table.theta1, b.table.theta1),
        theta2: mix(a.table.theta2, b.table.theta2),
    };
    (std::array::from_fn(|i| mix(a.rho[i], b.rho[i])), table)
}

/// A vector along a segment that vanishes at its ends.
struct Interpolated {
    /// The parts of t (1 - t), t (1 - t) (1 - 2 t) and t (1 - t) (1 - 2 t)².
    terms: [Vector3<f64>; 3],
}

impl Interpolated {
    /// From the value in the middle and the rates at both ends.
    fn new(middle: Vector3<f64>, [start, end]: [Vector3<f64>; 2]) -> Self {
        let bump = middle * 4.0;
        Self { terms: [bump, (start + end) * 0.5, (start - end) * 0.5 - bump] }
    }

    /// The greatest value of the last term.
    fn last(&self) -> f64 {
        self.terms[2].norm() / 16.0
    }

    /// An upper bound of the other two: (1 + b x) (1 - x²) is at most 1 + b²/4 for x = 1 - 2 t.
    fn greatest(&self) -> f64 {
        let [even, odd] = [self.terms[0].norm(), self.terms[1].norm()];
        let slant = odd * GREATEST_ODD;
        0.25 * even + if odd < even { slant.min(odd * odd / (16.0 * even)) } else { slant }
    }
}

/// Offsets of a tool position from the path at the parameter that fits best.
fn from_path(
    path: &Path,
    parameters: [f64; 2],
    t: f64,
    [tip, axis]: [Vector3<f64>; 2],
    weights: [f64; 2],
) -> [Vector3<f64>; 2] {
    let s = parameters[0] + (parameters[1] - parameters[0]) * t;
    let ([at_tip, at_axis], rates) = path.with_rates(s);
    across_path([tip - at_tip, axis - at_axis], rates, weights, parameters.map(|end| end - s))
}

/// The offset less the step along the path that makes it smallest; `weights` are those of the squares of tip and axis,
/// the reciprocals of the squares of the tolerances. The path is
/// straight as far as the parameter moves.
fn across_path(
    [tip, axis]: [Vector3<f64>; 2],
    [tip_rate, axis_rate]: [Vector3<f64>; 2],
    weights: [f64; 2],
    [least, most]: [f64; 2],
) -> [Vector3<f64>; 2] {
    let square = tip_rate.norm_squared() * weights[0] + axis_rate.norm_squared() * weights[1];
    if square <= 0.0 {
        return [tip, axis];
    }
    let along = tip_rate.dot(&tip) * weights[0] + axis_rate.dot(&axis) * weights[1];
    let step = (along / square).max(least).min(most);
    [tip - tip_rate * step, axis - axis_rate * step]
}

//! The motion between two rows: all joints change linearly, and the tool leaves the path.

use nalgebra::{Matrix4, Vector3, Vector4};

use super::azimuth::axis_of;
use super::meridian::Span;
use super::node::{Node, Setting};
use super::path::Path;
use crate::machine::Machine;
use crate::margins::Margins;
use crate::parallel_matrix::matrix;
use crate::pose::{PlatformPose, TableAngles};
use crate::residual::{errors, largest};
use crate::rods::Rods;
use crate::table::part_pose;

/// The fractions of a segment where the forward problem is solved.
const QUARTERS: [f64; 3] = [0.25, 0.5, 0.75];
/// Number of intervals between the places where the deviation is interpolated or solved.
const FINE_INTERVALS: u32 = 16;
/// Part of the tolerance that the last term of an interpolated deviation may be.
const SMALL: f64 = 0.02;
/// The greatest value of t (1 - t) (1 - 2 t).
const GREATEST_ODD: f64 = 0.096_225_1;
/// Newton steps at one place.
const STEPS: u32 = 8;
/// Error of a rod's length at which a pose is accurate enough, relative to the machine's longest dimension. The tool's
/// end is then off by some 1e-5 mm on a machine of one metre.
const ACCURACY: f64 = 2e-9;

/// Greatest deviations from a path: of the tool's end, mm, and of its axis, rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Of the tool's end, mm.
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

/// The poses of the platform along a segment.
pub(super) struct JointSegment {
    /// At 1/4, 1/2 and 3/4.
    poses: [PlatformPose; 3],
    ends: [Node; 2],
}

impl JointSegment {
    /// Solves the forward problem along the segment, from pose to pose. `None` if there is a parallel singularity on
    /// it, or nearly.
    pub(super) fn new(machine: &Machine, a: &Node, b: &Node) -> Option<Self> {
        let middle_joints = between(a, b, 0.5);
        let (middle, inverse) = newton(machine, middle_joints.rho, blended(&a.pose, &b.pose, 0.5))?;
        let mut poses = [middle; 3];
        for (i, t) in [(0, 0.25), (2, 0.75)] {
            let guess = parabola(&a.pose, &middle, &b.pose, t);
            let rho = between(a, b, t).rho;
            poses[i] = solved(machine, rho, guess, &inverse)?;
        }
        Some(Self { poses, ends: [*a, *b] })
    }

    /// The joints and the pose at one of the [`QUARTERS`].
    fn quarter(&self, index: usize) -> Node {
        let t = QUARTERS[index];
        Node { pose: self.poses[index], ..between(&self.ends[0], &self.ends[1], t) }
    }

    /// The joints and the pose at places between the ends, with their fraction of the segment. `None` where the
    /// forward problem has no solution.
    pub(super) fn places(&self, machine: &Machine) -> impl Iterator<Item = Option<(f64, Node)>> {
        (1..FINE_INTERVALS).map(move |i| {
            let t = f64::from(i) / f64::from(FINE_INTERVALS);
            let joints = between(&self.ends[0], &self.ends[1], t);
            let guess = parabola(&self.ends[0].pose, &self.poses[1], &self.ends[1].pose, t);
            let (pose, _) = newton(machine, joints.rho, guess)?;
            Some((t, Node { pose, ..joints }))
        })
    }

    /// The greatest deviation from the track between two stops. At each place one path parameter is compared for both
    /// the tool's end and its axis: that which fits both best in proportion to their tolerances.
    ///
    /// The deviations at the quarters determine a polynomial of degree four, which vanishes at both ends. Where its
    /// last terms are small, its greatest value at fifteen places is the answer, with these terms added. Elsewhere the
    /// forward problem is solved at all fifteen places. `None` if it has no solution there.
    pub(super) fn deviation(
        &self,
        track: &Track<'_>,
        ends: [f64; 2],
        tolerance: &Deviation,
    ) -> Option<Deviation> {
        let at = |t: f64, node: &Node| {
            let tool = tool_position(track.setting.machine, node, track.tool_length);
            from_path(track.path, ends, t, tool, tolerance)
        };
        let offsets = [0, 1, 2].map(|index| at(QUARTERS[index], &self.quarter(index)));
        // Inside a cap the axis is off its path at the ends, too.
        let held = if track.span.stretch().is_some() {
            [at(0.0, &self.ends[0])[1], at(1.0, &self.ends[1])[1]]
        } else {
            [Vector3::zeros(); 2]
        };
        let tips = Interpolated::new(offsets.map(|[tip, _]| tip));
        let axes = Interpolated::new(std::array::from_fn(|i| {
            let t = QUARTERS[i];
            offsets[i][1] - (held[0] * (1.0 - t) + held[1] * t)
        }));
        let last = Deviation { tip: tips.last(), axis: axes.last() };
        if last.ratio(tolerance) <= SMALL {
            let [tip, axis] = [tips.greatest() + last.tip, axes.greatest() + last.axis];
            return Some(Deviation { tip, axis: axis + held[0].norm().max(held[1].norm()) });
        }
        let mut found = Deviation::default();
        for place in self.places(track.setting.machine) {
            let (t, node) = place?;
            let [tip, axis] = at(t, &node).map(|offset| offset.norm());
            found = found.with(Deviation { tip, axis });
        }
        Some(found)
    }

    /// The place of the worst margin along the segment, as a fraction of its constraint's range, and the margins there.
    pub(super) fn worst(&self, setting: &Setting<'_>, tool_length: f64) -> Option<(Node, Margins)> {
        let margins = self.places(setting.machine).flatten().map(|(_, node)| {
            let margins = setting.margins(&node, tool_length);
            (margins.worst_with_fraction(setting.machine).1, (node, margins))
        });
        margins.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, worst)| worst)
    }
}

/// The joints between two nodes; the pose is the first one's.
fn between(a: &Node, b: &Node, t: f64) -> Node {
    let mix = |a: f64, b: f64| a + (b - a) * t;
    Node {
        pose: a.pose,
        rho: std::array::from_fn(|i| mix(a.rho[i], b.rho[i])),
        table: TableAngles {
            theta1: mix(a.table.theta1, b.table.theta1),
            theta2: mix(a.table.theta2, b.table.theta2),
        },
    }
}

fn blended(a: &PlatformPose, b: &PlatformPose, t: f64) -> PlatformPose {
    let mix = |a: f64, b: f64| a + (b - a) * t;
    PlatformPose { x: mix(a.x, b.x), y: mix(a.y, b.y), z: mix(a.z, b.z), alpha: mix(a.alpha, b.alpha) }
}

/// A vector that is known at the quarters of a segment and vanishes at its ends.
struct Interpolated {
    /// The parts of t (1 - t), t (1 - t) (1 - 2 t) and t (1 - t) (1 - 2 t)² / 4.
    terms: [Vector3<f64>; 3],
}

impl Interpolated {
    fn new([first, middle, last]: [Vector3<f64>; 3]) -> Self {
        let even = (first + last) * (8.0 / 3.0);
        let odd = (first - last) * (16.0 / 3.0);
        let square = middle * 4.0;
        Self { terms: [square, odd, (even - square) * 16.0] }
    }

    /// The greatest value of the last term and of the one before it: t (1 - t) (1 - 2 t)² is at most 1/16.
    fn last(&self) -> f64 {
        self.terms[2].norm() / 64.0
    }

    /// The greatest value at the places; more than it by at most the term that changes its sign.
    fn greatest(&self) -> f64 {
        let [even, odd] = [self.terms[0].norm() / 4.0, self.terms[1].norm() * GREATEST_ODD];
        if odd <= SMALL * even {
            return even + odd;
        }
        let square = (1..FINE_INTERVALS).fold(0.0_f64, |greatest, i| {
            let t = f64::from(i) / f64::from(FINE_INTERVALS);
            let (bump, slant) = (t * (1.0 - t), 1.0 - 2.0 * t);
            let [a, b, c] = self.terms;
            let value = (a + b * slant + c * (0.25 * slant * slant)) * bump;
            greatest.max(value.norm_squared())
        });
        square.sqrt()
    }
}

/// The tool's end and axis in the part frame.
fn tool_position(machine: &Machine, node: &Node, tool_length: f64) -> [Vector3<f64>; 2] {
    let tool = part_pose(machine, &node.pose, node.table, tool_length);
    [Vector3::new(tool.x, tool.y, tool.z), axis_of([tool.phi1, tool.phi2]).into()]
}

/// Offsets of a tool position from the path at the parameter that fits best.
fn from_path(
    path: &Path,
    ends: [f64; 2],
    t: f64,
    [tip, axis]: [Vector3<f64>; 2],
    tolerance: &Deviation,
) -> [Vector3<f64>; 2] {
    let squares = [tolerance.tip, tolerance.axis].map(|tolerance| 1.0 / (tolerance * tolerance));
    let s = ends[0] + (ends[1] - ends[0]) * t;
    let ([at_tip, at_axis], [tip_rate, axis_rate]) = path.with_rates(s);
    let (tip, axis) = (tip - at_tip, axis - at_axis);
    let square = tip_rate.norm_squared() * squares[0] + axis_rate.norm_squared() * squares[1];
    if square <= 0.0 {
        return [tip, axis];
    }
    // The path is straight as far as the parameter moves.
    let along = tip_rate.dot(&tip) * squares[0] + axis_rate.dot(&axis) * squares[1];
    let step = (along / square).clamp(ends[0] - s, ends[1] - s);
    [tip - tip_rate * step, axis - axis_rate * step]
}

/// The parabola through the poses at the ends and the middle.
fn parabola(a: &PlatformPose, middle: &PlatformPose, b: &PlatformPose, t: f64) -> PlatformPose {
    let weights = [(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)];
    let mix = |f: fn(&PlatformPose) -> f64| weights[0] * f(a) + weights[1] * f(middle) + weights[2] * f(b);
    PlatformPose { x: mix(|p| p.x), y: mix(|p| p.y), z: mix(|p| p.z), alpha: mix(|p| p.alpha) }
}

/// The pose for given sliders near `guess`, from a known inverse of the parallel matrix nearby if that converges.
fn solved(
    machine: &Machine,
    rho: [f64; 3],
    guess: PlatformPose,
    inverse: &Matrix4<f64>,
) -> Option<PlatformPose> {
    corrected(machine, rho, guess, inverse).or_else(|| newton(machine, rho, guess).map(|(pose, _)| pose))
}

/// The pose for given sliders near `guess`, and the inverse of the parallel matrix nearby.
fn newton(machine: &Machine, rho: [f64; 3], guess: PlatformPose) -> Option<(PlatformPose, Matrix4<f64>)> {
    let mut pose = guess;
    for _ in 0..STEPS {
        let rows = matrix(machine.geometry(), &Rods::of(&machine.mechanism, &pose, rho));
        let inverse = Matrix4::from_fn(|row, column| rows[row][column]).try_inverse()?;
        if let Some(pose) = corrected(machine, rho, pose, &inverse) {
            return Some((pose, inverse));
        }
        pose = stepped(machine, pose, &inverse, errors(&machine.mechanism, &pose, rho));
    }
    None
}

/// The same with a known inverse of the parallel matrix nearby; `None` if that does not converge.
fn corrected(
    machine: &Machine,
    rho: [f64; 3],
    guess: PlatformPose,
    inverse: &Matrix4<f64>,
) -> Option<PlatformPose> {
    let mut pose = guess;
    for _ in 0..3 {
        let now = errors(&machine.mechanism, &pose, rho);
        if largest(&now) <= ACCURACY * machine.longest() {
            return Some(pose);
        }
        pose = stepped(machine, pose, inverse, now);
    }
    None
}

fn stepped(machine: &Machine, pose: PlatformPose, inverse: &Matrix4<f64>, errors: [f64; 4]) -> PlatformPose {
    let step = inverse * Vector4::from(errors);
    PlatformPose {
        x: pose.x - step[0],
        y: pose.y - step[1],
        z: pose.z - step[2],
        alpha: pose.alpha - step[3] / machine.geometry().R1,
    }
}

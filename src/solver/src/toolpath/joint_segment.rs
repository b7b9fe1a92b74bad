//! The motion between two rows: all joints change linearly, and the tool leaves the path.

use nalgebra::{Matrix4, Vector3, Vector4};

use super::meridian::Span;
use super::node::{Node, Setting};
use super::path::Path;
use crate::axis::tool_axis;
use crate::jacobian::matrix;
use crate::limit::Margin;
use crate::machine::Machine;
use crate::margins::Margins;
use crate::pose::{PlatformPose, TableAngles};
use crate::residual::{errors, worst};
use crate::rods::Rods;
use crate::table::part_pose;

/// Number of intervals between the places of a segment that are examined.
const INTERVALS: usize = 10;
/// Newton steps at one place.
const STEPS: u32 = 8;
/// Error of a rod's length at which a pose is accurate enough, relative to the machine's longest dimension.
const ACCURACY: f64 = 1e-10;
/// Steps of the search for the path parameter that fits a place best.
const FITS: u32 = 2;

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

/// The poses of the platform at the places of a segment.
pub(super) struct JointSegment {
    poses: [PlatformPose; INTERVALS - 1],
    ends: [Node; 2],
}

impl JointSegment {
    /// Solves the forward problem along the segment, from pose to pose. `None` if there is a parallel singularity on
    /// it, or nearly.
    pub(super) fn new(machine: &Machine, a: &Node, b: &Node) -> Option<Self> {
        let between = |t: f64| between(a, b, t);
        let middle_joints = between(0.5);
        let guess = blended(&a.pose, &b.pose, 0.5);
        let (middle, inverse) = newton(machine, middle_joints.rho, guess)?;
        // The parabola through both ends and the middle is a good guess everywhere.
        let bend = |f: fn(&PlatformPose) -> f64| 4.0 * (f(&middle) - 0.5 * (f(&a.pose) + f(&b.pose)));
        let bends = [bend(|pose| pose.x), bend(|pose| pose.y), bend(|pose| pose.z), bend(|pose| pose.alpha)];
        let mut poses = [middle; INTERVALS - 1];
        for (i, pose) in poses.iter_mut().enumerate() {
            let t = (i + 1) as f64 / INTERVALS as f64;
            let [x, y, z, alpha] = bends.map(|bend| bend * t * (1.0 - t));
            let line = blended(&a.pose, &b.pose, t);
            let guess =
                PlatformPose { x: line.x + x, y: line.y + y, z: line.z + z, alpha: line.alpha + alpha };
            let rho = between(t).rho;
            *pose = match corrected(machine, rho, guess, &inverse) {
                Some(pose) => pose,
                None => newton(machine, rho, guess)?.0,
            };
        }
        Some(Self { poses, ends: [*a, *b] })
    }

    /// The joints and the pose at the places between the ends, with their fraction of the segment.
    pub(super) fn places(&self) -> impl Iterator<Item = (f64, Node)> {
        self.poses.iter().enumerate().map(|(i, pose)| {
            let t = (i + 1) as f64 / INTERVALS as f64;
            (t, Node { pose: *pose, ..between(&self.ends[0], &self.ends[1], t) })
        })
    }

    /// The greatest deviation from the track between two stops. At each place one path parameter is compared for both
    /// the tool's end and its axis: that which fits both best in proportion to their tolerances.
    pub(super) fn deviation(&self, track: &Track<'_>, ends: [f64; 2], tolerance: &Deviation) -> Deviation {
        self.places().fold(Deviation::default(), |greatest, (t, node)| {
            let tool = part_pose(track.setting.machine, &node.pose, node.table, track.tool_length);
            let tip = Vector3::new(tool.x, tool.y, tool.z);
            let axis = Vector3::from(tool_axis(tool.phi1, tool.phi2));
            greatest.with(from_path(track.path, ends, t, [tip, axis], tolerance))
        })
    }

    /// The worst margin along the segment as a fraction of its constraint's range.
    pub(super) fn worst(&self, setting: &Setting<'_>, tool_length: f64) -> Option<(Margin, f64, Margins)> {
        let margins = self.places().map(|(_, node)| {
            let margins = setting.margins(&node, tool_length);
            let (margin, part) = margins.weighed(setting.machine);
            (margin, part, margins)
        });
        margins.min_by(|a, b| a.1.total_cmp(&b.1))
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

/// Deviation of a tool position from the path at the parameter that fits best.
fn from_path(
    path: &Path,
    ends: [f64; 2],
    t: f64,
    [tip, axis]: [Vector3<f64>; 2],
    tolerance: &Deviation,
) -> Deviation {
    let weights = [1.0 / tolerance.tip, 1.0 / tolerance.axis];
    let mut s = ends[0] + (ends[1] - ends[0]) * t;
    for _ in 0..FITS {
        let at = path.at(s);
        let [tip_rate, axis_rate] = path.rates(s).map(|rate| rate);
        let (tip_rate, axis_rate) = (tip_rate * weights[0], axis_rate * weights[1]);
        let square = tip_rate.norm_squared() + axis_rate.norm_squared();
        if square <= 0.0 {
            break;
        }
        let along = tip_rate.dot(&((tip - Vector3::from(at.tip)) * weights[0]))
            + axis_rate.dot(&((axis - Vector3::from(at.axis)) * weights[1]));
        s = (s + along / square).clamp(ends[0].min(ends[1]), ends[0].max(ends[1]));
    }
    let at = path.at(s);
    Deviation { tip: (tip - Vector3::from(at.tip)).norm(), axis: angle(axis, at.axis.into()) }
}

/// The angle between two unit vectors, rad.
fn angle(a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}

/// The pose for given sliders near `guess`, and the inverse of the parallel matrix there.
fn newton(machine: &Machine, rho: [f64; 3], guess: PlatformPose) -> Option<(PlatformPose, Matrix4<f64>)> {
    let mut pose = guess;
    let mut inverse = Matrix4::identity();
    for _ in 0..STEPS {
        let rows = matrix(machine.geometry(), &Rods::of(machine, &pose, rho));
        inverse = Matrix4::from_fn(|row, column| rows[row][column]).try_inverse()?;
        let now = errors(machine, &pose, rho);
        if worst(&now) <= ACCURACY * machine.longest() {
            return Some((pose, inverse));
        }
        pose = stepped(machine, pose, &inverse, now);
    }
    (worst(&errors(machine, &pose, rho)) <= ACCURACY * machine.longest()).then_some((pose, inverse))
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
        let now = errors(machine, &pose, rho);
        if worst(&now) <= ACCURACY * machine.longest() {
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

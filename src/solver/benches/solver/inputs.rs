//! Random requests that the machine can satisfy, the same in every run.

use std::f64::consts::PI;

use verne_solver::{
    Machine, Margins, PartPose, PlatformPose, Point, Posture, TableAngles, part_pose, platform_working,
    tool_point,
};

use crate::polynomial::{Octic, octic};
use crate::random::Random;

/// Number of poses: too many for a branch predictor to learn.
const COUNT: usize = 768;
/// Distance of an iterative solver's start from the pose it has to find, mm.
const OFF: f64 = 20.0;
/// Tool length, mm.
pub(crate) const TOOL: f64 = 120.0;
/// The box from which poses are drawn, mm; larger than the workspace.
const BOX: [[f64; 2]; 3] = [[-800.0, 800.0], [-800.0, 800.0], [400.0, 1800.0]];

/// One pose within all margins, as the request of each entry point, and the start of an iterative solver.
#[derive(Clone, Debug)]
pub(crate) struct Inputs {
    pub(crate) postures: Vec<Posture>,
    pub(crate) tables: Vec<(Posture, TableAngles)>,
    pub(crate) rho: Vec<[f64; 3]>,
    pub(crate) starts: Vec<([f64; 3], PlatformPose)>,
    pub(crate) octics: Vec<Octic>,
    pub(crate) points: Vec<Point>,
    pub(crate) tools: Vec<Point>,
    pub(crate) parts: Vec<PartPose>,
}

impl Inputs {
    pub(crate) fn random(machine: &Machine) -> Self {
        let mut random = Random::new(0x5EED);
        let tables: Vec<_> =
            std::iter::from_fn(|| Some(reachable(machine, &mut random))).take(COUNT).collect();
        let postures: Vec<Posture> = tables.iter().map(|(posture, _)| *posture).collect();
        let starts = postures.iter().map(|p| (p.rho, start(machine, &p.pose, &mut random))).collect();
        Self {
            rho: postures.iter().map(|p| p.rho).collect(),
            octics: postures.iter().map(|p| octic(machine, p.rho)).collect(),
            starts,
            points: postures.iter().map(|p| [p.pose.x, p.pose.y, p.pose.z]).collect(),
            tools: postures.iter().map(|p| tool_point(&p.pose, TOOL)).collect(),
            parts: tables.iter().map(|(p, table)| part_pose(machine, &p.pose, *table, TOOL)).collect(),
            postures,
            tables,
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.postures.len()
    }

    /// Stops unless an iterative solver finds every pose on which it is timed, except for rounding.
    pub(crate) fn check(&self, solve: impl Fn([f64; 3], PlatformPose) -> Option<PlatformPose>) {
        for (posture, &(rho, start)) in self.postures.iter().zip(&self.starts) {
            let (pose, found) = (&posture.pose, solve(rho, start).expect("it converges from near by"));
            let lengths = [found.x - pose.x, found.y - pose.y, found.z - pose.z];
            let same = lengths.iter().all(|d| d.abs() < 1e-9) && (found.alpha - pose.alpha).abs() < 1e-11;
            assert!(same, "{found:?} instead of {pose:?}");
        }
    }
}

/// A posture in the working mode within all margins, and table angles in their ranges.
fn reachable(machine: &Machine, random: &mut Random) -> (Posture, TableAngles) {
    let limits = &machine.data().limits;
    let ([tilt_low, tilt_high], [rotary_low, rotary_high]) =
        (limits.tilt, limits.rotary.unwrap_or([-PI, PI]));
    loop {
        let point = BOX.map(|[low, high]| random.between(low, high));
        let theta1 = random.between(tilt_low, tilt_high);
        let table = TableAngles { theta1, theta2: random.between(rotary_low, rotary_high) };
        if let Ok(posture) = platform_working(machine, point)
            && Margins::of(machine, &posture, Some(table)).feasible()
        {
            return (posture, table);
        }
    }
}

/// The machine's pose at a point that lies [`OFF`] away in a random direction.
fn start(machine: &Machine, pose: &PlatformPose, random: &mut Random) -> PlatformPose {
    loop {
        let direction: [f64; 3] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
        if !(0.1..=1.0).contains(&length) {
            continue;
        }
        let [dx, dy, dz] = direction.map(|c| c * OFF / length);
        if let Ok(posture) = platform_working(machine, [pose.x + dx, pose.y + dy, pose.z + dz]) {
            return posture.pose;
        }
    }
}

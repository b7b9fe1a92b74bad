//! Random poses and sliders of a machine.

use std::f64::consts::PI;

use verne_solver::{Machine, PartPose};

use crate::lengths::scale;
use crate::random::Random;

impl Random {
    /// Slider positions anywhere within a few machine lengths, on any level.
    pub(crate) fn rho(&mut self, machine: &Machine) -> [f64; 3] {
        let scale = scale(machine);
        let (spread, level) = (self.between(0.05, 1.6), self.between(-1.0, 1.0));
        [0, 1, 2].map(|_| scale * (level + spread * self.between(-1.0, 1.0)))
    }

    /// A point around the machine, most of them within reach of its legs.
    pub(crate) fn point(&mut self, machine: &Machine) -> [f64; 3] {
        let g = &machine.data().geometry;
        let scale = scale(machine);
        let middle = -f64::midpoint(g.D1 - g.d1, g.D2 - g.d2);
        let reach = self.pick(&[0.2, 0.5, 1.0]);
        [
            middle + scale * reach * self.between(-0.8, 0.8),
            scale * reach * self.between(-0.8, 0.8),
            scale * self.between(0.0, 2.0),
        ]
    }

    /// A length of the tool, zero and longer than the machine's rods among them.
    pub(crate) fn tool_length(&mut self, machine: &Machine) -> f64 {
        if self.one_in(4) { 0.0 } else { scale(machine) * self.magnitude(0.01, 1.2) }
    }

    /// A tool pose in the table frame whose platform position at one of its table angles is a
    /// point around the machine, so that many are reachable.
    pub(crate) fn part_pose(&mut self, machine: &Machine, tool_length: f64) -> PartPose {
        let [x, y, z] = self.point(machine);
        let alpha = self.between(-PI, PI) * self.pick(&[0.1, 1.0]);
        let pose = verne_solver::PlatformPose { x, y, z, alpha };
        let [theta1, theta2] = [self.between(-1.5, 1.5), self.between(-PI, PI)];
        verne_solver::part_pose(machine, &pose, verne_solver::TableAngles { theta1, theta2 }, tool_length)
    }
}

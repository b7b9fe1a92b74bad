//! The joints at one place of a program with what their neighbourhood needs.

use nalgebra::{Matrix4, Vector4};

use super::node::Node;
use crate::machine::Machine;
use crate::parallel_matrix::matrix;
use crate::pose::PlatformPose;
use crate::rods::Rods;

/// The rods at a place, and the inverse of the parallel matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Differential {
    pub(super) rods: Rods,
    pub(super) inverse: Matrix4<f64>,
    radius: f64,
}

/// Joints with their differential.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub(super) node: Node,
    /// `None` at a parallel singularity.
    pub(super) differential: Option<Differential>,
}

impl Station {
    pub(super) fn new(machine: &Machine, node: Node) -> Self {
        Self { node, differential: Differential::of(machine, node.rods(machine)) }
    }
}

impl Differential {
    /// `None` at a parallel singularity.
    pub(super) fn of(machine: &Machine, rods: Rods) -> Option<Self> {
        let g = machine.geometry();
        let rows = matrix(g, &rods);
        let inverse = Matrix4::from_fn(|row, column| rows[row][column]).try_inverse()?;
        Some(Self { rods, inverse, radius: g.R1 })
    }

    /// Rates of the platform's pose for these rates of the sliders: Eqs (3)-(6) differentiated.
    pub(super) fn pose_rates(&self, [first, second, third]: [f64; 3]) -> PlatformPose {
        let z = self.rods.directions.map(|direction| direction[2]);
        self.pose_change(&Vector4::new(z[0] * first, z[1] * first, z[2] * second, z[3] * third))
    }

    /// The change of the platform's pose for changes of the rods' lengths, to the first order.
    pub(super) fn pose_change(&self, lengths: &Vector4<f64>) -> PlatformPose {
        let change = self.inverse * lengths;
        PlatformPose { x: change[0], y: change[1], z: change[2], alpha: change[3] / self.radius }
    }
}

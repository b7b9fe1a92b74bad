//! A bound of the deviation of a short joint segment from its path, without a forward problem.
//!
//! A curve whose second derivative by the fraction of the segment is at most X stays within X/8 of its chord. The
//! platform's second derivative follows from Eqs (3)-(6): with b a rod's vector, u its direction and M the parallel
//! matrix, M G'' = -|b'|²/L + a'² u · (Rot(a) B) for G = (x, y, z, R1 a). The bound takes |b'| from the rods at both
//! ends, and the inverse of M at one end with the change of M along the segment.

use nalgebra::Matrix4;

use super::joint_segment::Deviation;
use super::node::Node;
use crate::machine::Machine;
use crate::parallel_matrix::matrix;
use crate::rods::Rods;

/// The joints at one end of a segment, with what the bound needs of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundEnd {
    rods: Rods,
}

impl BoundEnd {
    pub(super) fn new(machine: &Machine, node: &Node) -> Self {
        Self { rods: Rods::of(&machine.mechanism, &node.pose, node.rho) }
    }

    /// Upper bound of the second derivatives of the tool's end and axis along the joint segment from `a` to `b`, and
    /// `None` if the segment is too long for it.
    pub(super) fn second_derivatives(
        &self,
        machine: &Machine,
        [a, b]: [&Node; 2],
        other: &Self,
        tool_length: f64,
    ) -> Option<Deviation> {
        let g = machine.geometry();
        let ratio = (g.R2 / g.R1).max(1.0);
        let least_length = g.L1.min(g.L2).min(g.L3);
        let rows = matrix(g, &self.rods);
        let inverse = Matrix4::from_fn(|row, column| rows[row][column]).try_inverse()?.norm();
        let alpha = (b.pose.alpha - a.pose.alpha).abs();
        let rod =
            (0..4).fold(0.0_f64, |most, i| most.max(distance(self.rods.vectors[i], other.rods.vectors[i])));
        let platform = distance([a.pose.x, a.pose.y, a.pose.z], [b.pose.x, b.pose.y, b.pose.z]);
        let radius = g.R1.max(g.R2);
        // Rates are at most those of the chords plus the second derivative, for which twice a first estimate is tried.
        let right = |second: f64| {
            let angle = alpha + second / g.R1;
            let rate = rod + (1.0 + ratio) * second + radius * angle * angle;
            rate * rate / least_length + radius * angle * angle
        };
        let change = 2.0 * ((1.0 + ratio) * rod / least_length + ratio * alpha);
        let loss = 1.0 - 2.0 * inverse * change;
        if loss < 0.5 {
            return None;
        }
        let greatest_inverse = inverse / loss;
        let second = 4.0 * greatest_inverse * right(0.0);
        if 2.0 * greatest_inverse * right(second) > second {
            return None;
        }
        let theta = (b.table.theta1 - a.table.theta1).abs() + (b.table.theta2 - a.table.theta2).abs();
        let (alpha_rate, alpha_second) = (alpha + second / g.R1, second / g.R1);
        let arm = a.pose.x.abs() + a.pose.y.abs() + (a.pose.z - machine.table().da).abs();
        let arm = arm + machine.table().dt.abs() + platform;
        let turn = alpha_rate + theta;
        let axis = alpha_second + turn * turn;
        let tip = second
            + 2.0 * theta * (platform + second)
            + theta * theta * (arm + second)
            + tool_length.abs() * axis;
        Some(Deviation { tip, axis })
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = std::array::from_fn(|i| a[i] - b[i]);
    (x * x + y * y + z * z).sqrt()
}

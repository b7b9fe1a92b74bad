//! A bound of the deviation of a short joint segment from its path, without a forward problem.
//!
//! A curve whose second derivative by the fraction of the segment is at most X stays within X/8 of its chord. The
//! platform's second derivative follows from Eqs (3)-(6): with b a rod's vector, u its direction and M the parallel
//! matrix, M G'' = -|b'|²/L + a'² u · (Rot(a) B) for G = (x, y, z, R1 a). The bound takes |b'| from the rods at both
//! ends, and the inverse of M at one end with the change of M along the segment.

use super::joint_segment::Deviation;
use super::node::Node;
use crate::machine::Machine;
use crate::mechanism::Geometry;
use crate::parallel_matrix::{inverse, matrix};
use crate::rods::Rods;

/// Part of the inverse's reciprocal that M may change by before another place takes over.
const MOST_CHANGE: f64 = 0.5;

/// A place, and the norm of the inverse of M there. It serves all segments nearby.
#[derive(Clone, Copy, Debug)]
pub(super) struct InverseBound {
    rods: [[f64; 3]; 4],
    alpha: f64,
    norm: f64,
}

impl InverseBound {
    fn new(machine: &Machine, node: &Node, rods: &Rods) -> Option<Self> {
        let (_, inverse) = inverse(&matrix(machine.geometry(), rods))?;
        let square: f64 = inverse.iter().flatten().map(|element| element * element).sum();
        Some(Self { rods: rods.vectors, alpha: node.pose.alpha, norm: square.sqrt() })
    }

    /// An upper bound of the norm along a segment from a place, on which rods and alpha change by this much; `None` if
    /// the place is too far away.
    fn along(&self, g: &Geometry, node: &Node, rods: &Rods, [rod, alpha]: [f64; 2]) -> Option<f64> {
        let ratio = (g.R2 / g.R1).max(1.0);
        let rod = rod + greatest_distance(&self.rods, &rods.vectors);
        let alpha = alpha + (node.pose.alpha - self.alpha).abs();
        let change = 2.0 * ((1.0 + ratio) * rod / g.L1.min(g.L2).min(g.L3) + ratio * alpha);
        let loss = 2.0 * self.norm * change;
        (loss <= MOST_CHANGE).then(|| self.norm / (1.0 - loss))
    }
}

/// Upper bound of the second derivatives of the tool's end and axis along the joint segment from `a` to `b`, and
/// `None` if the segment is too long for it. `known` is a bound from a place nearby.
pub(super) fn second_derivatives(
    machine: &Machine,
    [a, b]: [&Node; 2],
    [rods, other]: [&Rods; 2],
    tool_length: f64,
    known: &mut Option<InverseBound>,
) -> Option<Deviation> {
    let g = machine.geometry();
    let ratio = (g.R2 / g.R1).max(1.0);
    let least_length = g.L1.min(g.L2).min(g.L3);
    let alpha = (b.pose.alpha - a.pose.alpha).abs();
    let rod = greatest_distance(&rods.vectors, &other.vectors);
    let platform = square_distance([a.pose.x, a.pose.y, a.pose.z], [b.pose.x, b.pose.y, b.pose.z]).sqrt();
    let radius = g.R1.max(g.R2);
    let nearby = known.and_then(|known| known.along(g, a, rods, [rod, alpha]));
    let greatest_inverse = if let Some(nearby) = nearby {
        nearby
    } else {
        *known = InverseBound::new(machine, a, rods);
        known.and_then(|known| known.along(g, a, rods, [rod, alpha]))?
    };
    // Rates are at most those of the chords plus the second derivative, for which twice a first estimate is tried.
    let right = |second: f64| {
        let angle = alpha + second / g.R1;
        let rate = rod + (1.0 + ratio) * second + radius * angle * angle;
        rate * rate / least_length + radius * angle * angle
    };
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

fn greatest_distance(a: &[[f64; 3]; 4], b: &[[f64; 3]; 4]) -> f64 {
    let square = |i: usize| square_distance(a[i], b[i]);
    square(0).max(square(1)).max(square(2).max(square(3))).sqrt()
}

fn square_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = std::array::from_fn(|i| a[i] - b[i]);
    x * x + y * y + z * z
}

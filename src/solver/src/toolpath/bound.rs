//! A bound of the deviation of a short joint segment from its path, without a forward problem.
//!
//! A curve whose second derivative by the fraction of the segment is at most X stays within X/8 of its chord. The
//! platform's second derivative follows from Eqs (3)-(6): with b a rod's vector, u its direction and M the parallel
//! matrix, M G'' = -|b'|²/L + a'² u · (Rot(a) B) for G = (x, y, z, R1 a). The bound takes |b'| from the rods at both
//! ends, and the inverse of M at one end with the change of M along the segment.

use super::differential::Station;
use super::joint_segment::Deviation;
use crate::machine::Machine;

/// Upper bound of the second derivatives of the tool's end and axis along the joint segment between two stations, and
/// `None` if the segment is too long for it.
pub(super) fn second_derivatives(
    machine: &Machine,
    [start, end]: [&Station; 2],
    tool_length: f64,
) -> Option<Deviation> {
    let g = machine.geometry();
    let (a, b) = (&start.node, &end.node);
    let (rods, inverse) = start.differential.as_ref().map(|d| (&d.rods, d.inverse.norm()))?;
    let other = &end.differential.as_ref()?.rods;
    let ratio = (g.R2 / g.R1).max(1.0);
    let least_length = g.L1.min(g.L2).min(g.L3);
    let alpha = (b.pose.alpha - a.pose.alpha).abs();
    let square = |i: usize| square_distance(rods.vectors[i], other.vectors[i]);
    let rod = square(0).max(square(1)).max(square(2).max(square(3))).sqrt();
    let platform = square_distance([a.pose.x, a.pose.y, a.pose.z], [b.pose.x, b.pose.y, b.pose.z]).sqrt();
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

fn square_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = std::array::from_fn(|i| a[i] - b[i]);
    x * x + y * y + z * z
}

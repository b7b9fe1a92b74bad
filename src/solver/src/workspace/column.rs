//! One vertical column of the workspace: the quantities that (x, y) alone determines.
//!
//! The guideways are parallel to z. So alpha, the rods' directions and the sliders' distances `f_i` = z - `rho_i` are
//! constant along a column.

use crate::inverse::leg_one_cubic::{LegOneAngle, LegOneCubic};
use crate::machine::Machine;

/// The platform at (x, y) in the working mode, or a continuation beyond that mode. The continuation lets root-finding
/// bracket a limit from outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub(super) x: f64,
    pub(super) y: f64,
    /// cos alpha and sin alpha.
    pub(super) c: f64,
    pub(super) s: f64,
    /// Squares of the legs' drops along z, mm²; negative where a leg is too short.
    pub(super) square: [f64; 3],
    /// The drops, with the sign of their squares, mm.
    pub(super) w: [f64; 3],
    /// `f_i` = z - `rho_i`, mm.
    pub(super) f: [f64; 3],
}

impl Column {
    #[inline]
    pub(super) fn at(machine: &Machine, [x, y]: [f64; 2]) -> Self {
        let leg = LegOneCubic::new(&machine.mechanism, x, y);
        match leg.nearest() {
            Some(angle) if lead(machine, &angle) > 0.0 => Self::with(machine, [x, y], &angle),
            _ => Self::elsewhere(machine, [x, y], &leg),
        }
    }

    /// Takes the cubic's other root if the working mode is there. Beyond both it takes the root that is nearer to the
    /// working mode, and beyond the leg's reach the angle that misses least.
    #[cold]
    fn elsewhere(machine: &Machine, [x, y]: [f64; 2], leg: &LegOneCubic<'_>) -> Self {
        let angles = leg.both();
        let nearest = angles.iter().max_by(|a, b| lead(machine, a).total_cmp(&lead(machine, b)));
        if let Some(angle) = nearest {
            return Self::with(machine, [x, y], angle);
        }
        let mut angle = leg.closest();
        let (g, d) = (machine.geometry(), &machine.mechanism);
        let x1 = x + d.e1;
        angle.w1 = signed_root((g.L1 - x1) * (g.L1 + x1) - d.c + d.k * angle.c - y * y);
        Self::with(machine, [x, y], &angle)
    }

    #[inline]
    fn with(machine: &Machine, [x, y]: [f64; 2], angle: &LegOneAngle) -> Self {
        let g = machine.geometry();
        let (c, s) = (angle.c, angle.s);
        let (p, q) = (g.R2 * c - g.r4, g.R2 * s);
        let x2 = x + machine.mechanism.e2;
        let second = (g.L2 - x2) * (g.L2 + x2) - (y - p) * (y - p);
        let third = (g.L3 - x2) * (g.L3 + x2) - (y + p) * (y + p);
        let w = [angle.w1, signed_root(second), signed_root(third)];
        Self { x, y, c, s, square: [w[0] * w[0].abs(), second, third], w, f: [w[0], q + w[1], w[2] - q] }
    }

    /// alpha, rad.
    pub(super) fn alpha(&self) -> f64 {
        self.s.atan2(self.c)
    }

    /// d(alpha)/dx and d(alpha)/dy along the working mode, rad/mm.
    #[inline]
    pub(super) fn angle_rates(&self, machine: &Machine) -> [f64; 2] {
        let (g, k) = (machine.geometry(), machine.mechanism.k);
        let (u, v) = (g.R1 * self.c - g.r1, g.R1 * self.s);
        let w1 = self.w[0];
        let inverse = 1.0 / w1;
        let h = g.R1 * (self.c * w1 - self.y * self.s) - 0.5 * v * k * self.s * inverse;
        let x1 = self.x + machine.mechanism.e1;
        [v * x1 * inverse / h, (v * self.y * inverse - u) / h]
    }

    /// Gradients of f1, f2, f3 in the plane, given those of alpha.
    #[inline]
    pub(super) fn drop_rates(&self, machine: &Machine, [ax, ay]: [f64; 2]) -> [[f64; 2]; 3] {
        let (g, d) = (machine.geometry(), &machine.mechanism);
        let (p, pa, qa) = (g.R2 * self.c - g.r4, -g.R2 * self.s, g.R2 * self.c);
        let (x1, x2) = (self.x + d.e1, self.x + d.e2);
        let bend = 0.5 * d.k * self.s;
        let [i1, i2, i3] = self.w.map(|w| 1.0 / w);
        let (second, third) = (self.y - p, self.y + p);
        [
            [-(x1 + bend * ax) * i1, -(self.y + bend * ay) * i1],
            [qa * ax + (second * pa * ax - x2) * i2, qa * ay - second * (1.0 - pa * ay) * i2],
            [-qa * ax - (third * pa * ax + x2) * i3, -qa * ay - third * (1.0 + pa * ay) * i3],
        ]
    }
}

/// A number that is positive if leg I is in the working mode: the least of its rods' distance from crossing and its
/// drops, relative to its size.
#[inline]
fn lead(machine: &Machine, angle: &LegOneAngle) -> f64 {
    let g = machine.geometry();
    let above = (angle.w1 - g.R1 * angle.s.abs()) / g.L1;
    above.min((g.R1 * angle.c - g.r1 + machine.mechanism.crossing_reserve) / g.R1)
}

/// √x with the sign of x.
#[inline]
pub(super) fn signed_root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

//! Leg I and the other dimensions in units of the longest, and the angles of leg I as functions of one angle φ.
//!
//! Leg I closes where the middle of its rods, (X1, y, w1) with (y, w1) = m (sin φ, cos φ), is perpendicular to half
//! their difference, (u, v) = ℓ (cos φ, -sin φ), and X1² + m² + ℓ² = L1². With ψ = a + φ the platform's angle follows
//! from R1 sin ψ = r1 sin φ, and ℓ = R1 cos ψ - r1 cos φ.

use crate::interval::Interval;
use crate::machine::Machine;

/// A value and its derivative along φ.
pub(super) type Rated<T> = [T; 2];

/// The branch of leg I's angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Branch {
    /// R1 > r1: there is one.
    Only,
    /// R1 = r1, a = 0: leg I is a parallelogram, X1² + y² + w1² = L1².
    Level,
    /// R1 = r1, the other one: the rods of leg I cross. ℓ = -2 R1 cos φ, ψ = π - φ.
    Crossed,
}

/// The dimensions, in units of the longest.
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub(super) struct Shape {
    pub(super) R1: f64,
    pub(super) r1: f64,
    pub(super) R2: f64,
    pub(super) r4: f64,
    /// Squares of the rods' lengths.
    pub(super) squares: [f64; 3],
    pub(super) e1: f64,
    /// X2 - X1.
    pub(super) offset: f64,
    pub(super) branch: Branch,
}

/// The functions of φ: cos φ, sin φ, ℓ, cos ψ, ℓ / cos ψ, cos a, sin a.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOneAngles<T> {
    pub(super) cos_phi: T,
    pub(super) sin_phi: T,
    pub(super) arm: T,
    pub(super) cos_psi: T,
    /// ℓ / cos ψ. It is bounded and smooth in t (see [`super::chart`]) however near R1 is to r1.
    pub(super) scaled_arm: T,
    pub(super) c: T,
    pub(super) s: T,
}

impl<T> LegOneAngles<T> {
    /// Applies a function to each.
    pub(super) fn map<U>(self, f: impl Fn(T) -> U) -> LegOneAngles<U> {
        let Self { cos_phi, sin_phi, arm, cos_psi, scaled_arm, c, s } = self;
        let [cos_phi, sin_phi, arm, cos_psi, scaled_arm, c, s] =
            [cos_phi, sin_phi, arm, cos_psi, scaled_arm, c, s].map(f);
        LegOneAngles { cos_phi, sin_phi, arm, cos_psi, scaled_arm, c, s }
    }
}

impl Shape {
    pub(super) fn new(machine: &Machine, branch: Branch) -> Self {
        let (mechanism, unit) = (&machine.mechanism, machine.longest());
        let g = &mechanism.geometry;
        Self {
            R1: g.R1 / unit,
            r1: g.r1 / unit,
            R2: g.R2 / unit,
            r4: g.r4 / unit,
            squares: [g.L1, g.L2, g.L3].map(|length| (length / unit).powi(2)),
            e1: mechanism.e1 / unit,
            offset: (mechanism.e2 - mechanism.e1) / unit,
            branch,
        }
    }

    /// The branches of a machine's leg I.
    pub(super) fn branches(machine: &Machine) -> &'static [Branch] {
        if machine.mechanism.is_delta() { &[Branch::Level, Branch::Crossed] } else { &[Branch::Only] }
    }

    pub(super) fn has_equal_offsets(&self) -> bool {
        self.offset == 0.0
    }

    /// δ, the cosine of ψ at φ = π/2: δ² = 1 - (r1/R1)², without cancellation.
    pub(super) fn bend(&self) -> f64 {
        ((self.R1 - self.r1) * (self.R1 + self.r1)).sqrt() / self.R1
    }

    /// cos ψ, sin ψ and dψ/dφ.
    fn psi(&self, [cos, sin]: [f64; 2]) -> [f64; 3] {
        if self.branch == Branch::Only {
            let ratio = self.r1 / self.R1;
            let cos_psi = self.bend().hypot(ratio * cos);
            [cos_psi, ratio * sin, ratio * cos / cos_psi]
        } else {
            [-cos, sin, -1.0]
        }
    }

    /// The angles at φ with their derivatives. The level branch has none.
    pub(super) fn angles(&self, phi: f64) -> LegOneAngles<Rated<f64>> {
        let (sin, cos) = phi.sin_cos();
        let [cos_psi, sin_psi, psi_rate] = self.psi([cos, sin]);
        let (arm, arm_rate) = if self.branch == Branch::Only {
            let arm = self.arm(cos, cos_psi);
            (arm, self.r1 * arm * sin / (self.R1 * cos_psi))
        } else {
            (-2.0 * self.R1 * cos, 2.0 * self.R1 * sin)
        };
        let (c, s) = (cos_psi * cos + sin_psi * sin, sin_psi * cos - cos_psi * sin);
        let rate = psi_rate - 1.0;
        let scaled_arm = if self.branch == Branch::Only {
            // The derivative of ℓ / cos ψ, with R1 sin ψ = r1 sin φ.
            let scaled = arm / cos_psi;
            [scaled, scaled * self.r1 / self.R1 * sin * (1.0 + psi_rate) / cos_psi]
        } else {
            [2.0 * self.R1, 0.0]
        };
        LegOneAngles {
            cos_phi: [cos, -sin],
            sin_phi: [sin, cos],
            arm: [arm, arm_rate],
            cos_psi: [cos_psi, -sin_psi * psi_rate],
            scaled_arm,
            c: [c, -s * rate],
            s: [s, c * rate],
        }
    }

    /// ℓ of the only branch, without cancellation.
    fn arm(&self, cos: f64, cos_psi: f64) -> f64 {
        let (far, near) = (self.R1 * cos_psi, self.r1 * cos);
        if near > 0.0 { (self.R1 - self.r1) * (self.R1 + self.r1) / (far + near) } else { far - near }
    }

    /// The ranges of the angles and of their derivatives over a range of φ in which ℓ rises.
    pub(super) fn angle_ranges(&self, phi: Interval) -> LegOneAngles<Rated<Interval>> {
        let [low, high] = [phi.low, phi.high].map(|phi| self.angles(phi));
        let between = |a: f64, b: f64| Interval::new(a.min(b), a.max(b));
        let (cos, sin) = (between(low.cos_phi[0], high.cos_phi[0]), phi.sine());
        let arm = between(low.arm[0], high.arm[0]);
        // a falls as φ rises.
        let a = between(self.platform_angle(phi.low), self.platform_angle(phi.high));
        let (c, s) = (a.cosine(), a.sine());
        let [psi_rate, arm_rate, cos_psi, sin_psi] = if self.branch == Branch::Only {
            let ratio = self.r1 / self.R1;
            let sin_psi = sin.times(ratio);
            let cos_psi = cos.times(ratio).square().plus(self.bend() * self.bend()).root();
            // ratio cos φ / cos ψ rises with cos φ.
            let rate = |at: &LegOneAngles<Rated<f64>>| ratio * at.cos_phi[0] / at.cos_psi[0];
            let arm_rate = (arm * sin * cos_psi.reciprocal()).times(ratio);
            [between(rate(&low), rate(&high)), arm_rate, cos_psi, sin_psi]
        } else {
            [Interval::of(-1.0), sin.times(2.0 * self.R1), -cos, sin]
        };
        let rate = psi_rate.plus(-1.0);
        // ℓ / cos ψ rises with φ.
        let scaled = between(low.scaled_arm[0], high.scaled_arm[0]);
        let scaled_arm = if self.branch == Branch::Only {
            let slope = (scaled * sin * psi_rate.plus(1.0) * cos_psi.reciprocal()).times(self.r1 / self.R1);
            [scaled, slope]
        } else {
            [scaled, Interval::ZERO]
        };
        LegOneAngles {
            cos_phi: [cos, -sin],
            sin_phi: [sin, cos],
            arm: [arm, arm_rate],
            cos_psi: [cos_psi, -(sin_psi * psi_rate)],
            scaled_arm,
            c: [c, -(s * rate)],
            s: [s, c * rate],
        }
    }

    /// a at φ, continuous along φ.
    fn platform_angle(&self, phi: f64) -> f64 {
        if self.branch == Branch::Only {
            (self.r1 / self.R1 * phi.sin()).asin() - phi
        } else {
            std::f64::consts::PI - 2.0 * phi
        }
    }
}

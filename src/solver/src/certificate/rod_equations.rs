//! Eqs (3)-(6) in the platform's pose, for given sliders.

use super::angle::{direction, directions, turned_within};
use super::enclosure::Enclosure;
use super::krawczyk::Equations;
use crate::mechanism::Mechanism;
use crate::parallel_matrix;

/// Half the difference of each rod's squared length from that of the machine, in (x, y, w1 = z - rho1, a). The rods are
/// 11, 12, one of leg II and one of leg III.
#[derive(Clone, Copy, Debug)]
pub(super) struct RodEquations<'a> {
    mechanism: &'a Mechanism,
    /// e1 and e2.
    offsets: [Enclosure; 2],
    /// rho1 - rho2 and rho1 - rho3.
    gaps: [Enclosure; 2],
}

impl<'a> RodEquations<'a> {
    pub(super) fn new(mechanism: &'a Mechanism, rho: [f64; 3]) -> Self {
        let g = &mechanism.geometry;
        let difference = |a: f64, b: f64| Enclosure::of(a) - Enclosure::of(b);
        Self {
            mechanism,
            offsets: [difference(g.D1, g.d1), difference(g.D2, g.d2)],
            gaps: [difference(rho[0], rho[1]), difference(rho[0], rho[2])],
        }
    }

    /// B - A of the four rods.
    pub(super) fn rods(&self, [x, y, w]: [Enclosure; 3], [c, s]: [Enclosure; 2]) -> [[Enclosure; 3]; 4] {
        let g = &self.mechanism.geometry;
        let [x1, x2] = self.offsets.map(|offset| x + offset);
        let (u, v) = (c.times(g.R1) - Enclosure::of(g.r1), s.times(g.R1));
        let (p, q) = (c.times(g.R2) - Enclosure::of(g.r4), s.times(g.R2));
        let [second, third] = self.gaps.map(|gap| w + gap);
        [[x1, y + u, w + v], [x1, y - u, w - v], [x2, y - p, second - q], [x2, y + p, third + q]]
    }

    /// The rods' rows of the derivatives.
    pub(super) fn rows(&self, rods: &[[Enclosure; 3]; 4], [c, s]: [Enclosure; 2]) -> [[Enclosure; 4]; 4] {
        let g = &self.mechanism.geometry;
        let arms = [g.R1, -g.R1, -g.R2, g.R2];
        std::array::from_fn(|i| {
            let [x, y, z] = rods[i];
            [x, y, z, (c * z - s * y).times(arms[i])]
        })
    }
}

impl RodEquations<'_> {
    /// 2 x + e1 + e2: twice the distance from x = -e1 if both offsets are equal.
    pub(super) fn mirror_side(&self, x: Enclosure) -> Enclosure {
        x.times(2.0) + self.offsets[0] + self.offsets[1]
    }

    /// Whether all sliders are above the platform and the rods of leg I do not cross, at a zero within bounds of
    /// (x, y, w1, a). `None` if that is not decided.
    pub(super) fn hang_uncrossed(&self, [x, y, w, a]: [Enclosure; 4]) -> Option<bool> {
        let turn = directions(a);
        let g = &self.mechanism.geometry;
        let rods = self.rods([x, y, w], turn);
        let u = turn[0].times(g.R1) - Enclosure::of(g.r1);
        let crosses = match self.mechanism.is_delta() {
            true if is_level([y, w], a) => Some(false),
            true => a.excludes_zero().then_some(true),
            false => sign(-u),
        };
        let [first, other, second, third] = rods.map(|[_, _, z]| sign(-z));
        let faults = [crosses, first, other, second, third];
        if faults.contains(&Some(true)) {
            Some(false)
        } else {
            faults.iter().all(|fault| *fault == Some(false)).then_some(true)
        }
    }
}

/// Whether the platform is level, for certain, at a solution of a machine with R1 = r1 within bounds of (y, w1) and of
/// a. The first of equations (A) is then 2 R1 sin(a/2) (w1 cos(a/2) - y sin(a/2)) = 0: where the second factor has no
/// zero, a is zero.
pub(super) fn is_level([y, w]: [Enclosure; 2], a: Enclosure) -> bool {
    let [c, s] = directions(a.times(0.5));
    !a.excludes_zero() && (w * c - y * s).excludes_zero()
}

/// Whether all numbers are positive; `None` if they are neither positive nor negative.
fn sign(numbers: Enclosure) -> Option<bool> {
    numbers.excludes_zero().then_some(numbers.low > 0.0)
}

impl Equations<4> for RodEquations<'_> {
    fn values(&self, [x, y, w, a]: &[f64; 4]) -> [Enclosure; 4] {
        let g = &self.mechanism.geometry;
        let rods = self.rods([*x, *y, *w].map(Enclosure::of), direction(*a));
        let lengths = [g.L1, g.L1, g.L2, g.L3];
        std::array::from_fn(|i| {
            let ([x, y, z], length) = (rods[i], Enclosure::of(lengths[i]));
            (x.square() + y.square() + (z - length) * (z + length)).times(0.5)
        })
    }

    fn slopes(&self, [x, y, w, a]: &[f64; 4], radii: &[f64; 4]) -> [[Enclosure; 4]; 4] {
        let place = [(x, radii[0]), (y, radii[1]), (w, radii[2])];
        let place = place.map(|(middle, radius)| Enclosure::of(*middle).widened(radius));
        let turn = turned_within(direction(*a), radii[3]);
        self.rows(&self.rods(place, turn), turn)
    }

    fn scales(&self) -> [f64; 4] {
        let longest = self.mechanism.longest;
        [longest, longest, longest, 1.0]
    }

    fn inverse(matrix: &[[f64; 4]; 4]) -> Option<[[f64; 4]; 4]> {
        parallel_matrix::inverse(matrix).map(|(_, inverse)| inverse)
    }
}

//! Leg I over a box.
//!
//! In the working mode, R1 cos a > r1 and w1 > |v|, the cubic's root is the one nearer to a = 0: with u² + v² = C - k
//! cos a the derivative H of y u + v w1 along a is w1 (u² + v²) / u + r1 (w1² - v²) / w1 > 0. The cubic falls with
//! X1² and with y². So cos a, w1 and w1 - |v| fall with both, and their extremes over a box are at the corner nearest
//! to X1 = y = 0 and at the furthest. The gradient of alpha follows from
//!
//! ```text
//! d(alpha)/dy = -1 / (w1 + r1 u (w1 - v²/w1) / (u² + v²))
//! d(alpha)/dx = -d(alpha)/dy · X1 u v / (w1 (u² + v²))
//! ```

use super::rectangle::Rectangle;
use crate::interval::Interval;
use crate::inverse::leg_one_cubic::LegOneCubic;
use crate::workspace::domain::Domain;

/// Least drop of a rod that counts as more than zero, over its length. The region of the domain that this neglects is
/// narrower than the rounding error of a position.
pub(super) const FLAT: f64 = 1e-7;

/// Leg I at the corner nearest to its guideway and at the furthest.
pub(super) struct LegOneBounds {
    /// cos alpha.
    pub(super) c: Interval,
    /// |sin alpha| and |alpha|.
    pub(super) s: Interval,
    pub(super) angle: Interval,
    pub(super) w: Interval,
    /// Whether leg I is in the working mode all over the box.
    pub(super) works_everywhere: bool,
}

impl LegOneBounds {
    /// The ranges over a box; `None` if leg I is nowhere in the working mode there.
    pub(super) fn over(domain: &Domain<'_>, [low, high]: Rectangle) -> Option<Self> {
        let (g, d) = (domain.machine.geometry(), &domain.machine.mechanism);
        let margin = domain.machine.limits().serial_margin * g.L1;
        let x = Interval::new(low[0] + d.e1, high[0] + d.e1);
        let y = Interval::new(low[1], high[1]);
        let nearest = |i: Interval| i.low.max(-i.high).max(0.0);
        let leg = |x: f64, y: f64| LegOneCubic::new(&domain.machine.mechanism, x - d.e1, y).nearest();
        let room = |w: f64, s: f64| w - g.R1 * s - margin;
        let slack = 1e-11 * d.longest;
        let near = leg(nearest(x), nearest(y))?;
        let near_s = near.s.abs();
        if g.R1 * near.c - g.r1 < -slack || room(near.w1, near_s) < -slack {
            return None;
        }
        let far = leg(x.magnitude(), y.magnitude());
        let far = far.filter(|far| g.R1 * far.c - g.r1 + d.crossing_reserve > 0.0);
        let works_everywhere = far.as_ref().is_some_and(|far| room(far.w1, far.s.abs()) > slack);
        let (far_c, far_s) = match &far {
            Some(far) => (far.c, far.s.abs()),
            None => (g.r1 / g.R1, ((g.R1 - g.r1) * (g.R1 + g.r1)).sqrt() / g.R1),
        };
        let far_w = far.as_ref().map_or(0.0, |far| far.w1);
        let far_w = if works_everywhere { far_w } else { far_w.max(margin + g.R1 * near_s) };
        let far_s = far_s.max(near_s);
        Some(Self {
            c: Interval::new(far_c.min(near.c), near.c),
            s: Interval::new(near_s, far_s),
            angle: Interval::new(near_s.atan2(near.c), far_s.atan2(far_c)),
            w: Interval::new(far_w.clamp(FLAT * g.L1, near.w1.max(FLAT * g.L1)), near.w1.max(FLAT * g.L1)),
            works_everywhere,
        })
    }

    /// d(alpha)/dx and d(alpha)/dy, given sin alpha and X1.
    pub(super) fn angle_rates(&self, domain: &Domain<'_>, s: Interval, x: Interval) -> [Interval; 2] {
        let (g, d) = (domain.machine.geometry(), &domain.machine.mechanism);
        if d.is_delta() {
            return [Interval::ZERO; 2];
        }
        let w = self.w;
        // 1 - cos a, from which u and u² + v² follow without cancellation where R1 is nearly r1.
        let bend = s.square() * self.c.plus(1.0).reciprocal();
        let u = bend.times(-g.R1).plus(g.R1 - g.r1).clamp(0.0, f64::INFINITY);
        let v = s.times(g.R1);
        let square = v.square();
        let arms = bend.times(d.k).plus(d.gap_square).reciprocal();
        let lead =
            Interval::new((w.low - square.high / w.low).max(0.0), (w.high - square.low / w.high).max(0.0));
        let turn = (w + (u * lead).times(g.r1) * arms).reciprocal();
        [turn * x * u * v * arms * w.reciprocal(), -turn]
    }
}

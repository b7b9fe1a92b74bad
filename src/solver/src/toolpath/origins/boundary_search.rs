//! The boundary of the region of origins along lines.

use super::membership::Membership;
use crate::pose::Point;
use crate::workspace::vector::length;

/// Searches along lines. Lengths are millimetres.
pub(super) struct BoundarySearch<'a> {
    pub(super) membership: &'a Membership<'a>,
    /// Greatest distance of the boundary that is found.
    pub(super) reach: f64,
    /// First step of a search.
    pub(super) step: f64,
    /// Greatest error of a place on the boundary.
    pub(super) precision: f64,
}

impl BoundarySearch<'_> {
    /// Whether the boundary is within a distance of a point, on the line along a unit vector. `hint` is that of
    /// [`Membership::contains`], here and below.
    pub(super) fn is_near(&self, at: Point, along: Point, distance: f64, hint: &mut usize) -> bool {
        let mut contains = |offset| self.membership.contains(moved(at, along, offset), hint);
        let below = contains(-distance);
        below != contains(distance) || below != contains(0.0)
    }

    /// The offset of the boundary from a point along a unit vector that leads out of the region: positive if the point
    /// is inside. `None` if the boundary is beyond the reach.
    pub(super) fn offset(&self, at: Point, outwards: Point, hint: &mut usize) -> Option<f64> {
        let is_inside = self.membership.contains(at, hint);
        let sign = if is_inside { 1.0 } else { -1.0 };
        let mut is_same =
            |offset: f64| self.membership.contains(moved(at, outwards, sign * offset), hint) == is_inside;
        let (mut same, mut other) = (0.0, self.step);
        while is_same(other) {
            (same, other) = (other, 2.0 * other);
            if other > self.reach {
                return None;
            }
        }
        while other - same > 2.0 * self.precision {
            let middle = 0.5 * (same + other);
            if is_same(middle) { same = middle } else { other = middle }
        }
        Some(sign * 0.5 * (same + other))
    }
}

/// A point at an offset from another one.
pub(super) fn moved(at: Point, along: Point, offset: f64) -> Point {
    std::array::from_fn(|i| at[i] + offset * along[i])
}

/// A vector with the length 1; `None` if it has no direction.
pub(super) fn unit(vector: Point) -> Option<Point> {
    let length = length(vector);
    (length > f64::MIN_POSITIVE).then(|| vector.map(|c| c / length))
}

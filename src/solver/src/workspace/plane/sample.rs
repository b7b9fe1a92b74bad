//! A point of the plane with its column and the values of all curves.

use crate::pose::Point;
use crate::workspace::column::Column;
use crate::workspace::domain::{Domain, LIMITS, Limit};

/// Curves that may cut the plane: the limits, then the creases of the two sheets.
pub(super) const CURVES: usize = LIMITS + 6;
/// First of the creases, two for each sheet: slider 1 against the others, then 2 against 3.
pub(super) const CREASES: usize = LIMITS;
/// First of the two creases between a sheet's sliders and the table.
pub(super) const TABLE_CREASES: usize = CREASES + 4;

/// A point, its column and the value of every curve's function there.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub(super) column: Column,
    pub(super) values: [f64; CURVES],
    /// Edges of the triangle being cut on which the point lies, a bit each.
    pub(super) border: u8,
}

impl Sample {
    pub(super) fn new(domain: &Domain<'_>, at: [f64; 2]) -> Self {
        let column = domain.column(at);
        let mut values = [0.0; CURVES];
        values[..LIMITS].copy_from_slice(&domain.values(&column));
        values[CREASES..].copy_from_slice(&creases(domain, &column));
        Self { column, values, border: 0 }
    }

    #[inline]
    pub(super) fn at(&self) -> [f64; 2] {
        [self.column.x, self.column.y]
    }

    /// The curves on which the point lies, a bit each.
    pub(super) fn on(&self) -> u64 {
        (0..CURVES).filter(|&curve| self.values[curve] == 0.0).fold(0, |on, curve| on | 1 << curve)
    }

    /// Whether the sheets meet here.
    pub(super) fn pinched(&self) -> bool {
        (0..LIMITS).any(|limit| self.values[limit] == 0.0 && Limit::ALL[limit].ends_columns())
    }

    /// The lower and the upper end of the column, as positions of the image.
    pub(super) fn ends(&self, domain: &Domain<'_>) -> [Point; 2] {
        ends(domain, &self.column, self.pinched())
    }

    /// The same for a point that is known to lie on a curve.
    pub(super) fn ends_on(domain: &Domain<'_>, at: [f64; 2], curve: usize) -> [Point; 2] {
        let pinched = Limit::ALL.get(curve).is_some_and(|limit| limit.ends_columns());
        ends(domain, &domain.column(at), pinched)
    }

    /// A total order of points.
    pub(super) fn precedes(&self, other: &Self) -> bool {
        let ([a, b], [c, d]) = (self.at(), other.at());
        a.total_cmp(&c).then(b.total_cmp(&d)).is_lt()
    }
}

fn ends(domain: &Domain<'_>, column: &Column, pinched: bool) -> [Point; 2] {
    let [low, high] = domain.ends(column);
    let [low, high] = if pinched { [0.5 * (low + high); 2] } else { [low, high] };
    [low, high].map(|z| domain.image.point(column, z))
}

/// One curve's function at a column.
pub(super) fn value(domain: &Domain<'_>, curve: usize, column: &Column) -> f64 {
    if curve < LIMITS { domain.value(curve, column) } else { creases(domain, column)[curve - CREASES] }
}

/// The functions of the creases. The lower sheet is slider 1's if the first is positive, else slider 2's if the
/// second is; the upper sheet likewise. If one of the last two is positive, the table binds the sheet instead.
fn creases(domain: &Domain<'_>, column: &Column) -> [f64; 6] {
    if domain.flat() {
        return [1.0, 1.0, 1.0, 1.0, -1.0, -1.0];
    }
    let ([a, b, c], [d, e, f]) = (domain.lows(column), domain.highs(column));
    let [lower, upper] = domain.table_creases(column);
    [a - b.max(c), b - c, e.min(f) - d, f - e, lower, upper]
}

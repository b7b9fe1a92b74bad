//! The ends of a column: which slider, or the table, bounds it on either side.

use super::Domain;
use super::limit::{Binding, stroke_binding};
use crate::workspace::column::Column;

/// The bound of columns on one side: the end of a slider's stroke, or the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::workspace) enum ColumnEnd {
    /// A slider, counted from 0.
    Slider(u8),
    /// The table's plane.
    Table,
}

impl ColumnEnd {
    /// All bounds, in the order of [`Domain::sheet`].
    pub(in crate::workspace) const ALL: [Self; 4] =
        [Self::Slider(0), Self::Slider(1), Self::Slider(2), Self::Table];

    /// Its index among the heights of [`Domain::sheet`].
    #[inline]
    pub(in crate::workspace) fn index(self) -> usize {
        match self {
            Self::Slider(slider) => usize::from(slider),
            Self::Table => 3,
        }
    }

    /// The bound that a sheet follows, given its height by each of them; the first of equal ones.
    #[inline]
    pub(in crate::workspace) fn binding([a, b, c, table]: [f64; 4], upper: bool) -> Self {
        let before = |a: f64, b: f64| if upper { a < b } else { a > b };
        let (first, height) = if before(b, a) { (Self::Slider(1), b) } else { (Self::Slider(0), a) };
        let (first, height) = if before(c, height) { (Self::Slider(2), c) } else { (first, height) };
        if before(table, height) { Self::Table } else { first }
    }
}

impl Domain<'_> {
    /// The lowest z of each slider's stroke at this column; their maximum is `z_lo`.
    #[inline]
    pub(in crate::workspace) fn lows(&self, column: &Column) -> [f64; 3] {
        let stroke = &self.machine.limits().stroke;
        std::array::from_fn(|i| stroke[i][0] + column.f[i])
    }

    /// The highest z of each slider's stroke at this column; their minimum is `z_hi`.
    #[inline]
    pub(in crate::workspace) fn highs(&self, column: &Column) -> [f64; 3] {
        let stroke = &self.machine.limits().stroke;
        std::array::from_fn(|i| stroke[i][1] + column.f[i])
    }

    /// One sheet's height by each bound, in the order of [`ColumnEnd::ALL`].
    #[inline]
    pub(in crate::workspace) fn sheet(&self, column: &Column, upper: bool) -> [f64; 4] {
        let [a, b, c] = if upper { self.highs(column) } else { self.lows(column) };
        [a, b, c, self.table_bound(column, upper)]
    }

    /// The constraint that binds a sheet.
    pub(in crate::workspace) fn sheet_binding(&self, end: ColumnEnd, high: bool) -> Binding {
        match end {
            ColumnEnd::Slider(slider) => stroke_binding(slider, high),
            ColumnEnd::Table => self.table_binding(),
        }
    }

    /// `z_lo` and `z_hi`, or twice the height at which a slice meets the column.
    #[inline]
    pub(in crate::workspace) fn ends(&self, column: &Column) -> [f64; 2] {
        if let Some(height) = self.height {
            return [self.image.z_at(column, height); 2];
        }
        self.above_table(column, self.stroke_ends(column))
    }

    /// The ends that the strokes leave of a column.
    #[inline]
    pub(super) fn stroke_ends(&self, column: &Column) -> [f64; 2] {
        let ([a, b, c], [d, e, f]) = (self.lows(column), self.highs(column));
        [a.max(b).max(c), d.min(e).min(f)]
    }
}

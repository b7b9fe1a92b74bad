//! The table's limits: its plane, and its tilting range as a limit of alpha.
//!
//! The plane bounds columns. For a fixed orientation of the tool the limit is a plane Z = const for the tool centre
//! point: the floor. Along a column Z is linear in the platform's z. So the floor is one more bound of the column:
//! from above, because z points down, and from below if theta1 is beyond a quarter turn.

use std::f64::consts::{PI, TAU};

use super::{Binding, Domain, SATISFIED};
use crate::limit::{Constraint, Element};
use crate::workspace::column::Column;

impl Domain<'_> {
    /// Height over the floor of the higher of the two ends that the strokes leave of a column.
    pub(in crate::workspace) fn height_over_table(&self, column: &Column) -> f64 {
        match self.heights_over_table(column) {
            Some([low, high]) => low.max(high),
            None => SATISFIED,
        }
    }

    /// Heights over the floor of the two ends that the strokes leave of a column. `None` without a floor, and for a
    /// slice, which is entirely above or entirely below it.
    #[inline]
    fn heights_over_table(&self, column: &Column) -> Option<[f64; 2]> {
        let level = self.floor_level()?;
        Some(self.stroke_ends(column).map(|z| self.image.point(column, z)[2] - level))
    }

    /// Least Z of the tool centre point; `None` if the table does not bound columns.
    #[inline]
    pub(in crate::workspace) fn floor_level(&self) -> Option<f64> {
        self.floor.filter(|_| !self.flat()).map(|floor| floor.least)
    }

    /// Whether the table may bound columns.
    #[inline]
    pub(in crate::workspace) fn table_bounds_columns(&self) -> bool {
        self.floor_level().is_some()
    }

    /// Two functions that are positive where the table binds the lower sheet, and the upper sheet, of columns in the
    /// domain.
    ///
    /// If theta1 is beyond a quarter turn, the lower end of a column is nearer to the table. The functions contain
    /// the other end's height so that they do not vanish along the domain's boundary, where an end lies on the floor.
    pub(in crate::workspace) fn table_creases(&self, column: &Column) -> [f64; 2] {
        match self.heights_over_table(column) {
            Some([low, high]) => [(high - low).min(-low), (low - high).min(-high)],
            None => [-1.0; 2],
        }
    }

    /// The portion of a column, given by the ends that the strokes leave, that is above the floor.
    #[inline]
    pub(super) fn above_table(&self, column: &Column, [low, high]: [f64; 2]) -> [f64; 2] {
        match self.heights_over_table(column) {
            // The height is linear along a column.
            Some([at_low, at_high]) if at_high < 0.0 && at_high < at_low => {
                [low, low + (high - low) * (at_low / (at_low - at_high))]
            }
            Some([at_low, at_high]) if at_low < 0.0 && at_low < at_high => {
                [high + (low - high) * (at_high / (at_high - at_low)), high]
            }
            _ => [low, high],
        }
    }

    /// The bound of a column by the floor on this side; infinite if the floor does not bound it there.
    #[inline]
    pub(super) fn table_bound(&self, column: &Column, upper: bool) -> f64 {
        match self.floor {
            Some(floor) if self.image.upright(column) == upper => self.image.z_at(column, floor.least),
            _ if upper => f64::INFINITY,
            _ => f64::NEG_INFINITY,
        }
    }

    /// The table as a binding constraint, with the element of the machine that is lowest.
    pub(super) fn table_binding(&self) -> Binding {
        let element = self.floor.map_or(Element::Tool, |floor| floor.element);
        Binding { constraint: Constraint::TableClearance, element }
    }

    /// The distance of theta1 from its least value, or from its greatest.
    pub(super) fn tilt(&self, high: bool, column: &Column) -> f64 {
        let alpha = column.alpha();
        let [a, b] = self.tilt_functions(high).map(|[slope, offset]| slope * alpha + offset);
        a.max(b)
    }

    /// A tilt limit as the greater of two linear functions of alpha, each a slope and an offset.
    ///
    /// In the working mode |alpha| is below a right angle. So at most two of the range's copies, a turn apart,
    /// matter: the copy whose middle is nearest to 0 and, for a range of more than half a turn, the copy on the other
    /// side of 0. The second copy joins the limit whose end is next to it, so that no limit jumps.
    pub(in crate::workspace) fn tilt_functions(&self, high: bool) -> [[f64; 2]; 2] {
        let Some([middle, half]) = self.alpha_range else { return [[0.0, SATISFIED]; 2] };
        let middle = middle - TAU * (middle / TAU).round();
        let copy = (middle.abs() + half > 1.5 * PI).then_some(middle - TAU.copysign(middle));
        let (above_least, below_greatest) = ([1.0, half - middle], [-1.0, half + middle]);
        match (high, copy) {
            (false, Some(copy)) if middle > 0.0 => [above_least, [-1.0, half + copy]],
            (true, Some(copy)) if middle <= 0.0 => [below_greatest, [1.0, half - copy]],
            (false, _) => [above_least; 2],
            (true, _) => [below_greatest; 2],
        }
    }
}

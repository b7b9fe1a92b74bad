//! The table's plane as a limit of columns.
//!
//! For a fixed orientation of the tool the limit is a plane Z = const for the tool centre point: the floor. Along a
//! column Z is linear in the platform's z. So the floor is one more bound of the column: from above, because z points
//! down, and from below if theta1 is beyond a quarter turn.

use super::{BY_TABLE, Binding, Domain, half_turn, stroke_binding};
use crate::limit::{Constraint, Element};
use crate::machine::Machine;
use crate::workspace::column::Column;
use crate::workspace::image::NOWHERE;
use crate::workspace::request::Request;

/// Least Z of the tool centre point, and which of tool and joints is lowest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor {
    pub(super) least: f64,
    element: Element,
}

impl Floor {
    /// The floor of a request, if the table is a limit.
    pub(super) fn new(machine: &Machine, request: &Request) -> Option<Self> {
        let clearance = request.clearance(machine)?;
        let (depth, element) = clearance.depth(machine, request.phi1);
        Some(Self { least: clearance.least + depth, element })
    }
}

impl Domain<'_> {
    /// Height over the floor of the higher of the two ends that the strokes leave of a column.
    pub(in super::super) fn above_table(&self, column: &Column) -> f64 {
        match self.heights(column) {
            Some([low, high]) => low.max(high),
            None => half_turn(),
        }
    }

    /// Heights over the floor of the two ends that the strokes leave of a column. `None` without a floor, and for a
    /// slice, which is entirely above or entirely below it.
    #[inline]
    fn heights(&self, column: &Column) -> Option<[f64; 2]> {
        let level = self.floor_level()?;
        Some(self.stroke_ends(column).map(|z| self.image.point(column, z)[2] - level))
    }

    /// Least Z of the tool centre point; `None` if the table does not bound columns.
    #[inline]
    pub(in super::super) fn floor_level(&self) -> Option<f64> {
        self.floor.filter(|_| !self.flat()).map(|floor| floor.least)
    }

    /// Whether the table may bind a sheet.
    #[inline]
    pub(in super::super) fn floored(&self) -> bool {
        self.floor_level().is_some()
    }

    /// Two functions that are positive where the table binds the lower sheet, and the upper sheet, of columns in the
    /// domain.
    ///
    /// If theta1 is beyond a quarter turn, the lower end of a column is nearer to the table. The functions contain
    /// the other end's height so that they do not vanish along the domain's boundary, where an end lies on the floor.
    pub(in super::super) fn floor_creases(&self, column: &Column) -> [f64; 2] {
        match self.heights(column) {
            Some([low, high]) => [(high - low).min(-low), (low - high).min(-high)],
            None => [-1.0; 2],
        }
    }

    /// The part of a column, given by the ends that the strokes leave, that is above the floor.
    #[inline]
    pub(super) fn above_floor(&self, column: &Column, [low, high]: [f64; 2]) -> [f64; 2] {
        match self.heights(column) {
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

    /// The bound of a column by the floor on this side; a value beyond every stroke if the floor does not bound it.
    #[inline]
    pub(super) fn table_bound(&self, column: &Column, upper: bool) -> f64 {
        match self.floor {
            Some(floor) if self.image.upright(column) == upper => self.image.z_at(column, floor.least),
            _ if upper => NOWHERE,
            _ => -NOWHERE,
        }
    }

    /// The constraint that binds a sheet, by its number.
    pub(in super::super) fn sheet_binding(&self, number: u8, high: bool) -> Binding {
        if number == BY_TABLE { self.floor_binding() } else { stroke_binding(number, high) }
    }

    pub(super) fn floor_binding(&self) -> Binding {
        let element = self.floor.map_or(Element::Tool, |floor| floor.element);
        Binding { constraint: Constraint::TableClearance, element }
    }
}

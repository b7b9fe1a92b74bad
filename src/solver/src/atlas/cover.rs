//! Boxes that cover all configurations near a curve, and points on all of its components.
//!
//! A box is a range of two coordinates t and θ (see [`super::chart`]), and a side of each of legs II and III:
//! above, below, or both where the leg may be level in the box. It is dropped if an equation has no zero in it. It is
//! halved until one component of the curve's tangent has the same sign all over it. Then no closed curve lies inside
//! it, so each component of the curve crosses edges of boxes, where [`super::edges`] finds it. Boxes whose image is
//! smaller than the tolerance are not halved; only within one of them may a component be hidden.

use std::f64::consts::PI;

use super::enclosure::Enclosure;
use super::place::Configuration;
use super::request::AtlasError;
use super::search::{Cell, Found, LegSide, MOST, Search};
use super::target::Target;
use crate::interval::Interval;
use crate::workspace::Observer;

/// Boxes along φ and θ at the start.
const START: [u32; 2] = [4, 8];
/// By how much edges are off the planes of symmetry, on which whole curves may lie.
const SHIFT: f64 = 0.0618;
/// Boxes between two questions to the observer.
const ASK: usize = 1024;

impl Search<'_> {
    /// Points of the curve, at least one on each component whose image in the window is larger than the tolerance.
    pub(super) fn points(&self, observer: &dyn Observer) -> Result<Vec<Configuration>, AtlasError> {
        let mut cells = self.first_cells();
        let (mut found, mut count) = (Found::default(), 0);
        while let Some(cell) = cells.pop() {
            count += 1;
            if count > MOST || found.examined > MOST {
                return Err(AtlasError::TooFine { near: None });
            }
            if count % ASK == 0 && observer.cancelled() {
                return Err(AtlasError::Cancelled);
            }
            let Some(enclosure) = Enclosure::of(self, &cell) else { continue };
            let size = enclosure.image_size();
            let is_settled = enclosure.tangent_has_a_sign() && 4.0 * size <= self.window_side();
            if is_settled || size < self.tolerance {
                self.edges(&cell, &mut found);
            } else {
                cells.extend(self.halves(&cell, &enclosure).into_iter().flatten());
            }
        }
        Ok(found.points)
    }

    fn window_side(&self) -> f64 {
        self.window.iter().map(|range| range.high - range.low).fold(0.0, f64::max)
    }

    fn first_cells(&self) -> Vec<Cell> {
        let parts = |range: Interval, count: u32| {
            let step = (range.high - range.low) / f64::from(count);
            let end = move |i: u32| match i {
                0 => range.low,
                i if i == count => range.high,
                i => range.low + step * (f64::from(i) + SHIFT),
            };
            (0..count).map(move |i| Interval::new(end(i), end(i + 1)))
        };
        let side = |target| if self.system.target == target { LegSide::Level } else { LegSide::Either };
        let sides = [side(Target::LegTwo), side(Target::LegThree)];
        let [columns, rows] = START;
        let turn = Interval::around(PI).plus(SHIFT);
        parts(self.chart.range, columns)
            .flat_map(|t| parts(turn, rows).map(move |theta| Cell { ranges: [t, theta], sides }))
            .collect()
    }

    /// The halves of a box, or the box for both sides of a leg that is not level in it.
    fn halves(&self, cell: &Cell, enclosure: &Enclosure) -> [Option<Cell>; 2] {
        for leg in 0..2 {
            if cell.sides[leg] == LegSide::Either && enclosure.height_squares[leg].low > 0.0 {
                let with = |side: LegSide| {
                    let mut sides = cell.sides;
                    sides[leg] = side;
                    Cell { sides, ..*cell }
                };
                let below = (!self.above_only[leg]).then(|| with(LegSide::Below));
                return [Some(with(LegSide::Above)), below];
            }
        }
        let axis = enclosure.axis();
        cell.halved(axis).map(Some)
    }

    /// Points on the edges of a box that bound it from above. The neighbours' edges bound it from below.
    fn edges(&self, cell: &Cell, found: &mut Found) {
        for axis in 0..2 {
            let mut edge = *cell;
            edge.ranges[axis] = Interval::of(cell.ranges[axis].high);
            self.edge(&edge, axis, 0, found);
        }
    }
}

//! The plane domain: every limit as a function of (x, y), zero on the limit and positive inside.

mod floor;

use std::f64::consts::{PI, TAU};

use super::column::Column;
use super::image::Image;
use super::request::{Kind, Request};
use crate::inverse::leg_one_cubic::LegOneCubic;
use crate::limit::{Constraint, Element};
use crate::machine::Machine;
use crate::margins::cone::Columns;
use crate::margins::interference;
use crate::parallel_matrix::{determinant, matrix};
use crate::rods::Rods;
use crate::table::table_angles;
use floor::Floor;

/// Number of limits.
pub(super) const LIMITS: usize = 27;
/// First of the limits for rod distances: of leg I's rods, of a parallelogram's rods, between legs.
pub(super) const INTERFERENCE: usize = 15;
/// First of the limits for the strokes.
pub(super) const STROKES: usize = 18;
/// First of the two limits for the table's tilt.
pub(super) const TILT: usize = 24;
/// The limit for the table's plane.
pub(super) const TABLE: usize = 26;
/// The table's number among the bounds of a sheet, after the three sliders.
pub(super) const BY_TABLE: u8 = 3;
/// Pairs of sliders (i, j): `z_hi` of slider i over `z_lo` of slider j.
pub(super) const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];
const RODS: [u8; 4] = [11, 12, 21, 31];

/// The constraint that bounds a piece of the workspace, and the part of the machine that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Binding {
    /// The constraint.
    pub constraint: Constraint,
    /// The part of the machine.
    pub element: Element,
}

/// All limits' values at a point.
pub(super) type Values = [f64; LIMITS];

/// The domain of one request: the (x, y) with columns, or those whose columns meet a plane of the image's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Domain<'a> {
    pub(super) machine: &'a Machine,
    pub(super) image: Image,
    /// The plane, for a slice.
    pub(super) height: Option<f64>,
    /// Squared chords of the cones' half-angles at the sliders and at the platform.
    pub(super) chords: [f64; 2],
    /// Middle and half of the tilting range, shifted by phi1 so that it applies to alpha.
    tilt: Option<[f64; 2]>,
    /// The table's plane, if it is a limit.
    floor: Option<Floor>,
    /// Whether the domain is empty because the constant rotary angle is out of its range, or because a slice lies
    /// below the floor.
    pub(super) empty: bool,
}

impl<'a> Domain<'a> {
    pub(super) fn new(machine: &'a Machine, request: &Request, height: Option<f64>) -> Self {
        let limits = machine.limits();
        let chord = |angle: f64| 4.0 * (0.5 * angle).sin().powi(2);
        let part = request.kind == Kind::Part;
        let [low, high] = limits.tilt;
        let half = 0.5 * (high - low);
        let theta2 = table_angles(machine, 0.0, request.phi1, request.phi2).theta2;
        let floor = Floor::new(machine, request);
        let below = floor.zip(height).is_some_and(|(floor, height)| height < floor.least);
        Self {
            machine,
            image: Image::new(machine, request),
            height,
            chords: [chord(limits.slider_cone), chord(limits.platform_cone)],
            tilt: (part && half < PI).then_some([low + half + request.phi1, half]),
            floor,
            empty: below || part && !(limits.rotary[0]..=limits.rotary[1]).contains(&theta2),
        }
    }

    #[inline]
    pub(super) fn column(&self, at: [f64; 2]) -> Column {
        Column::at(self.machine, at)
    }

    /// All limits at a column.
    pub(super) fn values(&self, column: &Column) -> Values {
        let rods = self.rods(column);
        let mut values = std::array::from_fn(|limit| {
            if (INTERFERENCE..STROKES).contains(&limit) { 0.0 } else { self.with_rods(limit, column, &rods) }
        });
        let g = self.machine.geometry();
        let distances = interference::least_distances_by_legs(g, &rods);
        values[INTERFERENCE..STROKES].copy_from_slice(&distances.map(|d| d - 2.0 * g.rod_radius));
        values
    }

    /// One limit at a column.
    pub(super) fn value(&self, limit: usize, column: &Column) -> f64 {
        self.with_rods(limit, column, &self.rods(column))
    }

    #[inline]
    pub(super) fn rods(&self, column: &Column) -> Rods {
        let d = &self.machine.mechanism;
        let x = [column.x + d.e1, column.x + d.e2];
        Rods::new(self.machine.geometry(), &d.inverse_lengths, x, column.y, column.f, [column.c, column.s])
    }

    #[inline]
    pub(super) fn with_rods(&self, limit: usize, column: &Column, rods: &Rods) -> f64 {
        let (g, home, limits) = (self.machine.geometry(), &self.machine.home, self.machine.limits());
        match limit {
            0 => LegOneCubic::new(&self.machine.mechanism, column.x, column.y).closing_margin(),
            1 => g.R1 * column.c - g.r1,
            2 | 3 => rods.vectors[limit - 2][2] - limits.serial_margin * g.L1,
            4 => column.square[1] - (limits.serial_margin * g.L2).powi(2),
            5 => column.square[2] - (limits.serial_margin * g.L3).powi(2),
            6 => determinant(&matrix(g, rods)) * home.det.signum() - limits.parallel_margin,
            7..=10 => self.chords[0] - chord(axis(&home.slider_axes, limit - 7), rods.directions[limit - 7]),
            11..=14 => {
                let [x, y, z] = rods.directions[limit - 11];
                let (c, s) = (rods.c, rods.s);
                self.chords[1]
                    - chord(axis(&home.platform_axes, limit - 11), [x, c * y + s * z, c * z - s * y])
            }
            INTERFERENCE..STROKES => {
                interference::least_distances_by_legs(g, rods)[limit - INTERFERENCE] - 2.0 * g.rod_radius
            }
            STROKES..TILT => self.stroke(limit - STROKES, column),
            TILT..TABLE => self.tilt(limit - TILT, column),
            _ => self.above_table(column),
        }
    }

    /// For columns, the height of slider i's highest end over slider j's lowest. For a slice, the distances from the
    /// ends of the strokes.
    #[inline]
    fn stroke(&self, number: usize, column: &Column) -> f64 {
        let stroke = &self.machine.limits().stroke;
        match self.height {
            None => {
                let (i, j) = PAIRS[number];
                (stroke[i][1] + column.f[i]) - (stroke[j][0] + column.f[j])
            }
            Some(height) => {
                let (slider, end) = (number / 2, number % 2);
                let rho = self.image.z_at(column, height) - column.f[slider];
                let over = rho - stroke[slider][end];
                if end == 0 { over } else { -over }
            }
        }
    }

    /// Middle and half of the range of alpha that the tilting range allows; `None` for a whole turn.
    pub(super) fn tilted(&self) -> Option<[f64; 2]> {
        self.tilt
    }

    /// The distance of theta1 from its least value, or from its greatest.
    fn tilt(&self, end: usize, column: &Column) -> f64 {
        let alpha = column.alpha();
        let [a, b] = self.tilt_pieces(end).map(|[sign, offset]| sign * alpha + offset);
        a.max(b)
    }

    /// A tilt limit as the greater of two linear functions of alpha, each a slope and an offset.
    ///
    /// In the working mode |alpha| is below a right angle. So at most two of the range's copies, a turn apart,
    /// matter: the copy whose middle is nearest to 0 and, for a range of more than half a turn, the copy on the other
    /// side of 0. The second copy joins the limit whose end is next to it, so that no limit jumps.
    pub(super) fn tilt_pieces(&self, end: usize) -> [[f64; 2]; 2] {
        let Some([middle, half]) = self.tilt else { return [[0.0, half_turn()]; 2] };
        let middle = middle - TAU * (middle / TAU).round();
        let copy = (middle.abs() + half > 1.5 * PI).then_some(middle - TAU.copysign(middle));
        let (low, high) = ([1.0, half - middle], [-1.0, half + middle]);
        match (end, copy) {
            (0, Some(copy)) if middle > 0.0 => [low, [-1.0, half + copy]],
            (1, Some(copy)) if middle <= 0.0 => [high, [1.0, half - copy]],
            (0, _) => [low; 2],
            _ => [high; 2],
        }
    }

    /// The lowest z of each slider's stroke at this column; their maximum is `z_lo`.
    #[inline]
    pub(super) fn lows(&self, column: &Column) -> [f64; 3] {
        let stroke = &self.machine.limits().stroke;
        std::array::from_fn(|i| stroke[i][0] + column.f[i])
    }

    /// The highest z of each slider's stroke at this column; their minimum is `z_hi`.
    #[inline]
    pub(super) fn highs(&self, column: &Column) -> [f64; 3] {
        let stroke = &self.machine.limits().stroke;
        std::array::from_fn(|i| stroke[i][1] + column.f[i])
    }

    /// The binding constraint of a limit at a point on it, with the two rods that are nearest there.
    pub(super) fn binding_at(&self, limit: u8, at: [f64; 2]) -> Binding {
        if usize::from(limit) == TABLE {
            return self.floor_binding();
        }
        let found = binding(limit);
        if found.constraint != Constraint::RodInterference {
            return found;
        }
        let (_, [a, b]) = interference::least_distance(self.machine.geometry(), &self.rods(&self.column(at)));
        Binding { element: Element::Rods(a, b), ..found }
    }

    /// One sheet's height by each slider's end of stroke, and by the table.
    #[inline]
    pub(super) fn sheet(&self, column: &Column, upper: bool) -> [f64; 4] {
        let [a, b, c] = if upper { self.highs(column) } else { self.lows(column) };
        [a, b, c, self.table_bound(column, upper)]
    }

    /// The slider, or the table, that binds the sheet; the first of equal ones.
    #[inline]
    pub(super) fn binding_slider([a, b, c, table]: [f64; 4], upper: bool) -> usize {
        let before = |a: f64, b: f64| if upper { a < b } else { a > b };
        let (first, height) = if before(b, a) { (1, b) } else { (0, a) };
        let (first, height) = if before(c, height) { (2, c) } else { (first, height) };
        if before(table, height) { usize::from(BY_TABLE) } else { first }
    }

    /// `z_lo` and `z_hi`, or twice the height at which a slice meets the column.
    #[inline]
    pub(super) fn ends(&self, column: &Column) -> [f64; 2] {
        if let Some(height) = self.height {
            return [self.image.z_at(column, height); 2];
        }
        self.above_floor(column, self.stroke_ends(column))
    }

    /// The ends that the strokes leave of a column.
    #[inline]
    fn stroke_ends(&self, column: &Column) -> [f64; 2] {
        let ([a, b, c], [d, e, f]) = (self.lows(column), self.highs(column));
        [a.max(b).max(c), d.min(e).min(f)]
    }

    /// Whether columns are cut by one plane and have no extent.
    #[inline]
    pub(super) fn flat(&self) -> bool {
        self.height.is_some()
    }

    /// A rectangle, `[least, greatest]`, that contains the domain: no leg reaches beyond it.
    pub(super) fn rectangle(&self) -> [[f64; 2]; 2] {
        let (g, d) = (self.machine.geometry(), &self.machine.mechanism);
        let second = g.L2.min(g.L3);
        let least = (-d.e1 - g.L1).max(-d.e2 - second);
        let greatest = (g.L1 - d.e1).min(second - d.e2);
        // |y - p| ≤ L2 and |y + p| ≤ L3: their sum bounds y. Leg I: y² ≤ L1² - (R1 - r1)².
        let half = g.L1.min(0.5 * (g.L2 + g.L3));
        [[least, -half], [greatest, half]]
    }
}

/// The value of a limit that is never violated.
const fn half_turn() -> f64 {
    PI
}

/// One axis of four that are stored by coordinate.
#[inline]
fn axis([x, y, z]: &Columns, i: usize) -> [f64; 3] {
    [x[i], y[i], z[i]]
}

#[inline]
fn chord(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum()
}

/// The binding constraint of a limit, with strokes as in a slice. The nearest rods need a column: see
/// [`Domain::binding_at`].
pub(super) fn binding(limit: u8) -> Binding {
    let limit = usize::from(limit);
    let number = limit.saturating_sub(STROKES);
    let slider = u8::try_from(number / 2 + 1).unwrap_or(1);
    let (constraint, element) = match limit {
        0 => (Constraint::LegLength, Element::Leg(1)),
        1 => (Constraint::RodCrossing, Element::Leg(1)),
        2..=5 => (Constraint::SerialSingularity, Element::Rod(RODS[limit - 2])),
        6 => (Constraint::ParallelSingularity, Element::Platform),
        7..=10 => (Constraint::SliderJoint, Element::Rod(RODS[limit - 7])),
        11..=14 => (Constraint::PlatformJoint, Element::Rod(RODS[limit - 11])),
        INTERFERENCE..STROKES => (Constraint::RodInterference, Element::Platform),
        STROKES..TILT => (Constraint::Stroke, Element::Stroke { slider, high: number % 2 == 1 }),
        _ => (Constraint::Tilt, Element::Range { high: limit > TILT }),
    };
    Binding { constraint, element }
}

/// A sheet's binding constraint: the end of a slider's stroke, sliders counted from 0.
pub(super) fn stroke_binding(slider: u8, high: bool) -> Binding {
    Binding { constraint: Constraint::Stroke, element: Element::Stroke { slider: slider + 1, high } }
}

//! The plane domain: every limit as a function of (x, y), zero on the limit and positive inside.

mod column_end;
mod limit;
mod table;

pub(super) use column_end::ColumnEnd;
pub use limit::Binding;
pub(super) use limit::{LIMITS, Limit, LimitSet, RodPairs, SLIDER_PAIRS, stroke_binding};

use std::f64::consts::PI;

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

/// The function of a limit that does not apply: a positive constant.
const SATISFIED: f64 = 1.0;

/// Least Z of the tool centre point, and which of tool and joints is lowest.
#[derive(Clone, Copy, Debug)]
struct Floor {
    least: f64,
    element: Element,
}

impl Floor {
    /// The floor of a request, if the table is a limit.
    fn new(machine: &Machine, request: &Request) -> Option<Self> {
        let clearance = request.clearance(machine)?;
        let (depth, element) = clearance.depth(machine, request.phi1);
        Some(Self { least: clearance.least + depth, element })
    }
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
    /// Middle and half of the tilting range, shifted by phi1 so that it applies to alpha; `None` for a whole turn.
    pub(super) alpha_range: Option<[f64; 2]>,
    /// The table's plane, if it is a limit.
    floor: Option<Floor>,
    /// Cones that contain other cones everywhere: with R1 = r1 the platform does not turn, and leg I's rods are
    /// parallel. Their limits never bind. Two limits that vanish together would leave the cover undecided.
    implied: LimitSet,
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
            alpha_range: (part && half < PI).then_some([low + half + request.phi1, half]),
            floor,
            implied: implied_cones(machine),
            empty: below || part && limits.rotary.is_some_and(|[low, high]| !(low..=high).contains(&theta2)),
        }
    }

    #[inline]
    pub(super) fn column(&self, at: [f64; 2]) -> Column {
        Column::at(self.machine, at)
    }

    /// All limits at a column.
    pub(super) fn values(&self, column: &Column) -> Values {
        let rods = self.rods(column);
        let g = self.machine.geometry();
        let distances = interference::least_distances_by_legs(&self.machine.mechanism, &rods);
        let mut values = Limit::ALL.map(|limit| match limit {
            Limit::RodDistance(pairs) => distances[pairs as usize] - 2.0 * g.rod_radius,
            _ => self.with_rods(limit, column, &rods),
        });
        if self.implied != 0 {
            for number in (0..LIMITS).filter(|number| self.is_implied(*number)) {
                values[number] = self.machine.mechanism.longest;
            }
        }
        values
    }

    /// Whether another limit implies a limit, by its number.
    #[inline]
    pub(super) fn is_implied(&self, limit: usize) -> bool {
        self.implied & (1 << limit) != 0
    }

    /// One limit at a column, by its number.
    pub(super) fn value(&self, limit: usize, column: &Column) -> f64 {
        if self.is_implied(limit) {
            return self.machine.mechanism.longest;
        }
        self.with_rods(Limit::ALL[limit], column, &self.rods(column))
    }

    #[inline]
    pub(super) fn rods(&self, column: &Column) -> Rods {
        let d = &self.machine.mechanism;
        let x = [column.x + d.e1, column.x + d.e2];
        Rods::new(self.machine.geometry(), &d.inverse_lengths, x, column.y, column.f, [column.c, column.s])
    }

    /// One limit at a column, given its rods.
    #[inline]
    pub(super) fn with_rods(&self, limit: Limit, column: &Column, rods: &Rods) -> f64 {
        let (g, home, limits) = (self.machine.geometry(), &self.machine.home, self.machine.limits());
        match limit {
            Limit::LegOneReach => {
                LegOneCubic::new(&self.machine.mechanism, column.x, column.y).closing_margin()
            }
            Limit::LegOneCrossing => g.R1 * column.c - g.r1 + self.machine.mechanism.crossing_reserve,
            Limit::LegOneSerial(rod) => rods.vectors[usize::from(rod)][2] - limits.serial_margin * g.L1,
            Limit::LegSerial(leg) => {
                let (length, square) =
                    if leg == 2 { (g.L2, column.square[1]) } else { (g.L3, column.square[2]) };
                square - (limits.serial_margin * length).powi(2)
            }
            Limit::ParallelSingularity => {
                determinant(&matrix(g, rods)) * home.det.signum() - limits.parallel_margin
            }
            Limit::SliderCone(rod) => {
                let rod = usize::from(rod);
                self.chords[0] - chord(axis(&home.slider_axes, rod), rods.directions[rod])
            }
            Limit::PlatformCone(rod) => {
                let rod = usize::from(rod);
                let [x, y, z] = rods.directions[rod];
                let (c, s) = (rods.c, rods.s);
                self.chords[1] - chord(axis(&home.platform_axes, rod), [x, c * y + s * z, c * z - s * y])
            }
            Limit::RodDistance(pairs) => {
                interference::least_distances_by_legs(&self.machine.mechanism, rods)[pairs as usize]
                    - 2.0 * g.rod_radius
            }
            Limit::Stroke(number) => self.stroke(usize::from(number), column),
            Limit::Tilt { high } => self.tilt(high, column),
            Limit::TablePlane => self.height_over_table(column),
        }
    }

    /// For columns, the height of slider i's highest end over slider j's lowest. For a slice, the distances from the
    /// ends of the strokes.
    #[inline]
    fn stroke(&self, number: usize, column: &Column) -> f64 {
        let stroke = &self.machine.limits().stroke;
        match self.height {
            None => {
                let (i, j) = SLIDER_PAIRS[number];
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

    /// The binding constraint of a limit at a point on it, with the two rods that are nearest there.
    pub(super) fn binding_at(&self, limit: Limit, at: [f64; 2]) -> Binding {
        match limit {
            Limit::TablePlane => self.table_binding(),
            Limit::RodDistance(_) => {
                let rods = self.rods(&self.column(at));
                let (_, [a, b]) = interference::least_distance(&self.machine.mechanism, &rods);
                Binding { constraint: Constraint::RodInterference, element: Element::Rods(a, b) }
            }
            _ => limit.binding(),
        }
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

/// The cones that are implied by another with the same axis, the same direction of the rod, and a half-angle that is
/// not greater.
fn implied_cones(machine: &Machine) -> LimitSet {
    if !machine.mechanism.is_delta() {
        return 0;
    }
    let (home, limits) = (&machine.home, machine.limits());
    let cone = |limit: Limit| match limit {
        Limit::SliderCone(rod) => Some((rod, axis(&home.slider_axes, usize::from(rod)), limits.slider_cone)),
        Limit::PlatformCone(rod) => {
            Some((rod, axis(&home.platform_axes, usize::from(rod)), limits.platform_cone))
        }
        _ => None,
    };
    // Rods 11 and 12 are parallel.
    let family = |rod: u8| rod.max(1);
    let cones: Vec<_> = Limit::ALL.iter().filter_map(|limit| Some((*limit, cone(*limit)?))).collect();
    Limit::set(|limit| {
        cones.iter().position(|(other, _)| *other == limit).is_some_and(|i| {
            let (rod, own, angle) = cones[i].1;
            cones.iter().enumerate().any(|(j, (_, (other_rod, other, other_angle)))| {
                let within = *other_angle < angle || (*other_angle == angle && j < i);
                family(rod) == family(*other_rod) && own == *other && within
            })
        })
    })
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

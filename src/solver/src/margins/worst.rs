//! The worst of all margins. Each margin is divided by its constraint's own range.

use super::posture_margins::{Margins, range_margins};
use crate::fast_math::lesser;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::TableAngles;

/// The rod that represents each family.
pub(super) const FAMILY_ROD: [Element; 4] =
    [Element::Rod(11), Element::Rod(12), Element::Rod(21), Element::Rod(31)];

/// The least number and its index.
#[inline]
pub(super) fn least(margins: &[f64]) -> (usize, f64) {
    let mut found = (0, f64::INFINITY);
    for (i, &margin) in margins.iter().enumerate() {
        if margin < found.1 {
            found = (i, margin);
        }
    }
    found
}

/// The worst margin so far, and its fraction of its constraint's range.
pub(super) struct WorstMargin {
    pub(super) margin: Margin,
    pub(super) fraction: f64,
}

impl WorstMargin {
    /// The worst of crossed rods, strokes and the table's ranges.
    #[inline]
    pub(super) fn of_strokes(
        machine: &Machine,
        rod_crossing: Option<f64>,
        rho: [f64; 3],
        table: Option<TableAngles>,
    ) -> Self {
        let limits = machine.limits();
        let mut worst = Self::new(rod_crossing, machine.normalization.rod_crossing);
        worst.compare_strokes(machine, &[0, 1, 2].map(|i| range_margins(limits.stroke[i], rho[i])));
        if let Some(TableAngles { theta1, theta2 }) = table {
            let tilt = range_margins(limits.tilt, theta1);
            let rotary = limits.rotary.map(|range| range_margins(range, theta2));
            each_range(machine, Some(tilt), rotary, &mut |constraint, element, value, factor| {
                worst.compare(constraint, element, value, factor);
            });
        }
        worst
    }

    /// The worst of all margins.
    pub(super) fn of(machine: &Machine, margins: &Margins) -> Self {
        let mut worst = Self::new(margins.rod_crossing, machine.normalization.rod_crossing);
        each_margin(machine, margins, |constraint, element, value, factor| {
            worst.compare(constraint, element, value, factor);
        });
        worst
    }

    /// The worst margin including that of the table's plane, if it is checked.
    #[inline]
    pub(super) fn with_clearance(mut self, machine: &Machine, clearance: Option<Margin>) -> Self {
        if let Some(Margin { constraint, element, value }) = clearance {
            self.compare(constraint, element, value, machine.normalization.table_clearance);
        }
        self
    }

    /// Starts with the margin of crossed rods. Any other margin is worse than one that is no limit.
    #[inline]
    pub(super) fn new(rod_crossing: Option<f64>, factor: f64) -> Self {
        let (constraint, element) = (Constraint::RodCrossing, Element::Leg(1));
        let rod_crossing = rod_crossing.unwrap_or(f64::INFINITY);
        let margin = Margin { constraint, element, value: rod_crossing };
        Self { margin, fraction: rod_crossing * factor }
    }

    #[inline]
    pub(super) fn compare(&mut self, constraint: Constraint, element: Element, value: f64, factor: f64) {
        let fraction = value * factor;
        if fraction < self.fraction {
            *self = Self { margin: Margin { constraint, element, value }, fraction };
        }
    }

    /// Compares without branches, because their outcomes are unpredictable.
    #[inline]
    fn compare_strokes(&mut self, machine: &Machine, stroke: &[[f64; 2]; 3]) {
        let factors = &machine.normalization.stroke;
        let values = stroke.map(|[low, high]| lesser(low, high));
        let fractions: [f64; 3] = std::array::from_fn(|i| values[i] * factors[i]);
        let (first, least) = (usize::from(fractions[1] < fractions[0]), lesser(fractions[0], fractions[1]));
        let i = if fractions[2] < least { 2 } else { first };
        if fractions[i] < self.fraction {
            let (slider, high) = ([1, 2, 3][i], stroke[i][1] < stroke[i][0]);
            let (constraint, element) = (Constraint::Stroke, Element::Stroke { slider, high });
            *self = Self { margin: Margin { constraint, element, value: values[i] }, fraction: fractions[i] };
        }
    }
}

/// Calls `found` with the margins of every constraint but crossed rods and with their factors: of every slider and leg,
/// and the least one of rods and of ends of a range.
#[inline]
fn each_margin(machine: &Machine, margins: &Margins, mut found: impl FnMut(Constraint, Element, f64, f64)) {
    let factors = &machine.normalization;
    each_length(machine, &margins.stroke, &margins.leg_length, &mut found);
    let families = [
        (Constraint::SerialSingularity, &margins.serial_singularity, factors.serial_singularity),
        (Constraint::SliderJoint, &margins.slider_joint, factors.slider_joint),
        (Constraint::PlatformJoint, &margins.platform_joint, factors.platform_joint),
    ];
    for (constraint, margins, factor) in families {
        let (family, value) = least(margins);
        found(constraint, FAMILY_ROD[family], value, factor);
    }
    let (det, gap) = (margins.parallel_singularity, margins.rod_interference);
    found(Constraint::ParallelSingularity, Element::Platform, det, factors.parallel_singularity);
    let [a, b] = margins.nearest_rods;
    found(Constraint::RodInterference, Element::Rods(a, b), gap, factors.rod_interference);
    each_range(machine, margins.tilt, margins.rotary, &mut found);
    if let Some(Margin { constraint, element, value }) = margins.table_clearance {
        found(constraint, element, value, factors.table_clearance);
    }
}

/// The same for sliders and legs.
#[inline]
pub(super) fn each_length(
    machine: &Machine,
    stroke: &[[f64; 2]; 3],
    leg_length: &[f64; 3],
    found: &mut impl FnMut(Constraint, Element, f64, f64),
) {
    let factors = &machine.normalization;
    for (slider, (ends, factor)) in (1..).zip(stroke.iter().zip(factors.stroke)) {
        let element = Element::Stroke { slider, high: ends[1] < ends[0] };
        found(Constraint::Stroke, element, lesser(ends[0], ends[1]), factor);
    }
    for (leg, (value, factor)) in (1..).zip(leg_length.iter().zip(factors.leg_length)) {
        found(Constraint::LegLength, Element::Leg(leg), *value, factor);
    }
}

/// The same for the table's ranges.
#[inline]
pub(super) fn each_range(
    machine: &Machine,
    tilt: Option<[f64; 2]>,
    rotary: Option<[f64; 2]>,
    found: &mut impl FnMut(Constraint, Element, f64, f64),
) {
    let factors = &machine.normalization;
    let ranges = [(Constraint::Tilt, tilt, factors.tilt), (Constraint::Rotary, rotary, factors.rotary)];
    for (constraint, ends, factor) in ranges {
        if let Some(ends) = ends {
            let (end, value) = least(&ends);
            found(constraint, Element::Range { high: end == 1 }, value, factor);
        }
    }
}

impl Margin {
    /// The margin as a fraction of its constraint's own range (stroke, rod length, cone half-angle, value at home,
    /// ...): by it, margins of different units compare.
    ///
    /// ```
    /// use verne_solver::{Constraint, Element, Machine, Margin};
    ///
    /// let element = Element::Stroke { slider: 2, high: false };
    /// let margin = Margin { constraint: Constraint::Stroke, element, value: 75.0 };
    /// assert!((margin.fraction(&Machine::verne()) - 0.1).abs() < 1e-15);
    /// ```
    pub fn fraction(&self, machine: &Machine) -> f64 {
        let factors = &machine.normalization;
        let of = |number: u8, factors: &[f64; 3]| {
            let index = usize::from(number.saturating_sub(1));
            factors[index.min(2)]
        };
        let factor = match (self.constraint, self.element) {
            (Constraint::Stroke, Element::Stroke { slider, .. }) => of(slider, &factors.stroke),
            (Constraint::Stroke, _) => factors.stroke[0],
            (Constraint::LegLength, Element::Leg(leg)) => of(leg, &factors.leg_length),
            (Constraint::LegLength, _) => factors.leg_length[0],
            (Constraint::SerialSingularity, _) => factors.serial_singularity,
            (Constraint::ParallelSingularity, _) => factors.parallel_singularity,
            (Constraint::SliderJoint, _) => factors.slider_joint,
            (Constraint::PlatformJoint, _) => factors.platform_joint,
            (Constraint::RodCrossing, _) => factors.rod_crossing,
            (Constraint::RodInterference, _) => factors.rod_interference,
            (Constraint::Tilt, _) => factors.tilt,
            (Constraint::Rotary, _) => factors.rotary,
            (Constraint::TableClearance, _) => factors.table_clearance,
        };
        self.value * factor
    }
}

impl Margins {
    /// Finds the worst margin. Margins are compared as fractions of their constraint's own range (stroke, rod length,
    /// cone half-angle, value at home, ...), so that lengths and angles compare.
    ///
    /// # Units
    ///
    /// `value` of the answer has the unit of its constraint: mm, rad, or none.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A; the comparison
    /// is ours.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::{Constraint, KinematicsError, Machine, Margins, platform_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [0.0, 0.0, 600.0])?;
    /// let worst = Margins::of(&machine, &posture, None).worst(&machine);
    /// assert_eq!(worst.constraint, Constraint::Stroke);
    /// assert!(worst.value < 0.0);
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn worst(&self, machine: &Machine) -> Margin {
        self.worst_with_fraction(machine).0
    }

    /// [`Self::worst`] and its fraction of its constraint's range, by which solutions compare.
    pub(crate) fn worst_with_fraction(&self, machine: &Machine) -> (Margin, f64) {
        let worst = WorstMargin::of(machine, self);
        (worst.margin, worst.fraction)
    }

    /// The same; calls `found` with margins among which is the least one of every constraint.
    #[inline]
    pub(crate) fn worst_of_each(&self, machine: &Machine, mut found: impl FnMut(Margin)) -> (Margin, f64) {
        let mut worst = WorstMargin::new(self.rod_crossing, machine.normalization.rod_crossing);
        if self.rod_crossing.is_some() {
            found(worst.margin);
        }
        each_margin(machine, self, |constraint, element, value, factor| {
            found(Margin { constraint, element, value });
            worst.compare(constraint, element, value, factor);
        });
        (worst.margin, worst.fraction)
    }

    /// The margin of the constraint that keeps a posture out of the working mode: crossed rods, or the slider end
    /// that lies lowest relative to its platform end.
    pub(crate) fn out_of_mode(&self) -> Margin {
        if let Some(value) = self.rod_crossing.filter(|margin| *margin <= 0.0) {
            return Margin { constraint: Constraint::RodCrossing, element: Element::Leg(1), value };
        }
        let (i, value) = least(&self.serial_singularity);
        Margin { constraint: Constraint::SerialSingularity, element: FAMILY_ROD[i], value }
    }
}

//! The worst of all margins. Each margin is divided by its constraint's own range.

use super::{Margins, between};
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::TableAngles;
use crate::residual::lesser;

/// The rod that stands for each family.
pub(super) const ROD: [Element; 4] = [Element::Rod(11), Element::Rod(12), Element::Rod(21), Element::Rod(31)];

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
pub(super) struct Worst {
    pub(super) margin: Margin,
    part: f64,
}

impl Worst {
    /// The worst of crossed rods, strokes and the table's ranges.
    #[inline]
    pub(super) fn of_strokes(
        machine: &Machine,
        rod_crossing: f64,
        rho: [f64; 3],
        table: Option<TableAngles>,
    ) -> Self {
        let limits = machine.limits();
        let mut worst = Self::new(rod_crossing, machine.derived.weights.rod_crossing);
        worst.meet_strokes(machine, &[0, 1, 2].map(|i| between(limits.stroke[i], rho[i])));
        if let Some(TableAngles { theta1, theta2 }) = table {
            let (tilt, rotary) = (between(limits.tilt, theta1), between(limits.rotary, theta2));
            worst.meet_table(machine, Some(tilt), Some(rotary));
        }
        worst
    }

    /// The worst of all margins except that of the table's plane.
    pub(super) fn of(machine: &Machine, margins: &Margins) -> Self {
        let weights = &machine.derived.weights;
        let mut worst = Self::new(margins.rod_crossing, weights.rod_crossing);
        worst.meet_strokes(machine, &margins.stroke);
        worst.meet_legs(machine, &margins.leg_length);
        let families = [
            (Constraint::SerialSingularity, &margins.serial_singularity, weights.serial_singularity),
            (Constraint::SliderJoint, &margins.slider_joint, weights.slider_joint),
            (Constraint::PlatformJoint, &margins.platform_joint, weights.platform_joint),
        ];
        for (constraint, margins, weight) in families {
            worst.meet_rods(constraint, least(margins), weight);
        }
        let (det, gap) = (margins.parallel_singularity, margins.rod_interference);
        worst.meet(Constraint::ParallelSingularity, Element::Platform, det, weights.parallel_singularity);
        let [a, b] = margins.nearest_rods;
        worst.meet(Constraint::RodInterference, Element::Rods(a, b), gap, weights.rod_interference);
        worst.meet_table(machine, margins.tilt, margins.rotary);
        worst
    }

    /// The worst margin including that of the table's plane, if it is checked.
    #[inline]
    pub(super) fn with_clearance(mut self, machine: &Machine, clearance: Option<Margin>) -> Self {
        if let Some(Margin { constraint, element, value }) = clearance {
            self.meet(constraint, element, value, machine.derived.weights.table_clearance);
        }
        self
    }

    /// Starts with the margin of crossed rods.
    #[inline]
    fn new(rod_crossing: f64, weight: f64) -> Self {
        let (constraint, element) = (Constraint::RodCrossing, Element::Leg(1));
        let margin = Margin { constraint, element, value: rod_crossing };
        Self { margin, part: rod_crossing * weight }
    }

    #[inline]
    fn meet(&mut self, constraint: Constraint, element: Element, value: f64, weight: f64) {
        let part = value * weight;
        if part < self.part {
            *self = Self { margin: Margin { constraint, element, value }, part };
        }
    }

    /// Compares without branches, because their outcomes are unpredictable.
    #[inline]
    fn meet_strokes(&mut self, machine: &Machine, stroke: &[[f64; 2]; 3]) {
        let weights = &machine.derived.weights.stroke;
        let values = stroke.map(|[low, high]| lesser(low, high));
        let parts: [f64; 3] = std::array::from_fn(|i| values[i] * weights[i]);
        let (first, least) = (usize::from(parts[1] < parts[0]), lesser(parts[0], parts[1]));
        let i = if parts[2] < least { 2 } else { first };
        if parts[i] < self.part {
            let (slider, high) = ([1, 2, 3][i], stroke[i][1] < stroke[i][0]);
            let (constraint, element) = (Constraint::Stroke, Element::Stroke { slider, high });
            *self = Self { margin: Margin { constraint, element, value: values[i] }, part: parts[i] };
        }
    }

    #[inline]
    fn meet_legs(&mut self, machine: &Machine, leg_length: &[f64; 3]) {
        for (i, (value, weight)) in (1..).zip(leg_length.iter().zip(machine.derived.weights.leg_length)) {
            self.meet(Constraint::LegLength, Element::Leg(i), *value, weight);
        }
    }

    #[inline]
    fn meet_rods(&mut self, constraint: Constraint, (i, value): (usize, f64), weight: f64) {
        self.meet(constraint, ROD[i], value, weight);
    }

    #[inline]
    fn meet_table(&mut self, machine: &Machine, tilt: Option<[f64; 2]>, rotary: Option<[f64; 2]>) {
        let weights = &machine.derived.weights;
        let ranges = [(Constraint::Tilt, tilt, weights.tilt), (Constraint::Rotary, rotary, weights.rotary)];
        for (constraint, ends, weight) in ranges {
            if let Some(ends) = ends {
                let (end, value) = least(&ends);
                self.meet(constraint, Element::Range { high: end == 1 }, value, weight);
            }
        }
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
    /// use verne_solver::{Constraint, Machine, Margins, Refusal, platform_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [0.0, 0.0, 600.0])?;
    /// let worst = Margins::of(&machine, &posture, None).worst(&machine);
    /// assert_eq!(worst.constraint, Constraint::Stroke);
    /// assert!(worst.value < 0.0);
    /// # Ok::<(), Refusal>(())
    /// ```
    pub fn worst(&self, machine: &Machine) -> Margin {
        self.weighed(machine).0
    }

    /// [`Self::worst`] and its fraction of its constraint's range, by which solutions compare.
    pub(crate) fn weighed(&self, machine: &Machine) -> (Margin, f64) {
        let worst = Worst::of(machine, self).with_clearance(machine, self.table_clearance);
        (worst.margin, worst.part)
    }
}

//! The worst of all margins, made comparable by each constraint's own range.

use super::Margins;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;

/// The rod that stands for each family.
pub(super) const ROD: [Element; 4] = [Element::Rod(11), Element::Rod(12), Element::Rod(21), Element::Rod(31)];

/// The least number and its place.
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

/// The margin that is worst so far, and its part of its constraint's range.
struct Worst {
    margin: Margin,
    part: f64,
}

impl Worst {
    #[inline]
    fn meet(&mut self, constraint: Constraint, element: Element, value: f64, range: f64) {
        let part = value / range;
        if part < self.part {
            *self = Self { margin: Margin { constraint, element, value }, part };
        }
    }
}

impl Margins {
    /// The worst margin: the least one as a fraction of its constraint's own range (stroke, rod
    /// length, cone half-angle, value at home, ...), so that lengths and angles compare.
    pub fn worst(&self, machine: &Machine) -> Margin {
        let (g, limits, home) = (machine.geometry(), machine.limits(), &machine.derived);
        let crossing = Margin {
            constraint: Constraint::RodCrossing,
            element: Element::Leg(1),
            value: self.rod_crossing,
        };
        let mut worst = Worst { margin: crossing, part: self.rod_crossing / (g.R1 - g.r1) };
        for (i, (ends, [low, high])) in (1..).zip(self.stroke.iter().zip(limits.stroke)) {
            let (end, value) = least(ends);
            worst.meet(Constraint::Stroke, Element::Stroke { slider: i, high: end == 1 }, value, high - low);
        }
        for (i, (value, length)) in (1..).zip(self.leg_length.iter().zip([g.L1, g.L2, g.L3])) {
            worst.meet(Constraint::LegLength, Element::Leg(i), *value, length);
        }
        let families = [
            (Constraint::SerialSingularity, &self.serial_singularity, 1.0),
            (Constraint::SliderJoint, &self.slider_joint, limits.slider_cone),
            (Constraint::PlatformJoint, &self.platform_joint, limits.platform_cone),
        ];
        for (constraint, margins, range) in families {
            let (i, value) = least(margins);
            worst.meet(constraint, ROD[i], value, range);
        }
        let det = self.parallel_singularity;
        worst.meet(Constraint::ParallelSingularity, Element::Platform, det, home.home_det.abs());
        let [a, b] = self.nearest_rods;
        let (gap, free) = (self.rod_interference, home.home_distance);
        worst.meet(Constraint::RodInterference, Element::Rods(a, b), gap, free);
        let ranges =
            [(Constraint::Tilt, self.tilt, limits.tilt), (Constraint::Rotary, self.rotary, limits.rotary)];
        for (constraint, ends, [low, high]) in ranges {
            if let Some(ends) = ends {
                let (end, value) = least(&ends);
                worst.meet(constraint, Element::Range { high: end == 1 }, value, high - low);
            }
        }
        worst.margin
    }
}

//! The worst margins of some postures.

use super::margin_block::{Column, MarginBlock};
use super::worst::FAMILY_ROD;
use crate::fast_math::lesser;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::registers::ROWS;

/// Codes of a constraint with its element: that of the first element, which those of the others follow.
const CROSSING: usize = 0;
const STROKE: usize = 1;
const LEG: usize = 7;
const SERIAL: usize = 10;
const PARALLEL: usize = 14;
const SLIDER_JOINT: usize = 15;
const PLATFORM_JOINT: usize = 19;
const INTERFERENCE: usize = 23;
const TILT: usize = 24;
const ROTARY: usize = 26;
const CLEARANCE: usize = 28;

/// The worst margin of each row.
pub(super) struct WorstBlock {
    value: Column,
    code: [usize; ROWS],
    /// 1 for a row without a negative margin.
    feasible: [u64; ROWS],
}

/// The worst margin of a row so far, as in [`WorstMargin`](super::worst::WorstMargin), without branches.
struct WorstOfRow {
    fraction: f64,
    value: f64,
    code: usize,
    feasible: bool,
}

impl WorstOfRow {
    #[inline(always)]
    fn compare(&mut self, code: usize, value: f64, factor: f64) {
        self.compare_if(true, code, value, factor);
    }

    /// Compares a margin that exists in some rows only.
    #[inline(always)]
    fn compare_if(&mut self, exists: bool, code: usize, value: f64, factor: f64) {
        let fraction = value * factor;
        let is_worse = exists & (fraction < self.fraction);
        self.fraction = if is_worse { fraction } else { self.fraction };
        self.value = if is_worse { value } else { self.value };
        self.code = if is_worse { code } else { self.code };
        self.feasible &= !exists | (value >= 0.0);
    }

    /// The lesser of two ends of a range.
    #[inline(always)]
    fn compare_ends(&mut self, exists: bool, code: usize, [low, high]: [f64; 2], factor: f64) {
        self.compare_if(exists, code + usize::from(high < low), lesser(low, high), factor);
    }

    /// The least of the four families of rods.
    #[inline(always)]
    fn compare_families(&mut self, code: usize, margins: &[Column; 4], i: usize, factor: f64) {
        let mut least = (margins[0][i], code);
        for (column, code) in margins[1..].iter().zip(code + 1..) {
            least = if column[i] < least.0 { (column[i], code) } else { least };
        }
        self.compare(least.1, least.0, factor);
    }
}

impl WorstBlock {
    pub(super) fn new() -> Self {
        Self { value: [0.0; ROWS], code: [0; ROWS], feasible: [0; ROWS] }
    }

    /// Finds the worst margin of a row, in the order of [`WorstMargin::of`](super::worst::WorstMargin::of).
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, machine: &Machine, margins: &MarginBlock) {
        let factors = &machine.normalization;
        // Any other margin is worse than one that is no limit.
        let is_limit = margins.has_crossing[i] == 1;
        let crossing = if is_limit { margins.rod_crossing[i] } else { f64::INFINITY };
        let fraction = crossing * factors.rod_crossing;
        let mut worst = WorstOfRow { fraction, value: crossing, code: CROSSING, feasible: crossing >= 0.0 };
        for (slider, ends) in margins.stroke.iter().enumerate() {
            let code = STROKE + 2 * slider;
            worst.compare_ends(true, code, [ends[0][i], ends[1][i]], factors.stroke[slider]);
        }
        for (leg, column) in margins.leg_length.iter().enumerate() {
            worst.compare(LEG + leg, column[i], factors.leg_length[leg]);
        }
        worst.compare_families(SERIAL, &margins.serial_singularity, i, factors.serial_singularity);
        worst.compare_families(SLIDER_JOINT, &margins.slider_joint, i, factors.slider_joint);
        worst.compare_families(PLATFORM_JOINT, &margins.platform_joint, i, factors.platform_joint);
        worst.compare(PARALLEL, margins.parallel_singularity[i], factors.parallel_singularity);
        worst.compare(INTERFERENCE, margins.rod_interference[i], factors.rod_interference);
        let has_table = margins.has_table[i] == 1;
        let has_rotary = has_table & (margins.has_rotary == 1);
        worst.compare_ends(has_table, TILT, [margins.tilt[0][i], margins.tilt[1][i]], factors.tilt);
        worst.compare_ends(has_rotary, ROTARY, [margins.rotary[0][i], margins.rotary[1][i]], factors.rotary);
        let has_clearance = margins.has_clearance[i] == 1;
        worst.compare_if(has_clearance, CLEARANCE, margins.table_clearance[i], factors.table_clearance);
        (self.value[i], self.code[i]) = (worst.value, worst.code);
        self.feasible[i] = u64::from(worst.feasible);
    }

    /// The worst margin of a row, and whether no margin is negative.
    #[inline]
    pub(super) fn of(&self, i: usize, margins: &MarginBlock) -> (Margin, bool) {
        let value = self.value[i];
        let (constraint, element) = match self.code[i] {
            INTERFERENCE => {
                let [a, b] = margins.nearest_rods(i);
                (Constraint::RodInterference, Element::Rods(a, b))
            }
            CLEARANCE => (Constraint::TableClearance, margins.clearance(i).element),
            code => NAMES[code],
        };
        (Margin { constraint, element, value }, self.feasible[i] == 1)
    }
}

/// The constraints and elements of the codes below [`CLEARANCE`]. The rods of [`INTERFERENCE`] are those of a row.
const NAMES: [(Constraint, Element); CLEARANCE] = [
    (Constraint::RodCrossing, Element::Leg(1)),
    stroke(1, false),
    stroke(1, true),
    stroke(2, false),
    stroke(2, true),
    stroke(3, false),
    stroke(3, true),
    (Constraint::LegLength, Element::Leg(1)),
    (Constraint::LegLength, Element::Leg(2)),
    (Constraint::LegLength, Element::Leg(3)),
    (Constraint::SerialSingularity, FAMILY_ROD[0]),
    (Constraint::SerialSingularity, FAMILY_ROD[1]),
    (Constraint::SerialSingularity, FAMILY_ROD[2]),
    (Constraint::SerialSingularity, FAMILY_ROD[3]),
    (Constraint::ParallelSingularity, Element::Platform),
    (Constraint::SliderJoint, FAMILY_ROD[0]),
    (Constraint::SliderJoint, FAMILY_ROD[1]),
    (Constraint::SliderJoint, FAMILY_ROD[2]),
    (Constraint::SliderJoint, FAMILY_ROD[3]),
    (Constraint::PlatformJoint, FAMILY_ROD[0]),
    (Constraint::PlatformJoint, FAMILY_ROD[1]),
    (Constraint::PlatformJoint, FAMILY_ROD[2]),
    (Constraint::PlatformJoint, FAMILY_ROD[3]),
    (Constraint::RodInterference, Element::Platform),
    (Constraint::Tilt, Element::Range { high: false }),
    (Constraint::Tilt, Element::Range { high: true }),
    (Constraint::Rotary, Element::Range { high: false }),
    (Constraint::Rotary, Element::Range { high: true }),
];

const fn stroke(slider: u8, high: bool) -> (Constraint, Element) {
    (Constraint::Stroke, Element::Stroke { slider, high })
}

//! All margins of a place as numbers that compare: those of constraints with a reserve in units of it, the others as
//! fractions of their ranges.

use crate::error::KinematicsError;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::margins::Margins;

/// Number of values of a place.
pub(super) const VALUES: usize = 28;
/// The last value: whether the working mode reaches the place. It has no reserve.
const REACH: usize = VALUES - 1;
/// Value of a place that is out of reach by nothing.
const OUT_OF_REACH: f64 = -0.05;

/// The values of a place. They are infinite where there is none.
pub(in crate::toolpath) type Values = [f64; VALUES];

/// The constraint and the element of each value but the last, which has none; those of distances between rods and of
/// the table's plane differ from place to place.
const MEANING: [(Constraint, Element); VALUES - 1] = {
    use Constraint as C;
    use Element as E;
    const RODS: [Element; 4] = [E::Rod(11), E::Rod(12), E::Rod(21), E::Rod(31)];
    [
        (C::Stroke, E::Stroke { slider: 1, high: false }),
        (C::Stroke, E::Stroke { slider: 1, high: true }),
        (C::Stroke, E::Stroke { slider: 2, high: false }),
        (C::Stroke, E::Stroke { slider: 2, high: true }),
        (C::Stroke, E::Stroke { slider: 3, high: false }),
        (C::Stroke, E::Stroke { slider: 3, high: true }),
        (C::LegLength, E::Leg(1)),
        (C::LegLength, E::Leg(2)),
        (C::LegLength, E::Leg(3)),
        (C::SerialSingularity, RODS[0]),
        (C::SerialSingularity, RODS[1]),
        (C::SerialSingularity, RODS[2]),
        (C::SerialSingularity, RODS[3]),
        (C::SliderJoint, RODS[0]),
        (C::SliderJoint, RODS[1]),
        (C::SliderJoint, RODS[2]),
        (C::SliderJoint, RODS[3]),
        (C::PlatformJoint, RODS[0]),
        (C::PlatformJoint, RODS[1]),
        (C::PlatformJoint, RODS[2]),
        (C::PlatformJoint, RODS[3]),
        (C::ParallelSingularity, E::Platform),
        (C::RodCrossing, E::Leg(1)),
        (C::RodInterference, E::Rods(11, 12)),
        (C::Tilt, E::Range { high: false }),
        (C::Tilt, E::Range { high: true }),
        (C::TableClearance, E::Tool),
    ]
};

/// The margins in the order of [`MEANING`].
fn numbers(margins: &Margins) -> [f64; VALUES - 1] {
    let [s1, s2, s3] = margins.stroke;
    let [l1, l2, l3] = margins.leg_length;
    let [a, b, c, d] = margins.serial_singularity;
    let [e, f, g, h] = margins.slider_joint;
    let [i, j, k, l] = margins.platform_joint;
    let [low, high] = margins.tilt.unwrap_or([f64::INFINITY; 2]);
    let clearance = margins.table_clearance.map_or(f64::INFINITY, |margin| margin.value);
    let Margins { parallel_singularity, rod_interference, .. } = *margins;
    let rod_crossing = margins.rod_crossing.unwrap_or(f64::INFINITY);
    [
        s1[0],
        s1[1],
        s2[0],
        s2[1],
        s3[0],
        s3[1],
        l1,
        l2,
        l3,
        a,
        b,
        c,
        d,
        e,
        f,
        g,
        h,
        i,
        j,
        k,
        l,
        parallel_singularity,
        rod_crossing,
        rod_interference,
        low,
        high,
        clearance,
    ]
}

/// How the margins of a place compare.
#[derive(Clone, Debug)]
pub(in crate::toolpath) struct Criteria {
    factors: [f64; VALUES - 1],
    /// Whether a value has a reserve.
    pub(super) has_reserve: [bool; VALUES],
    /// The value of a margin that is as great as its reserve: the least fraction of its range that a reserve is.
    pub(super) unit: f64,
    /// The factor of the margin of the rotary axis; zero without a limit.
    pub(super) rotary: f64,
    pub(super) rotary_has_reserve: bool,
    reserve: [Option<f64>; Constraint::COUNT],
}

impl Criteria {
    /// Every margin as a fraction of its range, as great as possible.
    pub(super) fn fractions(machine: &Machine) -> Self {
        let mut criteria = Self::new(machine, &[]);
        criteria.has_reserve = std::array::from_fn(|i| i != REACH);
        criteria
    }

    pub(in crate::toolpath) fn new(machine: &Machine, reserve: &[(Constraint, f64)]) -> Self {
        let mut of = [None; Constraint::COUNT];
        for (constraint, reserve) in reserve {
            of[*constraint as usize] = Some(*reserve);
        }
        let range = |(constraint, element)| Margin { constraint, element, value: 1.0 }.fraction(machine);
        let rotary = (Constraint::Rotary, Element::Range { high: false });
        let fractions = MEANING.iter().chain([&rotary]).filter_map(|meaning| {
            Some(of[meaning.0 as usize]? * range(*meaning)).filter(|fraction| *fraction > 0.0)
        });
        let unit = fractions.fold(f64::INFINITY, f64::min);
        let unit = if unit.is_finite() { unit } else { 1.0 };
        let factor = |meaning: (Constraint, Element)| {
            of[meaning.0 as usize].map_or_else(|| range(meaning), |reserve| unit / reserve)
        };
        let is_limited = machine.limits().rotary.is_some();
        Self {
            factors: MEANING.map(factor),
            has_reserve: std::array::from_fn(|i| {
                MEANING.get(i).is_some_and(|(constraint, _)| of[*constraint as usize].is_some())
            }),
            unit,
            rotary: if is_limited { factor(rotary) } else { 0.0 },
            rotary_has_reserve: of[Constraint::Rotary as usize].is_some(),
            reserve: of,
        }
    }

    /// The reserve of a constraint, in its unit.
    pub(super) fn reserve(&self, constraint: Constraint) -> Option<f64> {
        self.reserve[constraint as usize]
    }

    /// The values of a place with these margins, or without any.
    pub(in crate::toolpath) fn values(
        &self,
        machine: &Machine,
        margins: Result<&Margins, KinematicsError>,
    ) -> Values {
        let mut values = [f64::INFINITY; VALUES];
        match margins {
            Ok(margins) => {
                for (value, (number, factor)) in
                    values.iter_mut().zip(numbers(margins).into_iter().zip(self.factors))
                {
                    *value = number * factor;
                }
            }
            Err(error) => values[REACH] = out_of_reach(machine, error),
        }
        values
    }

    /// The margin behind a value of a place.
    pub(super) fn margin(index: usize, margins: &Margins) -> Option<Margin> {
        let (constraint, element) = *MEANING.get(index)?;
        let element = match constraint {
            Constraint::RodInterference => Element::Rods(margins.nearest_rods[0], margins.nearest_rods[1]),
            Constraint::TableClearance => margins.table_clearance?.element,
            _ => element,
        };
        Some(Margin { constraint, element, value: numbers(margins)[index] })
    }
}

/// The value of a place without joints.
fn out_of_reach(machine: &Machine, error: KinematicsError) -> f64 {
    let beyond = match error {
        KinematicsError::Unreachable(margin) => margin.fraction(machine).clamp(-1.0, 0.0),
        KinematicsError::SelfMotion => 0.0,
        KinematicsError::OutOfDomain | KinematicsError::OutOfProportion => -1.0,
    };
    OUT_OF_REACH + beyond
}

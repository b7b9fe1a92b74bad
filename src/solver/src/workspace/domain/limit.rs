//! The limits of the plane domain, in one table, and their constraints. Arrays of limit values and sets of limits use
//! the order of the table.

use crate::limit::{Constraint, Element};

/// A limit of the plane domain. A rod is given by its family: rod 11, rod 12, leg II, leg III.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::workspace) enum Limit {
    /// Leg I is long enough to reach.
    LegOneReach,
    /// Leg I's rods do not cross.
    LegOneCrossing,
    /// Rod 11 or 12 is inclined enough to its guideway.
    LegOneSerial(u8),
    /// Leg II or III reaches and is inclined enough to its guideway.
    LegSerial(u8),
    /// The platform is far enough from a parallel singularity.
    ParallelSingularity,
    /// A rod is within its cone at the slider.
    SliderCone(u8),
    /// A rod is within its cone at the platform.
    PlatformCone(u8),
    /// Rods are far enough apart.
    RodDistance(RodPairs),
    /// For columns, a pair of sliders: see [`SLIDER_PAIRS`]. For a slice, a slider's number times two, plus one for
    /// the upper end of its stroke.
    Stroke(u8),
    /// The table's tilting angle is not below its least value, or not above its greatest.
    Tilt {
        /// Whether it is the greatest value.
        high: bool,
    },
    /// The column reaches above the table's plane.
    TablePlane,
}

/// The pairs of rods whose least distance is one limit, as in
/// [`least_distances_by_legs`](crate::margins::interference::least_distances_by_legs).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::workspace) enum RodPairs {
    /// Leg I's own two rods.
    LegOne,
    /// A parallelogram's two rods.
    Parallelograms,
    /// Rods of different legs.
    BetweenLegs,
}

/// Number of limits.
pub(in crate::workspace) const LIMITS: usize = 27;

/// Pairs of sliders (i, j): the highest z of slider i's stroke is over the lowest z of slider j's.
pub(in crate::workspace) const SLIDER_PAIRS: [(usize, usize); 6] =
    [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];

/// The rod that represents its family.
const RODS: [u8; 4] = [11, 12, 21, 31];

/// A set of limits, a bit each.
pub(in crate::workspace) type LimitSet = u32;

impl Limit {
    /// All limits in the order of their numbers.
    pub(in crate::workspace) const ALL: [Self; LIMITS] = [
        Self::LegOneReach,
        Self::LegOneCrossing,
        Self::LegOneSerial(0),
        Self::LegOneSerial(1),
        Self::LegSerial(2),
        Self::LegSerial(3),
        Self::ParallelSingularity,
        Self::SliderCone(0),
        Self::SliderCone(1),
        Self::SliderCone(2),
        Self::SliderCone(3),
        Self::PlatformCone(0),
        Self::PlatformCone(1),
        Self::PlatformCone(2),
        Self::PlatformCone(3),
        Self::RodDistance(RodPairs::LegOne),
        Self::RodDistance(RodPairs::Parallelograms),
        Self::RodDistance(RodPairs::BetweenLegs),
        Self::Stroke(0),
        Self::Stroke(1),
        Self::Stroke(2),
        Self::Stroke(3),
        Self::Stroke(4),
        Self::Stroke(5),
        Self::Tilt { high: false },
        Self::Tilt { high: true },
        Self::TablePlane,
    ];

    /// Leg I's limits. Beyond the one that ends the domain the others may be violated too.
    pub(in crate::workspace) const LEG_ONE: LimitSet = {
        let (mut set, mut number) = (0, 0);
        while number < LIMITS {
            if let Self::LegOneReach | Self::LegOneCrossing | Self::LegOneSerial(_) = Self::ALL[number] {
                set |= 1 << number;
            }
            number += 1;
        }
        set
    };

    /// Whether columns on the limit have no height, so that the two sheets meet there.
    pub(in crate::workspace) const fn ends_columns(self) -> bool {
        matches!(self, Self::Stroke(_) | Self::TablePlane)
    }

    /// The set of the limits with a property.
    pub(in crate::workspace) fn set(has: impl Fn(Self) -> bool) -> LimitSet {
        let number = |(number, limit): (usize, &Self)| LimitSet::from(has(*limit)) << number;
        Self::ALL.iter().enumerate().map(number).sum()
    }

    /// The numbers and limits of a set, ascending.
    pub(in crate::workspace) fn of_set(set: LimitSet) -> impl Iterator<Item = (usize, Self)> {
        Self::ALL.into_iter().enumerate().filter(move |(number, _)| set & (1 << number) != 0)
    }

    /// The binding constraint of the limit, with strokes as in a slice. The nearest rods and the lowest point over
    /// the table need a domain: see [`Domain::binding_at`](super::Domain::binding_at).
    pub(in crate::workspace) fn binding(self) -> Binding {
        let rod = |family: u8| Element::Rod(RODS[usize::from(family)]);
        let (constraint, element) = match self {
            Self::LegOneReach => (Constraint::LegLength, Element::Leg(1)),
            Self::LegOneCrossing => (Constraint::RodCrossing, Element::Leg(1)),
            Self::LegOneSerial(family) | Self::LegSerial(family) => {
                (Constraint::SerialSingularity, rod(family))
            }
            Self::ParallelSingularity => (Constraint::ParallelSingularity, Element::Platform),
            Self::SliderCone(family) => (Constraint::SliderJoint, rod(family)),
            Self::PlatformCone(family) => (Constraint::PlatformJoint, rod(family)),
            Self::RodDistance(_) => (Constraint::RodInterference, Element::Platform),
            Self::Stroke(number) => return stroke_binding(number / 2, number % 2 == 1),
            Self::Tilt { high } => (Constraint::Tilt, Element::Range { high }),
            Self::TablePlane => (Constraint::TableClearance, Element::Tool),
        };
        Binding { constraint, element }
    }
}

/// The constraint that bounds the workspace somewhere, and the element of the machine that it belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Binding {
    /// The constraint.
    pub constraint: Constraint,
    /// The element of the machine.
    pub element: Element,
}

/// The end of a slider's stroke. Sliders are counted from 0.
pub(in crate::workspace) fn stroke_binding(slider: u8, high: bool) -> Binding {
    Binding { constraint: Constraint::Stroke, element: Element::Stroke { slider: slider + 1, high } }
}

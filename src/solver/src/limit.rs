//! Constraints, the elements of the machine that they limit, and margins.

/// The constraints of the workspace (section IV.A of the paper).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Constraint {
    /// A slider within its stroke, mm.
    Stroke,
    /// A leg long enough to reach, mm.
    LegLength,
    /// A rod inclined enough to its guideway, cosine.
    SerialSingularity,
    /// The parallel conditioning `det_P`.
    ParallelSingularity,
    /// A rod within its cone at the slider, rad.
    SliderJoint,
    /// A rod within its cone at the platform, rad.
    PlatformJoint,
    /// Leg I's rods uncrossed, mm.
    RodCrossing,
    /// Distance between rods, mm.
    RodInterference,
    /// The table's tilting angle within its range, rad.
    Tilt,
    /// The table's rotary angle within its range, rad.
    Rotary,
    /// Height of the tool's end and of the platform's joints over the table's plane, mm.
    TableClearance,
}

impl Constraint {
    /// Number of constraints.
    pub(crate) const COUNT: usize = Self::TableClearance as usize + 1;

    /// Every constraint, in the order of their definition.
    ///
    /// ```
    /// use verne_solver::Constraint;
    ///
    /// assert!(Constraint::ALL.iter().enumerate().all(|(index, constraint)| *constraint as usize == index));
    /// ```
    pub const ALL: [Self; Self::COUNT] = [
        Self::Stroke,
        Self::LegLength,
        Self::SerialSingularity,
        Self::ParallelSingularity,
        Self::SliderJoint,
        Self::PlatformJoint,
        Self::RodCrossing,
        Self::RodInterference,
        Self::Tilt,
        Self::Rotary,
        Self::TableClearance,
    ];
}

/// The part of the machine that a margin belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    /// The lower or upper end of slider 1, 2 or 3's stroke.
    Stroke {
        /// 1, 2 or 3.
        slider: u8,
        /// True at the upper value of rho.
        high: bool,
    },
    /// Leg 1, 2 or 3.
    Leg(u8),
    /// A rod: 11, 12, 21, 22, 31 or 32.
    Rod(u8),
    /// Two rods.
    Rods(u8, u8),
    /// The lower or upper end of a table angle's range.
    Range {
        /// True at the upper end.
        high: bool,
    },
    /// The platform as a whole.
    Platform,
    /// The tool's end.
    Tool,
    /// The joint at the platform of a rod: 11, 12, 21, 22, 31 or 32.
    Joint(u8),
}

/// One constraint's margin: positive inside, zero on the limit, negative outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// The constraint.
    pub constraint: Constraint,
    /// The part of the machine.
    pub element: Element,
    /// The distance from the limit, in the constraint's unit (mm, rad or none).
    pub value: f64,
}

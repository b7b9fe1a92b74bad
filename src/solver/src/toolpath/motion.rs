//! The motions of a program, in the part frame.

use crate::pose::Point;

/// How the tool gets to the end of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// Positioning outside the part. The joints may change their preimage and winding.
    Rapid,
    /// Cutting. The joints are continuous.
    Feed,
    /// Something that ends a cut and is no motion along a path, such as a tool change: the machine arrives at the
    /// position from anywhere.
    Arrive,
}

/// A position of the tool in the part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolPosition {
    /// The tool's end, mm.
    pub tip: Point,
    /// Unit vector from the tool's end to its holder.
    pub axis: [f64; 3],
}

impl ToolPosition {
    /// The position of a tool in the same holder that is longer by `change`, mm.
    fn lengthened(self, change: f64) -> Self {
        Self { tip: std::array::from_fn(|i| self.tip[i] - change * self.axis[i]), ..self }
    }
}

/// The path of the tool's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// A straight line.
    Line,
    /// A circular arc or a helix. A deviation of the end from the arc, which includes a helix's rise, is spread over
    /// the path in proportion to the angle.
    Arc {
        /// A point of the axis, mm.
        centre: Point,
        /// Unit vector along the axis; the arc turns right-handed about it.
        normal: [f64; 3],
        /// Angle, rad; positive, and more than 2π for several turns.
        sweep: f64,
    },
}

/// How the tool's axis moves between two positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turning {
    /// Along the great circle between the two axes, at a constant rate.
    GreatCircle,
    /// With phi1 and phi2 linear in the path parameter.
    Angles {
        /// `[phi1, phi2]` at the start, in the program's frame, rad.
        start: [f64; 2],
        /// `[phi1, phi2]` at the end, rad.
        end: [f64; 2],
        /// Rotation of the program's frame in the part frame, by rows.
        frame: [[f64; 3]; 3],
    },
    /// With phi1 and phi2 in the part frame linear in the path parameter, and theta2 = -phi2 but for whole turns, also
    /// where phi1 = 0, so that phi2 does not turn the tool's axis.
    Held {
        /// `[phi1, phi2]` at the start, rad.
        start: [f64; 2],
        /// `[phi1, phi2]` at the end, rad; the start of a motion of kind [`MotionKind::Arrive`] does not count.
        end: [f64; 2],
    },
}

/// One motion of a program: from the end of the motion before it to its own end.
///
/// If the tool has another length than in the motion before, the joints stay and the motion begins at the new tool's
/// end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The purpose of the motion.
    pub kind: MotionKind,
    /// Where it ends.
    pub end: ToolPosition,
    /// The path of the tool's end.
    pub curve: Curve,
    /// The motion of the axis.
    pub turning: Turning,
    /// Length of the tool from P to its end, mm.
    pub tool_length: f64,
}

/// Where the machine stands between two motions: the tool's position, and the tool's length, mm.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Standstill(pub(super) Option<(ToolPosition, f64)>);

impl Standstill {
    /// Moves to the end of a motion. The answer is where the tool is before it; `None` if that is unknown.
    pub(super) fn advance(&mut self, motion: &Motion) -> Option<ToolPosition> {
        let (start, tool_length) = self.0.replace((motion.end, motion.tool_length))?;
        (motion.kind != MotionKind::Arrive).then(|| start.lengthened(motion.tool_length - tool_length))
    }
}

/// The motions of a program. They are read several times and in order.
pub trait Motions {
    /// Number of motions.
    fn count(&self) -> usize;
    /// One motion; `index` is less than [`Self::count`].
    fn motion(&self, index: usize) -> Motion;
}

impl<M: Motions + ?Sized> Motions for &M {
    fn count(&self) -> usize {
        (**self).count()
    }

    fn motion(&self, index: usize) -> Motion {
        (**self).motion(index)
    }
}

impl Motions for Vec<Motion> {
    fn count(&self) -> usize {
        self.len()
    }

    fn motion(&self, index: usize) -> Motion {
        self[index]
    }
}

impl Motions for [Motion] {
    fn count(&self) -> usize {
        self.len()
    }

    fn motion(&self, index: usize) -> Motion {
        self[index]
    }
}

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
}

/// One motion of a program: from the end of the motion before it to its own end.
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

/// The motions of a program. They are read twice and in order.
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

impl Motions for [Motion] {
    fn count(&self) -> usize {
        self.len()
    }

    fn motion(&self, index: usize) -> Motion {
        self[index]
    }
}

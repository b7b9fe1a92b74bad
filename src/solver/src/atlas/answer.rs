//! The answer of an atlas: curves, points and regions.

/// What happens to the solutions on a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CurveKind {
    /// Two angles of leg I merge, with all solutions that have them.
    LegOne,
    /// Leg II is level: its solutions above and below merge.
    LegTwo,
    /// Leg III is level.
    LegThree,
    /// `det_P` is zero: two forward solutions merge.
    Parallel,
    /// R1 = r1 only: leg I is level and the platform begins to turn. Solutions meet, but their number stays.
    Constraint,
}

/// A curve in the window. Its corners are on the true curve, its sides within the tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What happens on it.
    pub kind: CurveKind,
    /// Whether the last corner joins the first.
    pub closed: bool,
    /// (u, v) of the corners, mm.
    pub points: Vec<[f64; 2]>,
}

/// What a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PointKind {
    /// Three solutions merge, and the curve turns back.
    Cusp,
    /// Two curves cross, or a curve crosses itself.
    Crossing,
    /// Curves end together, or a curve has a corner.
    Corner,
    /// A curve touches another one and ends there.
    Tangency,
    /// Solutions merge at this point only.
    Isolated,
    /// The platform can move while all sliders stand.
    SelfMotion,
}

/// A special point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecialPoint {
    /// What it is.
    pub kind: PointKind,
    /// (u, v), mm.
    pub at: [f64; 2],
}

/// A polygon with holes. The last corner of a ring joins the first. Its corners are on the true curves, its sides
/// within the tolerance of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Face {
    /// Counter-clockwise.
    pub outer: Vec<[f64; 2]>,
    /// Clockwise.
    pub holes: Vec<Vec<[f64; 2]>>,
    /// A point in its interior, far from its sides.
    pub label: [f64; 2],
    /// The area within the true curves, mm²: that of the polygon and of the cubic segments on its sides.
    pub area: f64,
    /// How far the area may be off, mm²: each side's length times twice the distance between the true curve and the
    /// cubic in the side's middle. The distance is not checked elsewhere on the side.
    pub area_error: f64,
}

/// A region in which the number of solutions is constant. Faces that meet along a curve on both sides of which the
/// number is the same are one region.
///
/// A strip between curves that is narrower than a fiftieth of the tolerance has the number of its neighbour.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The number of solutions.
    pub solutions: usize,
    /// Its outline.
    pub face: Face,
}

/// The curves of one window, and the regions between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Atlas {
    /// All curves.
    pub curves: Vec<Curve>,
    /// Points at which the curves are special.
    pub points: Vec<SpecialPoint>,
    /// The regions: together they are the window.
    pub regions: Vec<Region>,
    /// The part of the window with a solution in the working mode, without regard to strokes and joints.
    pub working: Vec<Face>,
    /// The number of points at which the solver counted the solutions: up to three in each face between the curves.
    /// They agreed wherever they are farther than the tolerance from all curves.
    pub checked_points: usize,
}

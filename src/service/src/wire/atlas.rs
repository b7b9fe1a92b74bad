//! The answer of `/atlas`: curves, special points and regions of a plane.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::atlas::{Atlas, AtlasRequest, Curve, CurveKind, Face, PointKind, Space, Window};

use crate::wire::answer::MachineId;
use crate::wire::fixed_array::{FixedArray, Pair};

/// Plane of an atlas: `platform` (default), x and y of the platform's point P, on which the number of inverse solutions
/// depends; `joints`, rho2 - rho1 and rho3 - rho1, on which the number of forward solutions depends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = AtlasSpace)]
pub(crate) enum SpaceName {
    /// x and y of the platform's point P.
    #[default]
    Platform,
    /// rho2 - rho1 and rho3 - rho1.
    Joints,
}

/// Curves on which solutions of the parallel module merge, and the regions between them.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Atlas)]
pub(crate) struct AtlasObject {
    /// The plane.
    pub space: SpaceName,
    /// The machine.
    pub machine: MachineId,
    /// The meanings of u and v.
    #[schema(value_type = Vec<String>)]
    pub coordinates: [&'static str; 2],
    /// The part of the plane.
    pub window: WindowObject,
    /// Greatest distance between a curve of the answer and the true curve, mm.
    pub tolerance: f64,
    /// All curves in the window.
    pub curves: Vec<CurveObject>,
    /// Points at which the curves are special.
    pub points: Vec<SpecialPointObject>,
    /// The regions with a constant number of solutions. Together they are the window.
    pub regions: Vec<RegionObject>,
    /// The part of the window with a solution in the working mode.
    pub working: WorkingObject,
    /// Number of points inside regions at which the service compared the number of solutions with that of /ik or /fk.
    pub checked_points: usize,
}

/// A rectangle of the plane.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = AtlasWindow)]
pub(crate) struct WindowObject {
    /// Least and greatest u, mm.
    #[schema(inline)]
    pub u: Pair,
    /// Least and greatest v, mm.
    #[schema(inline)]
    pub v: Pair,
}

/// A curve on which solutions merge.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = AtlasCurve)]
pub(crate) struct CurveObject {
    /// Its kind.
    pub kind: CurveKindName,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// [u, v] along the curve, mm. The points are on the true curve, the lines between them within the tolerance.
    #[schema(inline)]
    pub points: Vec<Pair>,
}

/// Kind of a curve: `leg_1`, two angles of leg I merge; `leg_2` or `leg_3`, the leg is level and its solutions
/// above and below merge; `parallel`, det_P is zero and two forward solutions merge; `constraint`, in a linear delta
/// leg I is level and the platform can begin to turn (solutions meet, but their number is the same on both sides).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = AtlasCurveKind)]
pub(crate) enum CurveKindName {
    /// Two angles of leg I merge.
    #[serde(rename = "leg_1")]
    LegOne,
    /// Leg II is level.
    #[serde(rename = "leg_2")]
    LegTwo,
    /// Leg III is level.
    #[serde(rename = "leg_3")]
    LegThree,
    /// `det_P` is zero.
    Parallel,
    /// Leg I of a linear delta is level.
    Constraint,
}

/// A point at which a curve is special.
#[derive(Clone, Copy, Debug, Serialize, ToSchema)]
#[schema(as = AtlasPoint)]
pub(crate) struct SpecialPointObject {
    /// Its kind.
    pub kind: PointKindName,
    /// [u, v], mm.
    #[schema(inline)]
    pub at: Pair,
}

/// Kind of a point: `cusp`, three solutions merge and the curve turns back; `crossing`, two curves cross; `corner`,
/// curves end together or a curve has a corner; `tangency`, a curve touches another one and ends there; `isolated`,
/// solutions merge at this point only; `self_motion`, the platform can move while all sliders stand: solutions form a
/// curve, and the point has no number of solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = AtlasPointKind)]
pub(crate) enum PointKindName {
    /// The curve turns back.
    Cusp,
    /// Two curves cross.
    Crossing,
    /// Curves end together.
    Corner,
    /// A curve touches another one and ends.
    Tangency,
    /// Solutions merge at this point only.
    Isolated,
    /// Solutions form a curve.
    SelfMotion,
}

/// A region in which the number of solutions is constant.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = AtlasRegion)]
pub(crate) struct RegionObject {
    /// Number of solutions.
    pub solutions: usize,
    #[serde(flatten)]
    pub face: FaceObject,
}

/// The part of the window with a solution in the working mode.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = AtlasWorkingDomain)]
pub(crate) struct WorkingObject {
    /// Area of all its pieces, mm².
    pub area: f64,
    /// Its pieces.
    pub regions: Vec<FaceObject>,
}

/// A polygon with holes; the last corner of a ring joins the first.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = AtlasFace)]
pub(crate) struct FaceObject {
    /// Area within the true curves, mm².
    pub area: f64,
    /// Estimate of the area's error, from the deviation in the middle of each side, mm².
    pub area_error: f64,
    /// [u, v] of a point in its interior, far from its sides: a place for a label, mm.
    #[schema(inline)]
    pub label: Pair,
    /// Corners [u, v], mm; counter-clockwise.
    #[schema(inline)]
    pub outer: Vec<Pair>,
    /// Corners of each hole; clockwise.
    #[schema(inline)]
    pub holes: Vec<Vec<Pair>>,
}

impl PointKindName {
    /// The kind in words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::Crossing => "crossing",
            Self::Corner => "corner",
            Self::Tangency => "tangency",
            Self::Isolated => "isolated point",
            Self::SelfMotion => "self-motion",
        }
    }
}

impl SpaceName {
    /// The name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Platform => "platform",
            Self::Joints => "joints",
        }
    }

    /// The meanings of u and v.
    pub(crate) fn coordinates(self) -> [&'static str; 2] {
        match self {
            Self::Platform => ["x", "y"],
            Self::Joints => ["rho2 - rho1", "rho3 - rho1"],
        }
    }
}

impl From<SpaceName> for Space {
    fn from(name: SpaceName) -> Self {
        match name {
            SpaceName::Platform => Self::Platform,
            SpaceName::Joints => Self::Joints,
        }
    }
}

impl AtlasObject {
    /// The solver's atlas as JSON.
    pub(crate) fn new(machine: MachineId, space: SpaceName, request: &AtlasRequest, atlas: Atlas) -> Self {
        let Atlas { curves, points, regions, working, checked_points } = atlas;
        let points = points.into_iter();
        let regions = regions.into_iter();
        let working: Vec<FaceObject> = working.into_iter().map(FaceObject::from).collect();
        Self {
            space,
            machine,
            coordinates: space.coordinates(),
            window: request.window.into(),
            tolerance: request.tolerance,
            curves: curves.into_iter().map(CurveObject::from).collect(),
            points: points
                .map(|point| SpecialPointObject { kind: point.kind.into(), at: FixedArray(point.at) })
                .collect(),
            regions: regions
                .map(|region| RegionObject { solutions: region.solutions, face: region.face.into() })
                .collect(),
            working: WorkingObject { area: working.iter().map(|face| face.area).sum(), regions: working },
            checked_points,
        }
    }
}

impl From<Window> for WindowObject {
    fn from(window: Window) -> Self {
        Self { u: FixedArray(window.u), v: FixedArray(window.v) }
    }
}

impl From<Curve> for CurveObject {
    fn from(curve: Curve) -> Self {
        Self { kind: curve.kind.into(), closed: curve.closed, points: pairs(curve.points) }
    }
}

impl From<Face> for FaceObject {
    fn from(face: Face) -> Self {
        Self {
            area: face.area,
            area_error: face.area_error,
            label: FixedArray(face.label),
            outer: pairs(face.outer),
            holes: face.holes.into_iter().map(pairs).collect(),
        }
    }
}

impl From<CurveKind> for CurveKindName {
    fn from(kind: CurveKind) -> Self {
        match kind {
            CurveKind::LegOne => Self::LegOne,
            CurveKind::LegTwo => Self::LegTwo,
            CurveKind::LegThree => Self::LegThree,
            CurveKind::Parallel => Self::Parallel,
            CurveKind::Constraint => Self::Constraint,
        }
    }
}

impl From<PointKind> for PointKindName {
    fn from(kind: PointKind) -> Self {
        match kind {
            PointKind::Cusp => Self::Cusp,
            PointKind::Crossing => Self::Crossing,
            PointKind::Corner => Self::Corner,
            PointKind::Tangency => Self::Tangency,
            PointKind::Isolated => Self::Isolated,
            PointKind::SelfMotion => Self::SelfMotion,
        }
    }
}

fn pairs(points: Vec<[f64; 2]>) -> Vec<Pair> {
    points.into_iter().map(FixedArray).collect()
}

//! The answer of `/workspace/{id}/slice`.

use serde::Serialize;
use utoipa::ToSchema;
use verne_solver::workspace::{Contour, Polygon, Slice};

use crate::wire::degrees::to_degrees;
use crate::wire::fixed_array::{FixedArray, Pair};
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::{CanonicalWorkspace, FrameName};

/// Slice of a workspace at one height.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Slice)]
pub(crate) struct SliceObject {
    /// Id of the workspace.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The frame of z and of the points.
    pub frame: FrameName,
    /// Height of the cut, mm.
    pub z: f64,
    /// Greatest distance between the polygons and the true boundary, mm.
    pub tolerance: f64,
    /// Area of all polygons, mm².
    pub area: f64,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// The polygons of the cut; none if the plane misses the workspace.
    pub polygons: Vec<PolygonObject>,
    /// Lines of constant alpha within the cut. Only answers to requests with `alpha` have them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contours: Vec<ContourObject>,
}

/// A polygon with holes; the last corner joins the first.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Polygon)]
pub(crate) struct PolygonObject {
    /// Corners [x, y], mm; counter-clockwise.
    #[schema(inline)]
    pub outer: Vec<Pair>,
    /// Corners of each hole; clockwise.
    #[schema(inline)]
    pub holes: Vec<Vec<Pair>>,
    /// Area without the holes, mm².
    pub area: f64,
}

/// A line on which alpha is constant.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = AlphaLine)]
pub(crate) struct ContourObject {
    /// alpha, degrees.
    pub alpha: f64,
    /// [x, y] along the line, mm.
    #[schema(inline)]
    pub points: Vec<Pair>,
}

impl SliceObject {
    /// The solver's slice in the wire's units.
    pub(crate) fn new(id: ResultId, request: &CanonicalWorkspace, z: f64, slice: Slice) -> Self {
        Self {
            id,
            frame: request.kind.frame(),
            z,
            tolerance: request.tolerance,
            area: slice.area(),
            not_checked: request.not_checked(),
            polygons: slice.polygons.into_iter().map(PolygonObject::from).collect(),
            contours: slice.contours.into_iter().map(ContourObject::from).collect(),
        }
    }
}

impl SliceObject {
    /// The slice of a region of origins whose mesh has this cell.
    pub(crate) fn of_origins(id: ResultId, cell: f64, z: f64, slice: Slice) -> Self {
        Self {
            id,
            frame: FrameName::Part,
            z,
            tolerance: cell,
            area: slice.area(),
            not_checked: Unchecked::beside(false),
            polygons: slice.polygons.into_iter().map(PolygonObject::from).collect(),
            contours: Vec::new(),
        }
    }
}

impl From<Polygon> for PolygonObject {
    fn from(polygon: Polygon) -> Self {
        let rings = std::iter::once(&polygon.outer).chain(&polygon.holes);
        Self {
            area: rings.map(|ring| signed_area(ring)).sum(),
            outer: pairs(polygon.outer),
            holes: polygon.holes.into_iter().map(pairs).collect(),
        }
    }
}

impl From<Contour> for ContourObject {
    fn from(contour: Contour) -> Self {
        Self { alpha: to_degrees(contour.alpha), points: pairs(contour.points) }
    }
}

fn pairs(points: Vec<[f64; 2]>) -> Vec<Pair> {
    points.into_iter().map(FixedArray).collect()
}

/// The area of a ring, positive if it is counter-clockwise. The first corner is the reference: coordinates far from the
/// origin would lose digits.
fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let Some(&[x, y]) = ring.first() else { return 0.0 };
    ring.windows(2)
        .map(|side| (side[0][0] - x) * (side[1][1] - y) - (side[1][0] - x) * (side[0][1] - y))
        .sum::<f64>()
        / 2.0
}

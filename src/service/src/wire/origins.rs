//! `POST /toolpath/origins`.

use serde::de::MapAccess;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use crate::wire::answer::MachineId;
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::dexterity::GridObject;
use crate::wire::format::SliceFormat;
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath_with::{MoreFields, ToolpathWith, read_once};
use crate::wire::workspace_summary::BoundsObject;

/// A request for a region of origins.
pub(crate) type OriginsBody = ToolpathWith<OriginsFields>;

/// The fields of a region of origins beside those of its tool path.
#[derive(Clone, Debug, Default, ToSchema)]
pub(crate) struct OriginsFields {
    /// Step of the grid from which the surface is made, mm. The default is 20.
    #[schema(minimum = 1, maximum = 1000, nullable = false)]
    pub cell: Option<f64>,
}

impl MoreFields for OriginsFields {
    const REQUEST: &'static str = "OriginsRequest";
    const DESCRIPTION: &'static str =
        "A request for the region of origins. x, y and z of `setup` have no effect.";

    const NAMES: &'static [&'static str] = &["cell"];

    fn read<'de, A: MapAccess<'de>>(&mut self, name: &'static str, map: &mut A) -> Result<(), A::Error> {
        read_once(&mut self.cell, name, map)
    }
}

/// The request for a region of origins with its default values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalOriginsRequest)]
pub(crate) struct CanonicalOrigins {
    /// The tool path, with its origin at zero.
    pub toolpath: CanonicalToolpath,
    /// Step of the grid, mm.
    pub cell: f64,
}

/// The region of origins: all x, y, z of `setup`, with all else fixed, at which the machine can follow the whole
/// program.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct OriginsSummary {
    /// BLAKE3 hash of the request, the machine, the program and the version of the service. Equal requests have equal
    /// ids.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The machine.
    pub machine: MachineId,
    /// The id of the program.
    #[schema(value_type = String)]
    pub program: ResultId,
    /// The request with its default values.
    pub request: CanonicalOrigins,
    /// Volume within the surface, mm³.
    pub volume: f64,
    /// By how much the volume differs at most from the region's, if the surface is within `boundary_error` of the
    /// boundary, mm³.
    pub volume_error: f64,
    /// Least and greatest coordinates of the mesh, mm; null if the region is empty.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// The grid of origins; its counts are 0 if the region is empty.
    pub grid: GridObject,
    /// Number of places of the program, at most so far apart that the boundary is off by about `place_tolerance`.
    pub places: usize,
    /// Number of the places that limit the region. If they are not all, they were found in many directions from the
    /// middle of the region, with all places.
    pub limiting_places: usize,
    /// About how far the boundary is off because the program is examined at places, mm.
    pub place_tolerance: f64,
    /// Greatest distance between the mesh and the boundary of the region, mm: one and a half times the greatest
    /// distance from the mesh at which one of `samples` origins was on its wrong side, and at least the distance at
    /// which the refinement of the mesh ends. It is measured, not proved. Pieces of the region, and gaps in it, that
    /// are narrower than a cell may be missing.
    pub boundary_error: f64,
    /// Number of origins near the mesh at which it was compared with the region.
    pub samples: u32,
    /// Conditions that the service did not check. Rapids in which the table changes its orientation are not checked
    /// either: /toolpath does.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Paths of the results.
    pub links: OriginsLinks,
}

/// Paths of a region of origins.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct OriginsLinks {
    /// This summary.
    #[serde(rename = "self")]
    pub itself: String,
    /// The mesh of the region.
    pub mesh: String,
    /// Slices of the region; they need `z`.
    pub slice: String,
}

/// Parameters of GET /toolpath/{id}/slice.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct OriginsSliceQuery {
    /// z of the origins, mm.
    #[param(minimum = -1e7, maximum = 1e7)]
    pub z: f64,
    /// Return the slice in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<SliceFormat>,
}

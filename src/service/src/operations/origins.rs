//! Computes the region of origins of a program: its parts, and their merging to summary and mesh.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use verne_mesh::{Mesh, Swatch};
use verne_program::Program;
use verne_solver::toolpath::{
    ORIGIN_SAMPLES, OriginExtent, OriginRegion, OriginRequest, OriginSlab, OriginSurvey, merge_origins,
    origin_slab, slice_origins,
};
use verne_solver::workspace::dexterity::Crossing;
use verne_solver::workspace::{Observer, Slice};

use crate::operations::drawing;
use crate::operations::observers::section;
use crate::operations::origins_question::OriginsQuestion;
use crate::operations::program_motions::adjustable::AdjustableMotions;
use crate::operations::solver_errors::{MAX_GRID_POINTS, too_many_grid_points, workspace_error};
use crate::wire::dexterity::GridObject;
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::format::SliceFormat;
use crate::wire::json::write_json;
use crate::wire::limit::Unchecked;
use crate::wire::origins::{OriginsLinks, OriginsSummary};
use crate::wire::result_id::ResultId;
use crate::wire::slice::SliceObject;
use crate::wire::workspace_summary::BoundsObject;

/// About how far the boundary is off because the program is examined at places, mm.
const PLACE_TOLERANCE: f64 = 0.02;

/// Fractions of the work after which the survey, and the slabs of the grid, are finished.
const SURVEYED: f64 = 0.1;
const GRIDDED: f64 = 0.4;

/// The part of a region that is computed by itself: one of `count` slabs of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct OriginsPart {
    /// The slab's number, from 0.
    pub number: u32,
    /// How many slabs the grid has.
    pub count: u32,
}

/// The extent of a region as it is stored.
#[derive(Serialize, Deserialize)]
struct StoredExtent {
    places: Vec<u32>,
    bounds: Option<[[f64; 3]; 2]>,
}

/// About the bytes of a summary, and of a slice.
const SUMMARY_BYTES: usize = 2048;
const SLICE_BYTES: usize = 16 * 1024;

/// A part as it is stored.
#[derive(Serialize, Deserialize)]
struct StoredPart {
    layers: [u32; 2],
    inside: Vec<bool>,
    crossings: Vec<(u64, [f64; 3])>,
}

/// A computed region.
pub(crate) struct OriginsMap {
    /// The summary, as it is sent.
    pub summary: Vec<u8>,
    /// The surface.
    pub mesh: Mesh,
}

/// Surveys the program. `stored` is the result of [`pack_extent`] in another part of the computation.
pub(crate) fn survey(
    question: &OriginsQuestion,
    program: &Arc<Program>,
    stored: Option<&[u8]>,
    observer: &dyn Observer,
) -> Result<OriginSurvey, OperationError> {
    let toolpath = &question.toolpath;
    let motions = toolpath.motions(program).map_err(OperationError::ProgramFaults)?;
    let motions = AdjustableMotions::new(motions, toolpath.request.setup, toolpath.one_tool_length());
    let request = OriginRequest { cell: question.cell, place_tolerance: PLACE_TOLERANCE };
    let options = toolpath.plan_options();
    let known = stored.and_then(|bytes| postcard::from_bytes(bytes).ok());
    let known = known.map(|StoredExtent { places, bounds }| OriginExtent { places, bounds });
    let survey =
        OriginSurvey::new(&toolpath.machine, &motions, motions.set_up(), &request, &options, known, observer);
    let survey = survey.map_err(workspace_error)?;
    if survey.grid.nodes() > MAX_GRID_POINTS {
        return Err(too_many_grid_points(survey.grid.nodes()));
    }
    Ok(survey)
}

/// What took long in a survey, for other parts of the computation.
pub(crate) fn pack_extent(survey: &OriginSurvey) -> Result<Vec<u8>, OperationError> {
    let OriginExtent { places, bounds } = survey.extent().clone();
    postcard::to_stdvec(&StoredExtent { places, bounds }).map_err(|_| OperationError::Internal)
}

/// Computes a part of a region.
pub(crate) fn compute_part(
    question: &OriginsQuestion,
    survey: &OriginSurvey,
    OriginsPart { number, count }: OriginsPart,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let layers = survey.grid.layers_of_slab(number, count);
    let slab = origin_slab(&question.toolpath.machine, survey, layers, observer).map_err(workspace_error)?;
    let crossings = slab.crossings.into_iter().map(|crossing| (crossing.edge, crossing.at)).collect();
    let stored = StoredPart { layers: [slab.layers.start, slab.layers.end], inside: slab.inside, crossings };
    postcard::to_stdvec(&stored).map_err(|_| OperationError::Internal)
}

fn read_part(bytes: &[u8]) -> Result<OriginSlab, OperationError> {
    let StoredPart { layers: [start, end], inside, crossings } =
        postcard::from_bytes(bytes).map_err(|_| OperationError::Internal)?;
    let crossings = crossings.into_iter().map(|(edge, at)| Crossing { edge, at }).collect();
    Ok(OriginSlab { layers: start..end, inside, crossings })
}

/// Merges a region from its slabs, in any order. Call it on the compute pool.
pub(crate) fn merge_parts(
    question: &OriginsQuestion,
    survey: &OriginSurvey,
    slabs: &[impl AsRef<[u8]>],
    observer: &dyn Observer,
) -> Result<OriginsMap, OperationError> {
    let slabs = slabs.iter().map(|slab| read_part(slab.as_ref())).collect::<Result<_, _>>()?;
    let machine = &question.toolpath.machine;
    let region = merge_origins(machine, survey, slabs, observer).map_err(workspace_error)?;
    let mesh = mesh(&region)?;
    let summary = write_json(&summary(question, survey, &region, &mesh), SUMMARY_BYTES)?;
    Ok(OriginsMap { summary, mesh })
}

/// Computes a region, without a store for the results of its parts.
pub(crate) fn compute_origins(
    question: &OriginsQuestion,
    program: &Arc<Program>,
    observer: &dyn Observer,
) -> Result<OriginsMap, OperationError> {
    let survey = survey(question, program, None, &section(observer, 0.0, SURVEYED))?;
    let whole = OriginsPart { number: 0, count: 1 };
    let slab = compute_part(question, &survey, whole, &section(observer, SURVEYED, GRIDDED))?;
    merge_parts(question, &survey, &[slab], &section(observer, GRIDDED, 1.0))
}

fn mesh(region: &OriginRegion) -> Result<Mesh, OperationError> {
    let palette = vec![Swatch { name: "origins".to_owned(), rgb: [0, 158, 115] }];
    let palette = if region.triangles.is_empty() { Vec::new() } else { palette };
    let tags = vec![0; region.triangles.len()];
    Mesh::new(region.positions.clone(), region.triangles.clone(), tags, palette)
        .map_err(|_| OperationError::Internal)
}

fn summary(
    question: &OriginsQuestion,
    survey: &OriginSurvey,
    region: &OriginRegion,
    mesh: &Mesh,
) -> OriginsSummary {
    let path = question.id.toolpath();
    let [places, limiting_places] = survey.place_counts();
    OriginsSummary {
        id: question.id,
        machine: question.toolpath.machine.id.clone(),
        program: question.toolpath.request.program,
        request: question.request(),
        volume: region.volume(),
        volume_error: region.volume_error(),
        bounds: mesh.bounds().map(BoundsObject::from),
        vertices: mesh.positions().len(),
        triangles: mesh.triangles().len(),
        grid: GridObject::from(&survey.grid),
        places,
        limiting_places,
        place_tolerance: PLACE_TOLERANCE,
        boundary_error: region.error,
        samples: if region.triangles.is_empty() { 0 } else { ORIGIN_SAMPLES },
        not_checked: Unchecked::beside(question.toolpath.request.table_clearance.is_some()),
        links: OriginsLinks { mesh: format!("{path}/mesh"), slice: format!("{path}/slice"), itself: path },
    }
}

/// Cuts a region at a height. Call it on the compute pool.
pub(crate) fn slice_of_origins(
    id: ResultId,
    cell: f64,
    mesh: &Mesh,
    z: f64,
    format: SliceFormat,
) -> Result<Vec<u8>, OperationError> {
    let mut faults = FieldErrors::default();
    faults.length("/z", z);
    faults.into_result()?;
    let z = z + 0.0;
    let polygons = slice_origins(mesh.positions(), mesh.triangles(), z);
    let cut = SliceObject::of_origins(id, cell, z, Slice { polygons, contours: Vec::new() });
    let title = format!("region of origins at z = {z} mm");
    match format {
        SliceFormat::Json => write_json(&cut, SLICE_BYTES),
        SliceFormat::Svg => Ok(drawing::slice::svg(&cut, &title).into_bytes()),
        SliceFormat::Dxf => Ok(drawing::slice::dxf(&cut, &title).into_bytes()),
    }
}

#[cfg(test)]
#[allow(clippy::panic, clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

//! Merges an error map from the results of its subtasks: summary, meshes and grid points.

use verne_mesh::Mesh;
use verne_solver::Point;
use verne_solver::workspace::Observer;
use verne_solver::workspace::dexterity::Grid;
use verne_solver::workspace::error_map::{ErrorMapRequest, NodeErrors, PointErrors, largest};

use crate::operations::error_map_colours::banded_mesh;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::error_map_subtasks::{
    ErrorSurface, compute_slab, compute_surface, grid, read_slab, read_surface,
};
use crate::operations::observers::{equal_section, section};
use crate::operations::solver_errors::workspace_error;
use crate::operations::subtask::{Subtask, SubtaskRequest};
use crate::wire::degrees::to_degrees;
use crate::wire::dexterity::GridObject;
use crate::wire::error::OperationError;
use crate::wire::error_map::{
    ErrorCells, ErrorColumns, ErrorMapLinks, ErrorMapSummary, ErrorName, ErrorRange, ErrorRanges,
};
use crate::wire::fixed_array::FixedArray;
use crate::wire::json::write_json;
use crate::wire::workspace_summary::BoundsObject;

/// About the bytes of a summary.
const SUMMARY_BYTES: usize = 2048;

/// About the bytes of a point with its errors.
const POINT_BYTES: usize = 96;

/// The fraction of the work that the subtasks take.
const BY_SUBTASKS: f64 = 0.9;

/// A computed map.
pub(crate) struct ErrorMap {
    /// The summary, as it is sent.
    pub summary: Vec<u8>,
    /// The errors at the points of the grid, as they are sent.
    pub cells: Vec<u8>,
    /// The surface in bands of each error, in the order of [`ErrorName::ALL`].
    pub meshes: [Mesh; 4],
}

/// Computes a map, without a store for the results of its subtasks.
pub(crate) fn compute_error_map(
    question: &ErrorMapQuestion,
    observer: &dyn Observer,
) -> Result<ErrorMap, OperationError> {
    let subtasks = Subtask::of_error_map(question);
    let (mut slabs, mut surface) = (Vec::new(), Vec::new());
    let computing = section(observer, 0.0, BY_SUBTASKS);
    for (i, subtask) in subtasks.iter().enumerate() {
        let part = equal_section(&computing, i, subtasks.len());
        match subtask.request {
            SubtaskRequest::ErrorSlab { number, count, .. } => {
                slabs.push(compute_slab(question, [number, count], &part)?);
            }
            SubtaskRequest::ErrorSurface(_) => surface = compute_surface(question, usize::MAX, &part)?,
            _ => return Err(OperationError::Internal),
        }
    }
    merge_error_map(question, &slabs, &surface, &section(observer, BY_SUBTASKS, 1.0))
}

/// Merges a map from its slabs, in their order, and its surface. Call it on the compute pool.
pub(crate) fn merge_error_map(
    question: &ErrorMapQuestion,
    slabs: &[impl AsRef<[u8]>],
    surface: &[u8],
    observer: &dyn Observer,
) -> Result<ErrorMap, OperationError> {
    let slabs = slabs.iter().map(|slab| read_slab(slab.as_ref()));
    let nodes = slabs.collect::<Result<Vec<_>, _>>()?.concat();
    let (grid, surface) = (grid(question, observer)?, read_surface(surface)?);
    let [a, b, c, d] = ErrorName::ALL.map(|error| banded_mesh(&surface, error));
    let meshes = [a?, b?, c?, d?];
    let examined = Examined::new(question, &grid, &nodes, &surface)?;
    let ranges = examined.ranges(observer)?;
    let summary = summary(question, &grid, nodes.len(), &surface, ranges, &meshes[0]);
    let cells = write_json(&cells(question, &grid, &nodes), POINT_BYTES * nodes.len())?;
    Ok(ErrorMap { summary: write_json(&summary, SUMMARY_BYTES)?, cells, meshes })
}

/// All points whose errors are known.
struct Examined<'a> {
    question: &'a ErrorMapQuestion,
    request: ErrorMapRequest,
    points: Vec<(Point, PointErrors)>,
}

impl<'a> Examined<'a> {
    fn new(
        question: &'a ErrorMapQuestion,
        grid: &Grid,
        nodes: &[NodeErrors],
        surface: &ErrorSurface,
    ) -> Result<Self, OperationError> {
        let of_grid = nodes.iter().map(|found| (position(grid, found.node), found.errors));
        let vertices = surface.positions.iter().copied().zip(surface.errors());
        let of_surface = vertices.filter_map(|(at, errors)| Some((at, errors?)));
        let points = of_grid.chain(of_surface).collect();
        Ok(Self { question, request: question.solver_request()?, points })
    }

    fn ranges(&self, observer: &dyn Observer) -> Result<Option<ErrorRanges>, OperationError> {
        let [Some(tip_rms), Some(tip_worst), Some(axis_rms), Some(axis_worst)] = [
            self.range(ErrorName::TipRms, observer)?,
            self.range(ErrorName::TipWorst, observer)?,
            self.range(ErrorName::AxisRms, observer)?,
            self.range(ErrorName::AxisWorst, observer)?,
        ] else {
            return Ok(None);
        };
        Ok(Some(ErrorRanges { tip_rms, tip_worst, axis_rms, axis_worst }))
    }

    /// `None` without points.
    fn range(&self, error: ErrorName, observer: &dyn Observer) -> Result<Option<ErrorRange>, OperationError> {
        let machine = &self.question.machine;
        let found = largest(machine, &self.request, error.kind(), &self.points, observer);
        let Some(found) = found.map_err(workspace_error)? else { return Ok(None) };
        let values = self.points.iter().map(|(_, errors)| errors.of(error.kind()));
        let least = on_wire(error, values.fold(f64::INFINITY, f64::min));
        Ok(Some(ErrorRange { least, largest: on_wire(error, found.value), at: FixedArray(found.at) }))
    }
}

/// An error in mm or degrees.
fn on_wire(error: ErrorName, value: f64) -> f64 {
    if error.is_angle() { to_degrees(value) } else { value }
}

fn position(grid: &Grid, node: u32) -> Point {
    let [_, across, up] = grid.counts.map(|count| count.max(1));
    grid.node([node / up / across, node / up % across, node % up])
}

fn summary(
    question: &ErrorMapQuestion,
    grid: &Grid,
    inside: usize,
    surface: &ErrorSurface,
    errors: Option<ErrorRanges>,
    mesh: &Mesh,
) -> ErrorMapSummary {
    let path = question.id.path();
    let workspace = &question.request.workspace;
    ErrorMapSummary {
        id: question.id,
        request: question.request,
        machine: question.machine.id.clone(),
        frame: workspace.kind.frame(),
        grid: GridObject::from(grid),
        inside,
        errors,
        bounds: mesh.bounds().map(BoundsObject::from),
        vertices: mesh.positions().len(),
        unbounded: surface.errors().filter(Option::is_none).count(),
        triangles: mesh.triangles().len(),
        not_checked: workspace.not_checked(),
        links: ErrorMapLinks { mesh: format!("{path}/mesh"), cells: format!("{path}/cells"), itself: path },
    }
}

fn cells(question: &ErrorMapQuestion, grid: &Grid, nodes: &[NodeErrors]) -> ErrorCells {
    let column =
        |error: ErrorName| nodes.iter().map(|found| on_wire(error, found.errors.of(error.kind()))).collect();
    ErrorCells {
        id: question.id,
        grid: GridObject::from(grid),
        points: nodes.iter().map(|found| found.node).collect(),
        errors: ErrorColumns {
            tip_rms: column(ErrorName::TipRms),
            tip_worst: column(ErrorName::TipWorst),
            axis_rms: column(ErrorName::AxisRms),
            axis_worst: column(ErrorName::AxisWorst),
        },
    }
}

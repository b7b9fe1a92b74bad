//! `/workspace`: volume, area, surface.

use verne_mesh::Mesh;
use verne_solver::workspace::{Measure, Observer, Request, Surface, Volume, agree, measure, surface_within};

use crate::operations::subprogress::Stage;
use crate::operations::workspace_colours::coloured;
use crate::operations::workspace_question::{WorkspaceQuestion, workspace_error};
use crate::wire::error::OperationError;
use crate::wire::fixed_array::Exactly;
use crate::wire::json::write_json;
use crate::wire::workspace_summary::{BoundsObject, Links, WorkspaceSummary};

/// Part of the work that the volume is, for the progress.
const MEASURING: f64 = 0.3;

/// About the bytes of a summary.
const SUMMARY_BYTES: usize = 1024;

const FOLDED: &str = "the workspace folds: some of its positions are reached from two platform positions, so that the \
                      integral is not the volume of the set";

const THIN: &str = "the workspace is thinner than the tolerance: it has no triangles";

/// A computed workspace.
#[derive(Debug)]
pub(crate) struct Workspace {
    /// The figures, as they are sent.
    pub summary: Vec<u8>,
    /// The surface.
    pub mesh: Mesh,
    /// Greatest |alpha|, rad; nothing for an empty workspace.
    pub inclination: Option<f64>,
}

/// Computes a workspace, whose mesh may have so many triangles; to be called on the worker threads.
pub(crate) fn compute_workspace(
    question: &WorkspaceQuestion,
    most: usize,
    observer: &dyn Observer,
) -> Result<Workspace, OperationError> {
    let (machine, request) = (&question.published.machine, Request::from(&question.request));
    let measuring = Stage::of(observer, 0.0, MEASURING);
    let measure = measure(machine, &request, &measuring).map_err(workspace_error)?;
    let meshing = Stage::of(observer, MEASURING, 1.0);
    let surface = surface_within(machine, &request, most, &meshing).map_err(workspace_error)?;
    agree(&measure, &surface, request.tolerance, &meshing).map_err(workspace_error)?;
    go_on(observer)?;
    let mesh = meshed(surface)?;
    go_on(observer)?;
    let summary = write_json(&summarised(question, &measure, &mesh), SUMMARY_BYTES)?;
    Ok(Workspace { summary, mesh, inclination: measure.inclination })
}

fn go_on(observer: &dyn Observer) -> Result<(), OperationError> {
    if observer.cancelled() { Err(OperationError::Cancelled) } else { Ok(()) }
}

fn meshed(surface: Surface) -> Result<Mesh, OperationError> {
    let (tags, palette) = coloured(&surface.bindings);
    let mesh = Mesh::new(surface.positions, surface.triangles, tags, palette)
        .map_err(|_| OperationError::Internal)?;
    debug_assert!(mesh.audit().is_watertight(), "{:?}", mesh.audit());
    Ok(mesh)
}

/// Why there is no volume, or no mesh though there is a workspace.
fn explained(measure: &Measure, mesh: &Mesh) -> Option<&'static str> {
    if measure.folded() {
        Some(FOLDED)
    } else if mesh.triangles().is_empty() && measure.area > measure.area_error {
        Some(THIN)
    } else {
        None
    }
}

fn summarised(question: &WorkspaceQuestion, measure: &Measure, mesh: &Mesh) -> WorkspaceSummary {
    let (volume, volume_error) = match measure.volume {
        Volume::Value { value, error } => (Some(value), Some(error)),
        Volume::Folded => (None, None),
    };
    let bounds =
        mesh.bounds().map(|bounds| BoundsObject { min: Exactly(bounds.min), max: Exactly(bounds.max) });
    WorkspaceSummary {
        id: question.id.to_string(),
        kind: question.request.kind,
        frame: question.request.kind.frame(),
        request: question.request,
        machine: question.published.id.clone(),
        volume,
        volume_error,
        area: measure.area,
        area_error: measure.area_error,
        bounds,
        vertices: mesh.positions().len(),
        triangles: mesh.triangles().len(),
        folded: measure.folded(),
        not_checked: question.request.not_checked(),
        explanation: explained(measure, mesh),
        links: Links::of(question.id),
    }
}

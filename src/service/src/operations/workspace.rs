//! Computes a workspace: volume, area and surface, and their summary.

use verne_mesh::Mesh;
use verne_solver::workspace::{Measure, Observer, Request, Surface, agree, measure, surface_within};

use crate::operations::observers::section;
use crate::operations::solver_errors::workspace_error;
use crate::operations::workspace_colours::tags_and_palette;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::workspace_summary::{BoundsObject, Links, WorkspaceSummary, value_and_error};

/// The volume's fraction of the work, for the progress.
const VOLUME_FRACTION: f64 = 0.3;

/// About the bytes of a summary.
const SUMMARY_BYTES: usize = 1024;

const FOLDED: &str = "the workspace folds: some of its positions are reached from two platform positions, so that the \
                      integral is not the volume of the set";

const THIN: &str = "the workspace is thinner than the tolerance: it has no triangles";

/// A computed workspace.
#[derive(Debug)]
pub(crate) struct Workspace {
    /// The summary, as it is sent.
    pub summary: Vec<u8>,
    /// The surface.
    pub mesh: Mesh,
    /// Greatest |alpha|, rad; none for an empty workspace.
    pub inclination: Option<f64>,
}

/// Computes a workspace. Call it on the compute pool.
///
/// # Errors
///
/// The mesh has more than `max_triangles` triangles, or the solver refuses the request.
pub(crate) fn compute_workspace(
    question: &WorkspaceQuestion,
    max_triangles: usize,
    observer: &dyn Observer,
) -> Result<Workspace, OperationError> {
    let (machine, request) = (&question.machine, Request::from(&question.request));
    let measuring = section(observer, 0.0, VOLUME_FRACTION);
    let measure = measure(machine, &request, &measuring).map_err(workspace_error)?;
    let meshing = section(observer, VOLUME_FRACTION, 1.0);
    let surface = surface_within(machine, &request, max_triangles, &meshing).map_err(workspace_error)?;
    agree(&measure, &surface, request.tolerance, &meshing).map_err(workspace_error)?;
    check_cancelled(observer)?;
    let mesh = coloured_mesh(surface)?;
    check_cancelled(observer)?;
    let summary = write_json(&summary(question, &measure, &mesh), SUMMARY_BYTES)?;
    Ok(Workspace { summary, mesh, inclination: measure.inclination })
}

fn check_cancelled(observer: &dyn Observer) -> Result<(), OperationError> {
    if observer.cancelled() { Err(OperationError::Cancelled) } else { Ok(()) }
}

fn coloured_mesh(surface: Surface) -> Result<Mesh, OperationError> {
    let (tags, palette) = tags_and_palette(&surface.bindings);
    let mesh = Mesh::new(surface.positions, surface.triangles, tags, palette)
        .map_err(|_| OperationError::Internal)?;
    debug_assert!(mesh.audit().is_watertight(), "{:?}", mesh.audit());
    Ok(mesh)
}

/// Why the workspace has no volume, or no triangles although its area is not zero.
fn explanation(measure: &Measure, mesh: &Mesh) -> Option<&'static str> {
    if measure.folded() {
        Some(FOLDED)
    } else if mesh.triangles().is_empty() && measure.area > measure.area_error {
        Some(THIN)
    } else {
        None
    }
}

fn summary(question: &WorkspaceQuestion, measure: &Measure, mesh: &Mesh) -> WorkspaceSummary {
    let [volume, volume_error] = value_and_error(measure.volume);
    WorkspaceSummary {
        id: question.id,
        kind: question.request.kind,
        frame: question.request.kind.frame(),
        request: question.request,
        machine: question.machine.id.clone(),
        volume,
        volume_error,
        area: measure.area,
        area_error: measure.area_error,
        bounds: mesh.bounds().map(BoundsObject::from),
        vertices: mesh.positions().len(),
        triangles: mesh.triangles().len(),
        folded: measure.folded(),
        not_checked: question.request.not_checked(),
        explanation: explanation(measure, mesh),
        links: Links::of(question.id),
    }
}

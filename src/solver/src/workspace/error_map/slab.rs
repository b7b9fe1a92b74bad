//! Some layers of an error map's grid, independent of the others.

use std::ops::Range;

use rayon::prelude::*;

use super::errors::{Evaluation, PointErrors};
use super::request::ErrorMapRequest;
use crate::machine::Machine;
use crate::workspace::dexterity::Grid;
use crate::workspace::observer::{Observer, ProgressCounter, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// The errors at a node inside the workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeErrors {
    /// The number of the node in the grid.
    pub node: u32,
    /// The errors.
    pub errors: PointErrors,
}

/// Computes the errors at the nodes of some layers along the grid's first axis that are inside the workspace, in the
/// order of their numbers. Layers beyond the grid are left out.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is out of range.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::error_budget::Tolerances;
/// use verne_solver::parameter::Parameter;
/// use verne_solver::workspace::error_map::{ErrorMapRequest, error_grid, error_slab};
/// use verne_solver::workspace::{Kind, Request, Unobserved};
///
/// let (machine, workspace) = (Machine::verne(), Request::new(Kind::Platform, 20.0));
/// let request = ErrorMapRequest { workspace, tolerances: Tolerances::new([(Parameter::L1, 0.01)])?, cell: 100.0 };
/// let grid = error_grid(&machine, &request, &Unobserved)?;
/// let slab = |layers| error_slab(&machine, &request, &grid, layers, &Unobserved);
/// let all = slab(0..grid.counts[0])?;
/// assert!(!all.is_empty() && all.len() < grid.nodes());
/// assert_eq!(all, [slab(0..3)?, slab(3..grid.counts[0])?].concat());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn error_slab(
    machine: &Machine,
    request: &ErrorMapRequest,
    grid: &Grid,
    layers: Range<u32>,
    observer: &dyn Observer,
) -> Result<Vec<NodeErrors>, WorkspaceError> {
    request.check()?;
    check_cancelled(observer)?;
    let evaluation = Evaluation::new(machine, request);
    let layers = layers.start.min(grid.counts[0])..layers.end.min(grid.counts[0]);
    let [_, across, up] = grid.counts;
    let lines: Vec<[u32; 2]> = layers.flat_map(|i| (0..across).map(move |j| [i, j])).collect();
    let progress = ProgressCounter::new(observer, lines.len());
    let found: Vec<Vec<NodeErrors>> = lines
        .into_par_iter()
        .map(|[i, j]| {
            let mut line = Vec::new();
            for k in 0..up {
                check_cancelled(observer)?;
                if let Some(errors) = evaluation.inside(grid.node([i, j, k])) {
                    line.push(NodeErrors { node: (i * across + j) * up + k, errors });
                }
            }
            progress.finished(1);
            Ok(line)
        })
        .collect::<Result<_, WorkspaceError>>()?;
    Ok(found.concat())
}

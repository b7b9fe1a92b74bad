//! The request of a dexterity map.

use crate::request_range::MAX_INPUT;
use crate::workspace::request::WorkspaceError;

/// The request of a dexterity map: tool, range of inclinations, and grid. Lengths are millimetres, angles radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DexterityRequest {
    /// Tool length, measured from P.
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's joints over the table's plane. `None` means the machine's
    /// own value, if it has one.
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, for the height over the table's plane.
    pub tool_radius: f64,
    /// Azimuth of the tool in the part frame.
    pub phi2: f64,
    /// Range of inclinations in the part frame, `[from, to]`, at most a revolution apart.
    pub phi1: [f64; 2],
    /// Step of the grid.
    pub cell: f64,
}

/// Greatest number of nodes of a grid.
pub const MOST_NODES: f64 = 2e7;
/// Least step of a grid, mm.
const FINEST_CELL: f64 = 0.1;

impl DexterityRequest {
    /// A request without a tool: its length, its radius and phi2 are zero.
    ///
    /// # Units
    ///
    /// `phi1` is in radians, `cell` in mm.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::dexterity::DexterityRequest;
    ///
    /// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 20.0) };
    /// assert_eq!((request.phi2, request.table_clearance), (0.0, None));
    /// ```
    pub const fn new(phi1: [f64; 2], cell: f64) -> Self {
        Self { tool_length: 0.0, table_clearance: None, tool_radius: 0.0, phi2: 0.0, phi1, cell }
    }

    pub(super) fn check(&self) -> Result<(), WorkspaceError> {
        let [from, to] = self.phi1;
        let turn = (0.0..=std::f64::consts::TAU).contains(&(to - from));
        let checks = [
            ("tool_length", self.tool_length.abs() <= MAX_INPUT),
            ("table_clearance", self.table_clearance.is_none_or(|least| least.abs() <= MAX_INPUT)),
            ("tool_radius", self.tool_radius.abs() <= MAX_INPUT),
            ("phi2", self.phi2.abs() <= MAX_INPUT),
            ("phi1", from.abs() <= MAX_INPUT && to.abs() <= MAX_INPUT && turn),
            ("cell", (FINEST_CELL..=MAX_INPUT).contains(&self.cell)),
        ];
        match checks.into_iter().find(|(_, holds)| !holds) {
            Some((field, _)) => Err(WorkspaceError::OutOfDomain { field }),
            None => Ok(()),
        }
    }
}

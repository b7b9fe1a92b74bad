//! The grid of nodes over the reachable set.

use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use super::monotone_piece::MonotonePiece;
use super::request::{DexterityRequest, MOST_NODES};
use super::section::ToolWorkspace;
use crate::machine::Machine;
use crate::pose::Point;
use crate::workspace::observer::{Observer, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// Number of sections from which the extent of the reachable set is found.
const SECTIONS: u32 = 128;
/// Fraction of the set's size that is added on each side, for the set between the sections.
const ROOM: f64 = 0.02;

/// A grid of nodes in the part frame turned about Z by phi2. Its first axis is the machine's x, so a layer of nodes
/// is one section of the machine. Node (i, j, k) has the number (i · counts\[1\] + j) · counts\[2\] + k. Coordinates
/// are multiples of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Node (0, 0, 0) in the turned frame, mm.
    pub origin: Point,
    /// Distance between neighbours along each axis, mm.
    pub step: f64,
    /// Number of nodes along each axis. Zero if nothing is reachable.
    pub counts: [u32; 3],
    /// Angle from the part frame to the turned frame about Z: phi2, rad.
    pub turn: f64,
}

impl Grid {
    /// Places the grid over all reachable points, with at least one layer of nodes beyond them on each side. The
    /// extent is found from sections along x; it is generous, not exact.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Errors
    ///
    /// - [`WorkspaceError::OutOfDomain`]: a number is not finite or beyond [`MAX_INPUT`](crate::MAX_INPUT), the range
    ///   of phi1 is not ordered or longer than a revolution, or the cell is below 0.1 mm.
    /// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
    /// - [`WorkspaceError::TooManyNodes`]: the grid would have more nodes than [`MOST_NODES`]. No node has been
    ///   computed then.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), (27);
    /// the intervals are derived in the [workspace documentation](crate::workspace).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::dexterity::{DexterityRequest, Grid};
    /// use verne_solver::workspace::{Unobserved, WorkspaceError};
    ///
    /// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 200.0) };
    /// let machine = Machine::verne();
    /// let grid = Grid::new(&machine, &request, &Unobserved)?;
    /// assert!(grid.nodes() > 0);
    /// # Ok::<(), WorkspaceError>(())
    /// ```
    pub fn new(
        machine: &Machine,
        request: &DexterityRequest,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        request.check()?;
        let (step, turn) = (request.cell, request.phi2);
        let tool = ToolWorkspace::new(machine, request);
        let Some([low, high]) = extent(&tool, request.phi1, observer)? else {
            return Ok(Self::empty(step, turn));
        };
        let room = [0, 1, 2].map(|axis| ROOM * (high[axis] - low[axis]));
        Self::over([low, high], room, step, turn)
    }

    /// A grid without nodes.
    pub(crate) fn empty(step: f64, turn: f64) -> Self {
        Self { origin: [0.0; 3], step, counts: [0; 3], turn }
    }

    /// Places a grid over a box and over the room on each side of it, with at least one layer of nodes beyond.
    pub(crate) fn over(
        [low, high]: [Point; 2],
        room: Point,
        step: f64,
        turn: f64,
    ) -> Result<Self, WorkspaceError> {
        let first = [0, 1, 2].map(|axis| ((low[axis] - room[axis]) / step).floor() - 1.0);
        let last = [0, 1, 2].map(|axis| ((high[axis] + room[axis]) / step).ceil() + 1.0);
        let counts = [0, 1, 2].map(|axis| last[axis] - first[axis] + 1.0);
        let nodes = counts[0] * counts[1] * counts[2];
        if nodes > MOST_NODES {
            return Err(WorkspaceError::TooManyNodes { nodes });
        }
        Ok(Self { origin: first.map(|n| n * step), step, counts: counts.map(whole), turn })
    }

    /// The number of nodes.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::dexterity::Grid;
    ///
    /// let grid = Grid { origin: [0.0; 3], step: 10.0, counts: [2, 3, 4], turn: 0.0 };
    /// assert_eq!(grid.nodes(), 24);
    /// ```
    pub fn nodes(&self) -> usize {
        self.counts.iter().map(|&count| count as usize).product()
    }

    /// The layers of slab `number` of `count` slabs along the first axis. The slabs cover the grid, and no two share a
    /// layer.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::dexterity::Grid;
    ///
    /// let grid = Grid { origin: [0.0; 3], step: 10.0, counts: [5, 3, 4], turn: 0.0 };
    /// assert_eq!([0, 1].map(|number| grid.layers_of_slab(number, 2)), [0..2, 2..5]);
    /// ```
    pub fn layers_of_slab(&self, number: u32, count: u32) -> Range<u32> {
        let first = |number: u32| {
            let layers = u64::from(self.counts[0]) * u64::from(number) / u64::from(count.max(1));
            u32::try_from(layers).unwrap_or(u32::MAX)
        };
        first(number)..first(number + 1)
    }

    /// A node's position in the turned frame.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::dexterity::Grid;
    ///
    /// let grid = Grid { origin: [0.0, 5.0, 0.0], step: 10.0, counts: [2, 3, 4], turn: 0.0 };
    /// assert_eq!(grid.node([1, 2, 3]), [10.0, 25.0, 30.0]);
    /// ```
    pub fn node(&self, number: [u32; 3]) -> Point {
        [0, 1, 2].map(|axis| self.origin[axis] + self.step * f64::from(number[axis]))
    }

    /// Turns a point of the turned frame into the part frame: about Z by phi2.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::dexterity::Grid;
    ///
    /// let grid = Grid { origin: [0.0; 3], step: 10.0, counts: [2, 3, 4], turn: std::f64::consts::FRAC_PI_2 };
    /// let [x, y, z] = grid.in_part_frame([1.0, 0.0, 7.0]);
    /// assert!(x.abs() < 1e-15 && y == 1.0 && z == 7.0);
    /// ```
    pub fn in_part_frame(&self, [x, y, z]: Point) -> Point {
        let (s, c) = self.turn.sin_cos();
        [x * c - y * s, x * s + y * c, z]
    }

    /// Whether a node is one of the outermost. They count as outside of both regions.
    pub(crate) fn outermost(&self, number: [u32; 3]) -> bool {
        (0..3).any(|axis| number[axis] == 0 || number[axis] + 1 >= self.counts[axis])
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 2^32, and positive")]
fn whole(count: f64) -> u32 {
    count as u32
}

/// Finds a box in the turned frame that contains the reachable set; `None` if the set is empty.
fn extent(
    tool: &ToolWorkspace<'_>,
    phi1: [f64; 2],
    observer: &dyn Observer,
) -> Result<Option<[Point; 2]>, WorkspaceError> {
    let [low, high] = tool.domain.rectangle();
    let step = (high[0] - low[0]) / f64::from(SECTIONS);
    let mut found: Option<[Point; 2]> = None;
    for number in 0..=SECTIONS {
        check_cancelled(observer)?;
        let x = low[0] + step * f64::from(number);
        for piece in tool.section(x) {
            let [v1, mut z] = flat_extent(tool, &piece, phi1);
            if let Some(floor) = &tool.floor {
                z[0] = z[0].max(floor.lowest(phi1));
                if z[0] > z[1] {
                    continue;
                }
            }
            let [a, b] = found.unwrap_or([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]);
            found = Some([
                // A region of the set that begins between two sections begins less than a step away.
                [a[0].min(x - step), a[1].min(v1[0]), a[2].min(z[0])],
                [b[0].max(x + step), b[1].max(v1[1]), b[2].max(z[1])],
            ]);
        }
    }
    Ok(found)
}

/// The ranges of V1 and Z of a piece's outline, turned through the range of phi1.
fn flat_extent(tool: &ToolWorkspace<'_>, piece: &MonotonePiece, [from, to]: [f64; 2]) -> [[f64; 2]; 2] {
    let (mut v1, mut z) = ([f64::INFINITY, f64::NEG_INFINITY], [f64::INFINITY, f64::NEG_INFINITY]);
    for (eta, alpha, zetas) in piece.outline() {
        for zeta in zetas {
            let (radius, beta) = (eta.hypot(zeta), eta.atan2(-zeta));
            // psi = beta - alpha + phi1: the arc's ends, and the axes that it crosses.
            let [first, last] = [from, to].map(|phi1| beta - alpha + phi1);
            let mut reach = |psi: f64| {
                meet(&mut v1, -radius * psi.sin());
                meet(&mut z, tool.machine.table().dt + radius * psi.cos());
            };
            reach(first);
            // Counted: the angle of a quarter, divided by a quarter, may be rounded below its number.
            let mut quarter = (first / FRAC_PI_2).floor() + 1.0;
            while quarter * FRAC_PI_2 < last {
                reach(quarter * FRAC_PI_2);
                quarter += 1.0;
            }
            reach(last);
        }
    }
    [v1, z]
}

fn meet(range: &mut [f64; 2], value: f64) {
    *range = [range[0].min(value), range[1].max(value)];
}

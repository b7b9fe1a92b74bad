//! Crossings of the tetrahedra's edges with the regions' surfaces.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::grid::Grid;
use super::monotone_piece::MonotonePiece;
use super::nodes::{MapInput, Row};
use super::orientations::intervals_at;
use super::section::ToolWorkspace;
use crate::pose::Point;
use crate::workspace::observer::check_cancelled;
use crate::workspace::request::WorkspaceError;

/// The crossing of a grid edge with a region's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Seven times the number of the node where the edge begins, plus the edge's direction.
    pub edge: u64,
    /// Its position in the part frame, mm.
    pub at: Point,
}

/// The edges that begin at a node, as steps along the three axes: those of the six tetrahedra
/// around the cube's diagonal.
pub(crate) const EDGES: [[u32; 3]; 7] =
    [[0, 0, 1], [0, 1, 0], [0, 1, 1], [1, 0, 0], [1, 0, 1], [1, 1, 0], [1, 1, 1]];

/// Halvings of an edge.
const HALVINGS: u32 = 8;
/// Number of steps along an edge.
const STEPS: u32 = 1 << HALVINGS;

/// The sections between two layers at which edges are examined. All edges are halved at the same x, so few sections
/// serve them all.
pub(super) struct Sections<'a> {
    tool: &'a ToolWorkspace<'a>,
    first: &'a [MonotonePiece],
    between: Vec<OnceLock<Vec<MonotonePiece>>>,
    x: f64,
    step: f64,
}

impl<'a> Sections<'a> {
    pub(super) fn new(
        tool: &'a ToolWorkspace<'a>,
        grid: &Grid,
        layer: u32,
        first: &'a [MonotonePiece],
    ) -> Self {
        let between = (0..STEPS).map(|_| OnceLock::new()).collect();
        Self { tool, first, between, x: grid.node([layer, 0, 0])[0], step: grid.step }
    }

    /// The section after some steps of the way to the next layer.
    fn at(&self, step: u32) -> &[MonotonePiece] {
        if step == 0 {
            return self.first;
        }
        self.between[step as usize]
            .get_or_init(|| self.tool.section(self.x + self.step * f64::from(step) / f64::from(STEPS)))
    }
}

/// The crossings of the edges that begin in a layer, given its rows and the next layer's.
pub(super) fn crossings(
    input: &MapInput<'_>,
    sections: &Sections<'_>,
    layer: u32,
    rows: [&[Row]; 2],
) -> Result<[Vec<Crossing>; 2], WorkspaceError> {
    let [_, across, up] = input.grid.counts;
    let found: Vec<[Vec<Crossing>; 2]> = (0..across)
        .into_par_iter()
        .map(|j| {
            let mut found = [Vec::new(), Vec::new()];
            for k in 0..up {
                check_cancelled(input.observer)?;
                let start = rows[0][j as usize].inside[k as usize];
                for (direction, [di, dj, dk]) in (0_u64..).zip(EDGES) {
                    let row = rows[di as usize].get((j + dj) as usize);
                    let Some(&end) = row.and_then(|row| row.inside.get((k + dk) as usize)) else { continue };
                    for region in (0..2).filter(|&region| start[region] != end[region]) {
                        let edge =
                            Edge { from: [layer, j, k], steps: [di, dj, dk], starts_inside: start[region] };
                        let node = (u64::from(layer) * u64::from(across) + u64::from(j)) * u64::from(up)
                            + u64::from(k);
                        found[region].push(Crossing {
                            edge: 7 * node + direction,
                            at: input.crossing(sections, &edge, region)?,
                        });
                    }
                }
            }
            Ok(found)
        })
        .collect::<Result<_, WorkspaceError>>()?;
    let mut all = [Vec::new(), Vec::new()];
    for row in found {
        for (all, row) in all.iter_mut().zip(row) {
            all.extend(row);
        }
    }
    Ok(all)
}

struct Edge {
    from: [u32; 3],
    steps: [u32; 3],
    starts_inside: bool,
}

impl MapInput<'_> {
    /// Finds the crossing by bisection: the middle of the last step of the edge that the region's surface crosses.
    fn crossing(&self, sections: &Sections<'_>, edge: &Edge, region: usize) -> Result<Point, WorkspaceError> {
        let start = self.grid.node(edge.from);
        let along = |fraction: f64| {
            [0, 1, 2].map(|axis| start[axis] + self.grid.step * fraction * f64::from(edge.steps[axis]))
        };
        let (mut low, mut high) = (0, STEPS);
        while high - low > 1 {
            check_cancelled(self.observer)?;
            let middle = u32::midpoint(low, high);
            let [_, v1, z] = along(f64::from(middle) / f64::from(STEPS));
            let section = sections.at(if edge.steps[0] == 0 { 0 } else { middle });
            let found = intervals_at(self.tool, section, [v1, z], self.request.phi1);
            let ends: Vec<[f64; 2]> = found.iter().map(|interval| interval.ends).collect();
            if self.inside(&ends)[region] == edge.starts_inside { low = middle } else { high = middle }
        }
        Ok(self.grid.in_part_frame(along((f64::from(low) + 0.5) / f64::from(STEPS))))
    }
}

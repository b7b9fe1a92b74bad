//! Crossings of the tetrahedra's edges with the regions' surfaces.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::super::observer::go_on;
use super::super::request::WorkspaceError;
use super::Grid;
use super::orientations::at;
use super::section::{Piece, Setting};
use super::slab::{Crossing, Row, Work};
use crate::pose::Point;

/// The edges that begin at a node, as steps along the three axes: those of the six tetrahedra
/// around the cube's diagonal.
pub(super) const EDGES: [[u32; 3]; 7] =
    [[0, 0, 1], [0, 1, 0], [0, 1, 1], [1, 0, 0], [1, 0, 1], [1, 1, 0], [1, 1, 1]];

/// Halvings of an edge.
const HALVINGS: u32 = 8;
/// Number of parts of an edge.
const PARTS: u32 = 1 << HALVINGS;

/// The sections between two layers at which edges are examined. All edges are halved at the same x, so few sections
/// serve them all.
pub(super) struct Sections<'a> {
    setting: &'a Setting<'a>,
    first: &'a [Piece],
    between: Vec<OnceLock<Vec<Piece>>>,
    x: f64,
    step: f64,
}

impl<'a> Sections<'a> {
    pub(super) fn new(setting: &'a Setting<'a>, grid: &Grid, layer: u32, first: &'a [Piece]) -> Self {
        let between = (0..PARTS).map(|_| OnceLock::new()).collect();
        Self { setting, first, between, x: grid.node([layer, 0, 0])[0], step: grid.step }
    }

    /// The section at a fraction of the way to the next layer.
    fn at(&self, part: u32) -> &[Piece] {
        if part == 0 {
            return self.first;
        }
        self.between[part as usize]
            .get_or_init(|| self.setting.section(self.x + self.step * f64::from(part) / f64::from(PARTS)))
    }
}

/// The crossings of the edges that begin in a layer, given its rows and the next layer's.
pub(super) fn crossings(
    work: &Work<'_>,
    sections: &Sections<'_>,
    layer: u32,
    rows: [&[Row]; 2],
) -> Result<[Vec<Crossing>; 2], WorkspaceError> {
    let [_, across, up] = work.grid.counts;
    let found: Vec<[Vec<Crossing>; 2]> = (0..across)
        .into_par_iter()
        .map(|j| {
            let mut found = [Vec::new(), Vec::new()];
            for k in 0..up {
                go_on(work.observer)?;
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
                            at: work.crossing(sections, &edge, region)?,
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

impl Work<'_> {
    /// Finds the crossing by bisection: the middle of the last part of the edge that the region's surface crosses.
    fn crossing(&self, sections: &Sections<'_>, edge: &Edge, region: usize) -> Result<Point, WorkspaceError> {
        let start = self.grid.node(edge.from);
        let along = |part: f64| {
            [0, 1, 2].map(|axis| start[axis] + self.grid.step * part * f64::from(edge.steps[axis]))
        };
        let (mut low, mut high) = (0, PARTS);
        while high - low > 1 {
            go_on(self.observer)?;
            let middle = u32::midpoint(low, high);
            let [_, v1, z] = along(f64::from(middle) / f64::from(PARTS));
            let section = sections.at(if edge.steps[0] == 0 { 0 } else { middle });
            let found = at(self.setting, section, [v1, z], self.request.phi1);
            let ends: Vec<[f64; 2]> = found.iter().map(|interval| interval.ends).collect();
            if self.inside(&ends)[region] == edge.starts_inside { low = middle } else { high = middle }
        }
        Ok(self.grid.in_part_frame(along((f64::from(low) + 0.5) / f64::from(PARTS))))
    }
}

//! A region of part points: its volume, and its surface by marching tetrahedra.

use super::crossings::{Crossing, EDGES};
use super::grid::Grid;
use crate::pose::Point;
use crate::workspace::measure::Volume;
use crate::workspace::observer::{Observer, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// A region of part points.
///
/// The surface consists of cuts through the six tetrahedra around the diagonals of the grid's cubes, between corners
/// inside and corners outside. It is closed and a manifold for any region. Its vertices lie on edges of the
/// tetrahedra, less than 1/500 of an edge from the true surface. A component that is smaller than a cell may be
/// missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The volume, by integration over the region, not from the surface.
    pub volume: Volume,
    /// Vertices of the surface in the part frame, mm.
    pub positions: Vec<Point>,
    /// Vertex numbers of each triangle, counter-clockwise seen from outside. Every edge belongs to two triangles that
    /// run along it in opposite directions.
    pub triangles: Vec<[u32; 3]>,
}

/// The corners of the six tetrahedra: from the cube's first corner to its last, along one axis after the other. First
/// the even permutations of the axes, then the odd ones.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
/// Even permutations of a tetrahedron's corners, by the one corner inside, or by the two corners inside.
const ALONE: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]];
const PAIRS: [[usize; 4]; 6] =
    [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];

/// The triangles of a region, given which nodes are inside and where the edges cross its surface,
/// ascending.
pub(crate) fn triangles(
    grid: &Grid,
    inside: &[bool],
    crossings: &[Crossing],
    observer: &dyn Observer,
) -> Result<Vec<[u32; 3]>, WorkspaceError> {
    let mut surface = RegionSurface { grid, inside, crossings, triangles: Vec::new() };
    let cubes = grid.counts.map(|count| count.saturating_sub(1));
    for i in 0..cubes[0] {
        for j in 0..cubes[1] {
            check_cancelled(observer)?;
            for k in 0..cubes[2] {
                surface.cube([i, j, k])?;
            }
        }
    }
    Ok(surface.triangles)
}

struct RegionSurface<'a> {
    grid: &'a Grid,
    inside: &'a [bool],
    crossings: &'a [Crossing],
    triangles: Vec<[u32; 3]>,
}

impl RegionSurface<'_> {
    fn number(&self, [i, j, k]: [u32; 3]) -> usize {
        let [_, across, up] = self.grid.counts.map(|count| count as usize);
        (i as usize * across + j as usize) * up + k as usize
    }

    fn cube(&mut self, from: [u32; 3]) -> Result<(), WorkspaceError> {
        let [i, j, k] = from;
        let corners =
            [[0, 0, 0], [0, 0, 1], [0, 1, 0], [0, 1, 1], [1, 0, 0], [1, 0, 1], [1, 1, 0], [1, 1, 1]];
        let first = self.inside[self.number(from)];
        if corners.iter().all(|[a, b, c]| self.inside[self.number([i + a, j + b, k + c])] == first) {
            return Ok(());
        }
        for (n, order) in ORDERS.iter().enumerate() {
            let mut corners = [from; 4];
            for step in 0..3 {
                corners[step + 1] = corners[step];
                corners[step + 1][order[step]] += 1;
            }
            self.tetrahedron(corners, n < 3)?;
        }
        Ok(())
    }

    /// A tetrahedron that is a right-handed one, or a left-handed.
    fn tetrahedron(&mut self, corners: [[u32; 3]; 4], right: bool) -> Result<(), WorkspaceError> {
        let inside = corners.map(|corner| self.inside[self.number(corner)]);
        let count = inside.iter().filter(|&&inside| inside).count();
        let mut add = |edges: [[usize; 2]; 3], outward: bool| -> Result<(), WorkspaceError> {
            let [a, b, c] = edges.map(|ends| self.vertex(ends.map(|end| corners[end])));
            let (a, b, c) = (a?, b?, c?);
            self.triangles.push(if outward == right { [a, b, c] } else { [a, c, b] });
            Ok(())
        };
        if count == 2 {
            for [a, b, c, d] in PAIRS.into_iter().filter(|[a, b, ..]| inside[*a] && inside[*b]) {
                add([[a, c], [a, d], [b, d]], true)?;
                add([[a, c], [b, d], [b, c]], true)?;
            }
        } else if count == 1 || count == 3 {
            for [a, b, c, d] in ALONE.into_iter().filter(|[a, ..]| inside[*a] == (count == 1)) {
                add([[a, b], [a, c], [a, d]], count == 1)?;
            }
        }
        Ok(())
    }

    /// The number of the vertex on an edge.
    fn vertex(&self, [a, b]: [[u32; 3]; 2]) -> Result<u32, WorkspaceError> {
        let (from, to) = if a <= b { (a, b) } else { (b, a) };
        let steps = [0, 1, 2].map(|axis| to[axis] - from[axis]);
        let direction = EDGES.iter().position(|edge| *edge == steps).unwrap_or(0);
        let edge = 7 * self.number(from) as u64 + direction as u64;
        let found = self.crossings.binary_search_by_key(&edge, |crossing| crossing.edge);
        found.ok().and_then(|number| u32::try_from(number).ok()).ok_or(WorkspaceError::Open)
    }
}

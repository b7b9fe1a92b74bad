//! Refinement of the region's surface.
//!
//! The cuts through the grid's cells cut off the edges and corners at which several limits meet, by as much as a cell
//! is wide. So the distance of the boundary is examined in the middle of each edge and of each triangle, and edges are
//! divided until it is small.
//!
//! Over a triangle with its corners on the boundary let g be the offset of the boundary, positive outwards. If the
//! region is convex there, g is concave: in the middle of an edge it is at least half of its greatest value on the
//! edge, and in the middle of the triangle at least a third of that in the triangle, since the middle is a third of any
//! point and two thirds of another one. If the region is concave there, the same holds for -g. So a surface is within a
//! tolerance if the middles of edges are within a half of it, and those of triangles within a third.
//!
//! Where two limits meet, g on an edge consists of two straight lines. Its values at a quarter and at three quarters
//! tell where they meet; the edge is divided there. So few triangles suffice along the region's edges.

use std::collections::{BTreeMap, HashMap, HashSet};

use rayon::prelude::*;

use super::boundary_search::{BoundarySearch, moved, unit};
use super::subdivision::{Ends, divided, edges};
use crate::pose::Point;
use crate::workspace::observer::check_cancelled;
use crate::workspace::vector::{distance, minus, normal};
use crate::workspace::{Observer, WorkspaceError};

/// Greatest number of passes over the surface, and of vertices with which another pass begins.
const PASSES: u32 = 24;
const MOST_VERTICES: usize = 1_000_000;
/// Greatest offset on an edge, and in a triangle, as a multiple of that in the middle.
const OF_EDGE: f64 = 2.0;
const OF_TRIANGLE: f64 = 3.0;
/// Least and greatest fraction of an edge at which it is divided.
const DIVISION: [f64; 2] = [0.1, 0.9];
/// Length of an edge that is not divided, as a multiple of the tolerance.
const SHORT: f64 = 0.5;

/// A closed surface whose triangles are divided.
pub(super) struct Refinement<'a> {
    pub(super) search: &'a BoundarySearch<'a>,
    /// The distance from the boundary that is small enough.
    pub(super) tolerance: f64,
    pub(super) positions: Vec<Point>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// What the passes know already.
#[derive(Default)]
struct Known {
    /// Edges that need no division.
    edges: HashSet<Ends>,
    /// Triangles whose middles are near enough.
    triangles: HashSet<[u32; 3]>,
}

impl Refinement<'_> {
    /// Divides triangles until the surface is near the boundary, as far as the bounds of the work allow.
    pub(super) fn run(&mut self, observer: &dyn Observer) -> Result<(), WorkspaceError> {
        let mut known = Known::default();
        for pass in 1..=PASSES {
            let normals = self.edge_normals();
            let mut new = self.far_edges(&normals, &mut known, observer)?;
            self.far_triangles(&normals, &mut known, &mut new, observer)?;
            if new.is_empty() || self.positions.len() > MOST_VERTICES {
                break;
            }
            self.divide(new);
            observer.progress(1.0 - 0.5_f64.powf(f64::from(pass)));
        }
        Ok(())
    }

    /// The sum of the normals of both triangles of each edge.
    fn edge_normals(&self) -> BTreeMap<Ends, Point> {
        let mut sides: Vec<(Ends, Point)> = Vec::with_capacity(3 * self.triangles.len());
        for corners in &self.triangles {
            let of_triangle = normal(self.corners(*corners));
            sides.extend(edges(*corners).map(|ends| (ends, of_triangle)));
        }
        sides.sort_by_key(|(ends, _)| *ends);
        let sum = |sides: &[(Ends, Point)]| sides.iter().fold([0.0; 3], |sum, side| moved(sum, side.1, 1.0));
        sides.chunk_by(|a, b| a.0 == b.0).map(|sides| (sides[0].0, sum(sides))).collect()
    }

    /// New vertices of the edges whose middles are far from the boundary.
    fn far_edges(
        &self,
        normals: &BTreeMap<Ends, Point>,
        known: &mut Known,
        observer: &dyn Observer,
    ) -> Result<BTreeMap<Ends, Point>, WorkspaceError> {
        let open: Vec<(Ends, Point)> = normals
            .iter()
            .filter(|(ends, _)| !known.edges.contains(*ends))
            .map(|(ends, normal)| (*ends, *normal))
            .collect();
        let found = all(&open, observer, |(ends, normal), hint| self.vertex(*ends, *normal, hint))?;
        let mut new = BTreeMap::new();
        for ((ends, _), vertex) in open.into_iter().zip(found) {
            match vertex {
                Some(vertex) => drop(new.insert(ends, vertex)),
                None => drop(known.edges.insert(ends)),
            }
        }
        Ok(new)
    }

    /// Adds new vertices of the longest edges of triangles whose middles are far from the boundary, unless another of
    /// their edges has one.
    fn far_triangles(
        &self,
        normals: &BTreeMap<Ends, Point>,
        known: &mut Known,
        new: &mut BTreeMap<Ends, Point>,
        observer: &dyn Observer,
    ) -> Result<(), WorkspaceError> {
        let is_open = |corners: &[u32; 3]| {
            !known.triangles.contains(corners) && edges(*corners).iter().all(|ends| !new.contains_key(ends))
        };
        let open: Vec<[u32; 3]> = self.triangles.iter().copied().filter(is_open).collect();
        let found = all(&open, observer, |corners, hint| {
            let longest = self.far_triangle(*corners, hint)?;
            let (outwards, [a, b]) = (unit(*normals.get(&longest)?)?, self.ends(longest));
            let middle = moved(a, minus(b, a), 0.5);
            let offset = self.search.offset(middle, outwards, hint)?;
            Some((longest, moved(middle, outwards, offset)))
        })?;
        for (corners, vertex) in open.into_iter().zip(found) {
            match vertex {
                Some((ends, vertex)) => drop(new.insert(ends, vertex)),
                None => drop(known.triangles.insert(corners)),
            }
        }
        Ok(())
    }

    /// Divides all triangles at the new vertices of their edges.
    fn divide(&mut self, new: BTreeMap<Ends, Point>) {
        let mut numbers: HashMap<Ends, u32> = HashMap::new();
        for (ends, vertex) in new {
            // There are fewer than 2^32 vertices: no pass begins with more than a million.
            numbers.extend(u32::try_from(self.positions.len()).map(|number| (ends, number)));
            self.positions.push(vertex);
        }
        let mut parts = Vec::with_capacity(self.triangles.len() + 2 * numbers.len());
        for corners in &self.triangles {
            let new = edges(*corners).map(|ends| numbers.get(&ends).copied());
            let of_triangle = divided(&self.positions, *corners, new);
            if of_triangle.is_empty() {
                parts.push(*corners);
            }
            parts.extend(of_triangle);
        }
        self.triangles = parts;
    }

    fn corners(&self, corners: [u32; 3]) -> [Point; 3] {
        corners.map(|corner| self.positions[corner as usize])
    }

    fn ends(&self, ends: Ends) -> [Point; 2] {
        ends.map(|end| self.positions[end as usize])
    }

    /// A vertex on the boundary for an edge whose middle is far from it.
    fn vertex(&self, ends: Ends, normal: Point, hint: &mut usize) -> Option<Point> {
        let [a, b] = self.ends(ends);
        let (outwards, along) = (unit(normal)?, minus(b, a));
        let at = |part: f64| moved(a, along, part);
        let near = self.tolerance / OF_EDGE;
        if distance(a, b) < SHORT * self.tolerance || self.search.is_near(at(0.5), outwards, near, hint) {
            return None;
        }
        let [low, middle, high] = [0.25, 0.5, 0.75].map(|part| self.search.offset(at(part), outwards, hint));
        let meeting = low.zip(high).filter(|(low, high)| low * high > 0.0);
        let part = meeting.map_or(0.5, |(low, high)| (high / (low + high)).clamp(DIVISION[0], DIVISION[1]));
        let there = self.search.offset(at(part), outwards, hint).map(|offset| (part, offset));
        let (part, offset) = there.or_else(|| Some((0.5, middle?)))?;
        Some(moved(at(part), outwards, offset))
    }

    /// The longest edge of a triangle whose middle is far from the boundary.
    fn far_triangle(&self, corners: [u32; 3], hint: &mut usize) -> Option<Ends> {
        let at = self.corners(corners);
        // A triangle without an area is no farther from the boundary than its edges.
        let outwards = unit(normal(at))?;
        let middle = std::array::from_fn(|i| at.iter().map(|corner| corner[i]).sum::<f64>() / 3.0);
        if self.search.is_near(middle, outwards, self.tolerance / OF_TRIANGLE, hint) {
            return None;
        }
        let length = |ends: &Ends| {
            let [a, b] = self.ends(*ends);
            distance(a, b)
        };
        let longest = edges(corners).into_iter().max_by(|a, b| length(a).total_cmp(&length(b)));
        longest.filter(|ends| length(ends) >= SHORT * self.tolerance)
    }
}

/// What is found for all items, in their order, on all threads.
fn all<T: Sync, R: Send>(
    items: &[T],
    observer: &dyn Observer,
    find: impl Fn(&T, &mut usize) -> Option<R> + Sync,
) -> Result<Vec<Option<R>>, WorkspaceError> {
    let found = items.par_iter().map_init(
        || 0,
        |hint, item| {
            check_cancelled(observer)?;
            Ok(find(item, hint))
        },
    );
    found.collect()
}

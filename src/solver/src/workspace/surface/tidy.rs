//! Contraction of edges so short that single precision would make their ends one.

use std::collections::{BTreeMap, BTreeSet};

use super::Surface;
use crate::pose::Point;
use crate::workspace::observer::{Pace, go_on};
use crate::workspace::request::WorkspaceError;

/// Longest edge contracted, in units of the tolerance.
const SHORT: f64 = 0.02;

/// Contracts short edges where the surface stays a manifold: the two ends have no common neighbours but the corners
/// of the edge's own two triangles, no triangle duplicates another, and none turns over.
pub(super) fn contract(
    surface: &mut Surface,
    tolerance: f64,
    pace: &mut Pace<'_>,
) -> Result<(), WorkspaceError> {
    let short = SHORT * tolerance;
    let edges = short_edges(surface, short, pace)?;
    if edges.is_empty() {
        return Ok(());
    }
    let mut work = Contraction::around(surface, &edges, pace)?;
    for [a, b] in edges {
        go_on(pace.observer)?;
        work.contract(a, b, short);
    }
    let kept = work.kept;
    compact(surface, &kept, pace)
}

/// Each once, in the order of the triangles.
fn short_edges(surface: &Surface, short: f64, pace: &mut Pace<'_>) -> Result<Vec<[u32; 2]>, WorkspaceError> {
    let place = |vertex: u32| surface.positions[vertex as usize];
    let mut found = Vec::new();
    for &[a, b, c] in &surface.triangles {
        pace.step()?;
        let sides = [[a, b], [b, c], [c, a]].into_iter();
        found.extend(sides.filter(|&[a, b]| a < b && distance(place(a), place(b)) < short));
    }
    Ok(found)
}

struct Contraction<'a> {
    surface: &'a mut Surface,
    /// Triangles around the vertices that short edges join.
    around: BTreeMap<u32, Vec<u32>>,
    /// The vertex that replaces a vertex.
    moved: BTreeMap<u32, u32>,
    kept: Vec<bool>,
}

impl<'a> Contraction<'a> {
    fn around(
        surface: &'a mut Surface,
        edges: &[[u32; 2]],
        pace: &mut Pace<'_>,
    ) -> Result<Self, WorkspaceError> {
        let mut around: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut marked = vec![false; surface.positions.len()];
        for &vertex in edges.as_flattened() {
            pace.step()?;
            around.entry(vertex).or_default();
            marked[vertex as usize] = true;
        }
        for (number, triangle) in (0_u32..).zip(&surface.triangles) {
            pace.step()?;
            for corner in triangle.iter().filter(|corner| marked[**corner as usize]) {
                around.entry(*corner).or_default().push(number);
            }
        }
        let kept = pace.filled(&true, surface.triangles.len())?;
        Ok(Self { surface, around, moved: BTreeMap::new(), kept })
    }

    fn contract(&mut self, a: u32, b: u32, short: f64) {
        let (a, b) = (self.now(a), self.now(b));
        let apart = distance(self.place(a), self.place(b));
        if a == b || apart >= short || !(self.stays_one(a, b) && self.stays_upright(a, b, short)) {
            return;
        }
        let triangles = self.around.remove(&b).unwrap_or_default();
        for number in triangles {
            let triangle = &mut self.surface.triangles[number as usize];
            if triangle.contains(&a) {
                self.kept[number as usize] = false;
            } else {
                for corner in triangle.iter_mut().filter(|corner| **corner == b) {
                    *corner = a;
                }
                self.around.entry(a).or_default().push(number);
            }
        }
        let kept = &self.kept;
        if let Some(triangles) = self.around.get_mut(&a) {
            triangles.retain(|&number| kept[number as usize]);
        }
        self.moved.insert(b, a);
    }

    fn now(&self, mut vertex: u32) -> u32 {
        while let Some(&to) = self.moved.get(&vertex) {
            vertex = to;
        }
        vertex
    }

    fn place(&self, vertex: u32) -> Point {
        self.surface.positions[vertex as usize]
    }

    fn triangles(&self, vertex: u32) -> impl Iterator<Item = (u32, [u32; 3])> {
        let numbers = self.around.get(&vertex).into_iter().flatten();
        numbers
            .filter(|&&number| self.kept[number as usize])
            .map(|&number| (number, self.surface.triangles[number as usize]))
    }

    fn stays_one(&self, a: u32, b: u32) -> bool {
        let link = |vertex| -> BTreeSet<u32> {
            self.triangles(vertex).flat_map(|(_, triangle)| triangle).filter(|&n| n != a && n != b).collect()
        };
        let shared = self.triangles(a).filter(|(_, triangle)| triangle.contains(&b)).count();
        let common = link(a).intersection(&link(b)).count();
        let mut faces = BTreeSet::new();
        let distinct = self.triangles(a).chain(self.triangles(b)).all(|(_, triangle)| {
            let mut face = triangle.map(|corner| if corner == b { a } else { corner });
            face.sort_unstable();
            triangle.contains(&a) && triangle.contains(&b) || faces.insert(face)
        });
        shared == 2 && common == 2 && distinct
    }

    /// No triangle of more than a sliver's height turns over when b moves to a.
    fn stays_upright(&self, a: u32, b: u32, short: f64) -> bool {
        self.triangles(b).filter(|(_, triangle)| !triangle.contains(&a)).all(|(_, triangle)| {
            let before = normal(triangle.map(|corner| self.place(corner)));
            let after = normal(triangle.map(|corner| self.place(if corner == b { a } else { corner })));
            let size = dot(before, before).sqrt();
            dot(before, after) > 0.0 || size < short * short
        })
    }
}

/// Removes the triangles that are not kept, and the vertices that no triangle uses.
pub(super) fn compact(
    surface: &mut Surface,
    kept: &[bool],
    pace: &mut Pace<'_>,
) -> Result<(), WorkspaceError> {
    let (triangles, bindings) = (&mut surface.triangles, &mut surface.bindings);
    let mut used = vec![false; surface.positions.len()];
    let mut count = 0;
    for (number, _) in kept.iter().enumerate().filter(|(_, kept)| **kept) {
        pace.step()?;
        (triangles[count], bindings[count]) = (triangles[number], bindings[number]);
        for corner in triangles[count] {
            used[corner as usize] = true;
        }
        count += 1;
    }
    triangles.truncate(count);
    bindings.truncate(count);
    let mut numbers = Vec::with_capacity(used.len());
    let mut next = 0_u32;
    for (vertex, &used) in used.iter().enumerate() {
        pace.step()?;
        numbers.push(next);
        if used {
            surface.positions[next as usize] = surface.positions[vertex];
            next += 1;
        }
    }
    surface.positions.truncate(next as usize);
    for triangle in triangles {
        pace.step()?;
        *triangle = triangle.map(|corner| numbers[corner as usize]);
    }
    Ok(())
}

fn distance(a: Point, b: Point) -> f64 {
    let gap = [0, 1, 2].map(|i| a[i] - b[i]);
    dot(gap, gap).sqrt()
}

fn normal([a, b, c]: [Point; 3]) -> Point {
    let (p, q) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

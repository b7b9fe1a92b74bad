//! Collapse of edges so short that single precision would make their ends one.

use std::collections::{BTreeMap, BTreeSet};

use super::mesh::Surface;
use crate::pose::Point;
use crate::workspace::observer::{StepCounter, check_cancelled};
use crate::workspace::request::WorkspaceError;
use crate::workspace::vector::{distance, dot, length, normal};

/// Longest edge that is collapsed, in units of the tolerance.
const SHORT: f64 = 0.02;

/// Collapses short edges where the surface stays a manifold: the two ends have no common neighbours but the corners
/// of the edge's own two triangles, no triangle duplicates another, and none turns over.
pub(super) fn collapse_short_edges(
    surface: &mut Surface,
    tolerance: f64,
    steps: &mut StepCounter<'_>,
) -> Result<(), WorkspaceError> {
    let short = SHORT * tolerance;
    let edges = short_edges(surface, short, steps)?;
    if edges.is_empty() {
        return Ok(());
    }
    let mut collapse = Collapse::around(surface, &edges, steps)?;
    for [a, b] in edges {
        check_cancelled(steps.observer)?;
        collapse.edge(a, b, short);
    }
    let retained = collapse.retained;
    surface.retain(&retained, steps)
}

/// Each once, in the order of the triangles.
fn short_edges(
    surface: &Surface,
    short: f64,
    steps: &mut StepCounter<'_>,
) -> Result<Vec<[u32; 2]>, WorkspaceError> {
    let position = |vertex: u32| surface.positions[vertex as usize];
    let mut found = Vec::new();
    for &[a, b, c] in &surface.triangles {
        steps.step()?;
        let sides = [[a, b], [b, c], [c, a]].into_iter();
        found.extend(sides.filter(|&[a, b]| a < b && distance(position(a), position(b)) < short));
    }
    Ok(found)
}

/// The edges that are being collapsed.
struct Collapse<'a> {
    surface: &'a mut Surface,
    /// Triangles around the vertices that short edges join.
    around: BTreeMap<u32, Vec<u32>>,
    /// The vertex that replaces a vertex.
    replaced: BTreeMap<u32, u32>,
    retained: Vec<bool>,
}

impl<'a> Collapse<'a> {
    fn around(
        surface: &'a mut Surface,
        edges: &[[u32; 2]],
        steps: &mut StepCounter<'_>,
    ) -> Result<Self, WorkspaceError> {
        let mut around: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut marked = vec![false; surface.positions.len()];
        for &vertex in edges.as_flattened() {
            steps.step()?;
            around.entry(vertex).or_default();
            marked[vertex as usize] = true;
        }
        for (number, triangle) in (0_u32..).zip(&surface.triangles) {
            steps.step()?;
            for corner in triangle.iter().filter(|corner| marked[**corner as usize]) {
                around.entry(*corner).or_default().push(number);
            }
        }
        let retained = steps.filled(&true, surface.triangles.len())?;
        Ok(Self { surface, around, replaced: BTreeMap::new(), retained })
    }

    fn edge(&mut self, a: u32, b: u32, short: f64) {
        let (a, b) = (self.replacement(a), self.replacement(b));
        let apart = distance(self.position(a), self.position(b));
        if a == b || apart >= short || !(self.stays_manifold(a, b) && self.keeps_orientation(a, b, short)) {
            return;
        }
        let triangles = self.around.remove(&b).unwrap_or_default();
        for number in triangles {
            let triangle = &mut self.surface.triangles[number as usize];
            if triangle.contains(&a) {
                self.retained[number as usize] = false;
            } else {
                for corner in triangle.iter_mut().filter(|corner| **corner == b) {
                    *corner = a;
                }
                self.around.entry(a).or_default().push(number);
            }
        }
        let retained = &self.retained;
        if let Some(triangles) = self.around.get_mut(&a) {
            triangles.retain(|&number| retained[number as usize]);
        }
        self.replaced.insert(b, a);
    }

    fn replacement(&self, mut vertex: u32) -> u32 {
        while let Some(&to) = self.replaced.get(&vertex) {
            vertex = to;
        }
        vertex
    }

    fn position(&self, vertex: u32) -> Point {
        self.surface.positions[vertex as usize]
    }

    fn triangles(&self, vertex: u32) -> impl Iterator<Item = (u32, [u32; 3])> {
        let numbers = self.around.get(&vertex).into_iter().flatten();
        numbers
            .filter(|&&number| self.retained[number as usize])
            .map(|&number| (number, self.surface.triangles[number as usize]))
    }

    /// Whether the surface stays a manifold when b moves to a.
    fn stays_manifold(&self, a: u32, b: u32) -> bool {
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

    /// Whether no triangle of more than a sliver's height turns over when b moves to a.
    fn keeps_orientation(&self, a: u32, b: u32, short: f64) -> bool {
        self.triangles(b).filter(|(_, triangle)| !triangle.contains(&a)).all(|(_, triangle)| {
            let before = normal(triangle.map(|corner| self.position(corner)));
            let after = normal(triangle.map(|corner| self.position(if corner == b { a } else { corner })));
            let size = length(before);
            dot(before, after) > 0.0 || size < short * short
        })
    }
}

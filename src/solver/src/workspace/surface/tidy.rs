//! Contraction of edges so short that single precision would make their ends one.

use std::collections::{BTreeMap, BTreeSet};

use super::Surface;
use crate::pose::Point;

/// Longest edge contracted, in units of the tolerance.
const SHORT: f64 = 0.02;

/// Contracts short edges where the surface stays one: the two ends have only the edge's own two
/// triangles' corners for common neighbours, no triangle doubles another, and none turns over.
pub(super) fn contract(surface: &mut Surface, tolerance: f64) {
    let short = SHORT * tolerance;
    let edges = short_edges(surface, short);
    if edges.is_empty() {
        return;
    }
    let mut work = Contraction::around(surface, &edges);
    for [a, b] in edges {
        work.contract(a, b, short);
    }
    let kept = work.kept;
    compact(surface, &kept);
}

/// Each once, in the order of the triangles.
fn short_edges(surface: &Surface, short: f64) -> Vec<[u32; 2]> {
    let sides = surface.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let place = |vertex: u32| surface.positions[vertex as usize];
    sides.filter(|&[a, b]| a < b && distance(place(a), place(b)) < short).collect()
}

struct Contraction<'a> {
    surface: &'a mut Surface,
    /// Triangles around the vertices that short edges join.
    around: BTreeMap<u32, Vec<u32>>,
    /// The vertex that took a vertex's place.
    moved: BTreeMap<u32, u32>,
    kept: Vec<bool>,
}

impl<'a> Contraction<'a> {
    fn around(surface: &'a mut Surface, edges: &[[u32; 2]]) -> Self {
        let mut around: BTreeMap<u32, Vec<u32>> =
            edges.iter().flatten().map(|&vertex| (vertex, Vec::new())).collect();
        let mut marked = vec![false; surface.positions.len()];
        for vertex in around.keys() {
            marked[*vertex as usize] = true;
        }
        for (number, triangle) in (0_u32..).zip(&surface.triangles) {
            for corner in triangle.iter().filter(|corner| marked[**corner as usize]) {
                around.entry(*corner).or_default().push(number);
            }
        }
        let kept = vec![true; surface.triangles.len()];
        Self { surface, around, moved: BTreeMap::new(), kept }
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

/// Takes out the triangles that are not kept and the vertices that nothing uses.
pub(super) fn compact(surface: &mut Surface, kept: &[bool]) {
    let mut keep = kept.iter().copied();
    surface.triangles.retain(|_| keep.next().unwrap_or(true));
    let mut keep = kept.iter().copied();
    surface.bindings.retain(|_| keep.next().unwrap_or(true));
    let mut used = vec![false; surface.positions.len()];
    for corner in surface.triangles.iter().flatten() {
        used[*corner as usize] = true;
    }
    let mut count = 0;
    let numbers: Vec<u32> = used
        .iter()
        .map(|&used| {
            let number = count;
            count += u32::from(used);
            number
        })
        .collect();
    for corner in surface.triangles.iter_mut().flatten() {
        *corner = numbers[*corner as usize];
    }
    let mut keep = used.into_iter();
    surface.positions.retain(|_| keep.next().unwrap_or(true));
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

//! The faces of a planar graph.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::{Edge, GridPoint, orientation};

/// A closed chain of half-edges with a face to its left. Half-edge 2 i runs along edge i, 2 i + 1 against it.
#[derive(Clone, Debug, Default)]
pub(in crate::atlas) struct Ring {
    pub(in crate::atlas) half_edges: Vec<usize>,
}

/// The faces between the edges of a planar graph, without the one around it.
pub(in crate::atlas) struct Faces {
    pub(in crate::atlas) edges: Vec<Edge>,
    /// The outer ring of each face, and the rings of its holes.
    pub(in crate::atlas) rings: Vec<(Ring, Vec<Ring>)>,
    /// The face to the left of each half-edge.
    pub(in crate::atlas) left: Vec<Option<usize>>,
}

fn ends(edges: &[Edge], half_edge: usize) -> [GridPoint; 2] {
    let [a, b] = edges[half_edge / 2].ends;
    if half_edge.is_multiple_of(2) { [a, b] } else { [b, a] }
}

impl Faces {
    /// The faces between edges that meet at their ends only.
    pub(in crate::atlas) fn of(edges: Vec<Edge>) -> Self {
        let rings = rings(&edges);
        let mut ring_of = vec![0; 2 * edges.len()];
        for (number, ring) in rings.iter().enumerate() {
            for &half_edge in &ring.half_edges {
                ring_of[half_edge] = number;
            }
        }
        let is_outer: Vec<bool> = rings.iter().map(|ring| doubled_area(&edges, ring) > 0).collect();
        let mut face_of: Vec<Option<usize>> = vec![None; rings.len()];
        let mut count = 0;
        for (number, _) in is_outer.iter().enumerate().filter(|(_, is_outer)| **is_outer) {
            face_of[number] = Some(count);
            count += 1;
        }
        // A ring that is no outer one bounds a hole of the face to its left, or nothing.
        let beside: Vec<Option<usize>> = rings
            .iter()
            .zip(&is_outer)
            .map(|(ring, is_outer)| if *is_outer { None } else { half_edge_beside(&edges, ring) })
            .collect();
        for number in (0..rings.len()).filter(|number| !is_outer[*number]) {
            let (mut at, mut steps) = (number, 0);
            while !is_outer[at] && steps <= rings.len() {
                let Some(half_edge) = beside[at] else { break };
                at = ring_of[half_edge];
                steps += 1;
            }
            face_of[number] = if is_outer[at] { face_of[at] } else { None };
        }
        let left = ring_of.iter().map(|ring| face_of[*ring]).collect();
        let mut faces = vec![(Ring::default(), Vec::new()); count];
        for ((ring, face), is_outer) in rings.into_iter().zip(&face_of).zip(&is_outer) {
            let Some(face) = *face else { continue };
            if *is_outer { faces[face].0 = ring } else { faces[face].1.push(ring) }
        }
        Self { edges, rings: faces, left }
    }

    /// Start and end of a half-edge.
    pub(in crate::atlas) fn ends(&self, half_edge: usize) -> [GridPoint; 2] {
        ends(&self.edges, half_edge)
    }

    /// Twice the area of a face.
    pub(in crate::atlas) fn doubled_area(&self, face: usize) -> i128 {
        let (outer, holes) = &self.rings[face];
        doubled_area(&self.edges, outer)
            + holes.iter().map(|hole| doubled_area(&self.edges, hole)).sum::<i128>()
    }
}

/// All chains of half-edges that turn as far left as possible at each point.
fn rings(edges: &[Edge]) -> Vec<Ring> {
    let mut around: BTreeMap<GridPoint, Vec<usize>> = BTreeMap::new();
    for half_edge in 0..2 * edges.len() {
        around.entry(ends(edges, half_edge)[0]).or_default().push(half_edge);
    }
    let mut next = vec![0; 2 * edges.len()];
    for (point, out) in &mut around {
        out.sort_by(|a, b| by_angle(*point, ends(edges, *a)[1], ends(edges, *b)[1]));
        for (i, &half_edge) in out.iter().enumerate() {
            // After arriving against `half_edge` the walk leaves on the one before it, clockwise.
            let before = if i == 0 { out[out.len() - 1] } else { out[i - 1] };
            next[half_edge ^ 1] = before;
        }
    }
    let mut seen = vec![false; next.len()];
    let mut rings = Vec::new();
    for start in 0..next.len() {
        let mut ring = Ring::default();
        let mut at = start;
        while !seen[at] {
            seen[at] = true;
            ring.half_edges.push(at);
            at = next[at];
        }
        if !ring.half_edges.is_empty() {
            rings.push(ring);
        }
    }
    rings
}

/// The order of two directions by their angle from the positive u axis, from 0 to a turn.
fn by_angle(from: GridPoint, a: GridPoint, b: GridPoint) -> Ordering {
    let lower = |to: GridPoint| to[1] < from[1] || (to[1] == from[1] && to[0] < from[0]);
    lower(a).cmp(&lower(b)).then_with(|| 0.cmp(&orientation(from, a, b)))
}

fn doubled_area(edges: &[Edge], ring: &Ring) -> i128 {
    let Some(&first) = ring.half_edges.first() else { return 0 };
    let origin = ends(edges, first)[0];
    ring.half_edges
        .iter()
        .map(|half_edge| {
            let [a, b] = ends(edges, *half_edge);
            orientation(origin, a, b)
        })
        .sum()
}

/// The half-edge to the left of a ring's leftmost point whose left side faces it; `None` if there is nothing.
fn half_edge_beside(edges: &[Edge], ring: &Ring) -> Option<usize> {
    let point = ring.half_edges.iter().map(|half_edge| ends(edges, *half_edge)[0]).min()?;
    let [u, v] = point;
    let mut nearest: Option<([f64; 2], usize)> = None;
    for (number, edge) in edges.iter().enumerate() {
        let [a, b] = edge.ends;
        if (a[1] <= v) == (b[1] <= v) || a[0].min(b[0]) >= u {
            continue;
        }
        let [rise, run, above, right] = [b[1] - a[1], b[0] - a[0], v - a[1], u - a[0]].map(number_of);
        // Where several edges meet, the rightmost just above counts.
        let place = [run * (above / rise), run / rise];
        let shift = number_of(a[0] - u);
        let place = [place[0] + shift, place[1]];
        if right > run * (above / rise) && nearest.is_none_or(|(known, _)| known < place) {
            // The half-edge that runs down has the point to its left.
            nearest = Some((place, 2 * number + usize::from(b[1] > a[1])));
        }
    }
    nearest.map(|(_, half_edge)| half_edge)
}

#[expect(clippy::cast_precision_loss, reason = "grid points have at most 34 bits")]
fn number_of(steps: i64) -> f64 {
    steps as f64
}

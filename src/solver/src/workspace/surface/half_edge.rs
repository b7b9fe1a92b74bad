//! Half-edges: which side of a triangle meets which side of another.
//!
//! Half-edge h runs from corner h % 3 of triangle h / 3 to the next corner. Its twin runs along the same edge in the
//! opposite direction.

use super::mesh::Surface;
use crate::pose::Point;
use crate::workspace::observer::StepCounter;
use crate::workspace::request::WorkspaceError;
use crate::workspace::vector::{cross, dot, length, minus};

/// The half-edges of a closed surface in pairs.
pub(super) struct HalfEdges {
    /// Each half-edge's twin.
    pub(super) twins: Vec<u32>,
    /// Edges of more than two triangles: one half-edge of each of their pairs.
    pub(super) crowded_edges: Vec<Vec<u32>>,
    /// Pairs of triangles with the same three corners: they enclose nothing.
    pub(super) doubled: Vec<[usize; 2]>,
}

impl HalfEdges {
    /// Pairs the half-edges; an edge whose directions do not balance is an error.
    pub(super) fn of(surface: &Surface, steps: &mut StepCounter<'_>) -> Result<Self, WorkspaceError> {
        let count = u32::try_from(3 * surface.triangles.len()).map_err(|_| WorkspaceError::TooFine)?;
        let (starts, sorted) = by_edge(surface, count, steps)?;
        // Each half-edge gets its twin below, or an error ends the function.
        let twins = steps.filled(&0, count as usize)?;
        let mut paired = Self { twins, crowded_edges: Vec::new(), doubled: Vec::new() };
        for ends in starts.windows(2) {
            steps.step()?;
            for edge in sorted[ends[0]..ends[1]].chunk_by(|a, b| a.0 == b.0) {
                match *edge {
                    [(_, a), (_, b)] if rises(surface, a) != rises(surface, b) => paired.pair(surface, a, b),
                    _ => paired.pair_crowded(surface, edge)?,
                }
            }
        }
        Ok(paired)
    }

    /// The corner of the same vertex in the next triangle around it.
    pub(super) fn around(&self, corner: usize) -> usize {
        self.twins[if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }] as usize
    }

    fn pair(&mut self, surface: &Surface, a: u32, b: u32) {
        (self.twins[a as usize], self.twins[b as usize]) = (b, a);
        if apex(surface, a) == apex(surface, b) {
            self.doubled.push([a, b].map(|half_edge| (half_edge / 3) as usize));
        }
    }

    /// Pairs the half-edges of an edge at which several sheets meet. The two triangles with the inside between them
    /// belong together, so the surface is cut where it only touches itself. Around the edge, in ascending angle, an
    /// inside begins at a falling half-edge and ends at a rising half-edge.
    fn pair_crowded(&mut self, surface: &Surface, edge: &[(u32, u32)]) -> Result<(), WorkspaceError> {
        let rising = edge.iter().filter(|(_, half_edge)| rises(surface, *half_edge)).count();
        if 2 * rising != edge.len() {
            return Err(WorkspaceError::Open);
        }
        let mut order = angles(surface, edge);
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (mut open, mut paired, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
        // The loop goes around twice, because an inside may span the angle at which it begins.
        for (_, half_edge) in order.iter().chain(&order) {
            if paired.contains(half_edge) {
                continue;
            }
            if !rises(surface, *half_edge) {
                if !open.contains(half_edge) {
                    open.push(*half_edge);
                }
            } else if let Some(begun) = open.pop() {
                self.pair(surface, begun, *half_edge);
                paired.extend([begun, *half_edge]);
                pairs.push(begun);
            }
        }
        self.crowded_edges.push(pairs);
        Ok(())
    }
}

/// The ranges of the vertices' edges, and for each half-edge its upper end and its number.
type Edges = (Vec<usize>, Vec<(u32, u32)>);

/// The half-edges by their edges: for each vertex the range of the edges whose lower end it is, and for each half-edge
/// there its upper end and its number. Counting sort needs no comparisons, and a vertex has few edges.
fn by_edge(surface: &Surface, count: u32, steps: &mut StepCounter<'_>) -> Result<Edges, WorkspaceError> {
    let mut starts = vec![0; surface.positions.len() + 2];
    for half_edge in 0..count {
        steps.step()?;
        let [a, b] = ends(surface, half_edge);
        starts[a.min(b) as usize + 2] += 1;
    }
    for vertex in 2..starts.len() {
        steps.step()?;
        starts[vertex] += starts[vertex - 1];
    }
    let mut sorted = vec![(0, 0); count as usize];
    for half_edge in 0..count {
        steps.step()?;
        let [a, b] = ends(surface, half_edge);
        let next = &mut starts[a.min(b) as usize + 1];
        sorted[*next] = (a.max(b), half_edge);
        *next += 1;
    }
    for ends in starts.windows(2) {
        steps.step()?;
        sorted[ends[0]..ends[1]].sort_unstable();
    }
    Ok((starts, sorted))
}

/// The half-edges of one edge with their triangles' angles around it, seen against the edge's
/// direction upwards.
fn angles(surface: &Surface, edge: &[(u32, u32)]) -> Vec<(f64, u32)> {
    let position = |vertex: u32| surface.positions[vertex as usize];
    let Some(&(upper, first)) = edge.first() else { return Vec::new() };
    let [a, b] = ends(surface, first);
    let (low, high) = (position(a.min(b)), position(upper));
    let axis = unit(minus(high, low));
    let beside = |half_edge: u32| {
        let arm = minus(position(apex(surface, half_edge)), low);
        let along = dot(arm, axis);
        [0, 1, 2].map(|i| arm[i] - along * axis[i])
    };
    let u = unit(beside(first));
    let v = cross(axis, u);
    edge.iter()
        .map(|&(_, half_edge)| {
            let arm = beside(half_edge);
            (dot(arm, v).atan2(dot(arm, u)), half_edge)
        })
        .collect()
}

pub(super) fn ends(surface: &Surface, half_edge: u32) -> [u32; 2] {
    let (triangle, corner) = (&surface.triangles[(half_edge / 3) as usize], (half_edge % 3) as usize);
    [triangle[corner], triangle[(corner + 1) % 3]]
}

fn apex(surface: &Surface, half_edge: u32) -> u32 {
    surface.triangles[(half_edge / 3) as usize][((half_edge + 2) % 3) as usize]
}

fn rises(surface: &Surface, half_edge: u32) -> bool {
    let [a, b] = ends(surface, half_edge);
    a < b
}

fn unit(a: Point) -> Point {
    let length = length(a);
    if length > 0.0 { a.map(|x| x / length) } else { a }
}

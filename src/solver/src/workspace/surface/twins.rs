//! Pairing of triangles' sides: which side of a triangle meets which side of another.
//!
//! Side h runs from corner h % 3 of triangle h / 3 to the next corner.

use super::Surface;
use crate::pose::Point;
use crate::workspace::observer::Pace;
use crate::workspace::request::WorkspaceError;

/// A side that has no twin yet.
const ALONE: u32 = u32::MAX;

/// The sides of a closed surface, in pairs that run along one edge in opposite directions.
pub(super) struct Twins {
    /// Each side's partner.
    pub(super) of: Vec<u32>,
    /// Edges of more than two triangles: one side of each of their pairs.
    pub(super) crowds: Vec<Vec<u32>>,
    /// Pairs of triangles with the same three corners: they enclose nothing.
    pub(super) doubled: Vec<[usize; 2]>,
}

impl Twins {
    /// Pairs the sides; an edge whose directions do not balance is an error.
    pub(super) fn of(surface: &Surface, pace: &mut Pace<'_>) -> Result<Self, WorkspaceError> {
        let sides = u32::try_from(3 * surface.triangles.len()).map_err(|_| WorkspaceError::TooFine)?;
        let (starts, sorted) = by_edge(surface, sides, pace)?;
        let of = pace.filled(&ALONE, sides as usize)?;
        let mut twins = Self { of, crowds: Vec::new(), doubled: Vec::new() };
        for ends in starts.windows(2) {
            pace.step()?;
            for edge in sorted[ends[0]..ends[1]].chunk_by(|a, b| a.0 == b.0) {
                match *edge {
                    [(_, a), (_, b)] if rises(surface, a) != rises(surface, b) => twins.pair(surface, a, b),
                    _ => twins.crowd(surface, edge)?,
                }
            }
        }
        Ok(twins)
    }

    /// The corner of the same vertex in the next triangle around it.
    pub(super) fn around(&self, corner: usize) -> usize {
        self.of[if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }] as usize
    }

    fn pair(&mut self, surface: &Surface, a: u32, b: u32) {
        (self.of[a as usize], self.of[b as usize]) = (b, a);
        if apex(surface, a) == apex(surface, b) {
            self.doubled.push([a, b].map(|side| (side / 3) as usize));
        }
    }

    /// Pairs the sides of an edge at which several sheets meet. The two triangles with the inside between them belong
    /// together, so the surface is cut where it only touches itself. Around the edge, in ascending angle, an inside
    /// begins at a falling side and ends at a rising side.
    fn crowd(&mut self, surface: &Surface, edge: &[(u32, u32)]) -> Result<(), WorkspaceError> {
        let rising = edge.iter().filter(|(_, side)| rises(surface, *side)).count();
        if 2 * rising != edge.len() {
            return Err(WorkspaceError::Open);
        }
        let mut order = angles(surface, edge);
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (mut open, mut pairs) = (Vec::new(), Vec::new());
        // The loop goes around twice, because an inside may span the angle at which it begins.
        for (_, side) in order.iter().chain(&order) {
            if self.of[*side as usize] != ALONE {
                continue;
            }
            if !rises(surface, *side) {
                if !open.contains(side) {
                    open.push(*side);
                }
            } else if let Some(begun) = open.pop() {
                self.pair(surface, begun, *side);
                pairs.push(begun);
            }
        }
        self.crowds.push(pairs);
        Ok(())
    }
}

/// Places of the vertices' edges, and for each side its upper end and its number.
type Edges = (Vec<usize>, Vec<(u32, u32)>);

/// The sides by their edges: for each vertex the range of the edges whose lower end it is, and for each side there
/// its upper end and its number. Counting sort needs no comparisons, and a vertex has few edges.
fn by_edge(surface: &Surface, sides: u32, pace: &mut Pace<'_>) -> Result<Edges, WorkspaceError> {
    let mut starts = vec![0; surface.positions.len() + 2];
    for side in 0..sides {
        pace.step()?;
        let [a, b] = ends(surface, side);
        starts[a.min(b) as usize + 2] += 1;
    }
    for vertex in 2..starts.len() {
        pace.step()?;
        starts[vertex] += starts[vertex - 1];
    }
    let mut sorted = vec![(0, 0); sides as usize];
    for side in 0..sides {
        pace.step()?;
        let [a, b] = ends(surface, side);
        let place = &mut starts[a.min(b) as usize + 1];
        sorted[*place] = (a.max(b), side);
        *place += 1;
    }
    for ends in starts.windows(2) {
        pace.step()?;
        sorted[ends[0]..ends[1]].sort_unstable();
    }
    Ok((starts, sorted))
}

/// The sides of one edge with their triangles' angles around it, seen against the edge's
/// direction upwards.
fn angles(surface: &Surface, edge: &[(u32, u32)]) -> Vec<(f64, u32)> {
    let place = |vertex: u32| surface.positions[vertex as usize];
    let Some(&(upper, first)) = edge.first() else { return Vec::new() };
    let [a, b] = ends(surface, first);
    let (low, high) = (place(a.min(b)), place(upper));
    let axis = unit(minus(high, low));
    let beside = |side: u32| {
        let arm = minus(place(apex(surface, side)), low);
        let along = dot(arm, axis);
        [0, 1, 2].map(|i| arm[i] - along * axis[i])
    };
    let u = unit(beside(first));
    let v = cross(axis, u);
    edge.iter()
        .map(|&(_, side)| {
            let arm = beside(side);
            (dot(arm, v).atan2(dot(arm, u)), side)
        })
        .collect()
}

pub(super) fn ends(surface: &Surface, side: u32) -> [u32; 2] {
    let (triangle, corner) = (&surface.triangles[(side / 3) as usize], (side % 3) as usize);
    [triangle[corner], triangle[(corner + 1) % 3]]
}

fn apex(surface: &Surface, side: u32) -> u32 {
    surface.triangles[(side / 3) as usize][((side + 2) % 3) as usize]
}

fn rises(surface: &Surface, side: u32) -> bool {
    let [a, b] = ends(surface, side);
    a < b
}

fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|x| x / length) } else { a }
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

//! Faces with their numbers of solutions, joined to regions.

use super::answer::Face;
use super::arc::Arc;
use super::arrangement::{Edge, Faces, GridPoint, Origin, Ring, STEPS, split_at_meetings};
use super::cubic::Cubic;
use super::interior::{Interior, interior};
use super::rectangle::Rectangle;
use super::request::AtlasError;
use crate::workspace::Observer;

/// Grid steps within which ends of arcs are one point.
const SAME_END: i64 = 64;
/// Interior points of a face at which the solver is asked. With few of them a lost curve may stay unnoticed.
const QUESTIONS: usize = 24;
/// Least distance of such a point from the sides, relative to the tolerance, and in grid steps.
const NARROWEST: f64 = 0.02;
const FEWEST_STEPS: f64 = 64.0;

/// The solutions at a point: their number, and whether one is in the working mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Count {
    pub(super) solutions: usize,
    pub(super) working: bool,
}

/// The map between the plane, in units of the longest dimension, and the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    window: Rectangle,
    scale: f64,
}

impl Grid {
    pub(super) fn new(window: &Rectangle) -> Self {
        Self { window: *window, scale: STEPS / window.side() }
    }

    #[expect(clippy::cast_possible_truncation, reason = "within the window")]
    fn point(&self, at: [f64; 2]) -> GridPoint {
        std::array::from_fn(|i| ((at[i] - self.window.low[i]) * self.scale).round() as i64)
    }

    #[expect(clippy::cast_precision_loss, reason = "grid points have at most 34 bits")]
    pub(super) fn place(&self, point: GridPoint) -> [f64; 2] {
        std::array::from_fn(|i| self.window.low[i] + point[i] as f64 / self.scale)
    }
}

/// The faces of all arcs in the window, with the counts of each.
pub(super) struct Counted {
    pub(super) faces: Faces,
    counts: Vec<Count>,
    pub(super) checked_points: usize,
}

/// The edges of all arcs and of the window's sides.
fn edges(arcs: &[Arc<'_>], grid: &Grid) -> Vec<Edge> {
    let mut edges = Vec::new();
    let mut known_ends: Vec<GridPoint> = Vec::new();
    for (number, arc) in arcs.iter().enumerate() {
        let last = arc.nodes.len() - 1;
        let points: Vec<GridPoint> = arc
            .nodes
            .iter()
            .enumerate()
            .map(|(i, node)| {
                let point = grid.point(node.at);
                if i > 0 && i < last && node.mark.is_none() {
                    return point;
                }
                let is_same = |known: &&GridPoint| (0..2).all(|i| (known[i] - point[i]).abs() <= SAME_END);
                if let Some(known) = known_ends.iter().find(is_same) {
                    *known
                } else {
                    known_ends.push(point);
                    point
                }
            })
            .collect();
        edges.extend(points.windows(2).enumerate().map(|(segment, pair)| Edge {
            ends: [pair[0], pair[1]],
            origin: Some(Origin { arc: number, segment, part: [0.0, 1.0] }),
        }));
    }
    let [low, high] = [grid.window.low, grid.window.high].map(|corner| grid.point(corner));
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    edges.extend((0..4).map(|i| Edge { ends: [corners[i], corners[(i + 1) % 4]], origin: None }));
    edges
}

/// Divides the window along all arcs and counts the solutions in each face. `count` is `None` where there is no
/// number.
pub(super) fn counted(
    arcs: &[Arc<'_>],
    grid: &Grid,
    tolerance: f64,
    count: &dyn Fn([f64; 2]) -> Option<Count>,
    observer: &dyn Observer,
) -> Result<Counted, AtlasError> {
    let edges = split_at_meetings(edges(arcs, grid)).ok_or(AtlasError::TooFine { near: None })?;
    let faces = Faces::of(edges);
    let narrowest = (NARROWEST * tolerance * grid.scale).max(FEWEST_STEPS);
    let (mut counts, mut checked_points) = (Vec::new(), 0);
    for face in 0..faces.rings.len() {
        if observer.cancelled() {
            return Err(AtlasError::Cancelled);
        }
        let places = interior(&faces, face, QUESTIONS, narrowest);
        let mut known: Option<Count> = None;
        for Interior { at, clearance } in places {
            let at = std::array::from_fn(|i| grid.window.low[i] + at[i] / grid.scale);
            let Some(found) = count(at) else { continue };
            match known {
                None => {
                    known = Some(found);
                    checked_points += 1;
                }
                Some(known) if known == found => checked_points += 1,
                // Within the tolerance of a curve either number may be right.
                Some(_) if clearance < tolerance * grid.scale => {}
                Some(_) => return Err(AtlasError::Disagreement { near: None }),
            }
        }
        counts.push(known);
    }
    let counts = with_neighbours(&faces, counts);
    Ok(Counted { faces, counts, checked_points })
}

/// The counts, where those of faces that are too narrow are those of the neighbour along the longest side.
fn with_neighbours(faces: &Faces, mut counts: Vec<Option<Count>>) -> Vec<Count> {
    for _ in 0..counts.len() {
        if counts.iter().all(Option::is_some) {
            break;
        }
        let mut filled = counts.clone();
        for (face, _) in counts.iter().enumerate().filter(|(_, count)| count.is_none()) {
            let (outer, holes) = &faces.rings[face];
            let sides = outer.half_edges.iter().chain(holes.iter().flat_map(|hole| &hole.half_edges));
            let beside = sides.filter_map(|half_edge| {
                let other = faces.left[half_edge ^ 1]?;
                let [a, b] = faces.ends(*half_edge);
                let length = (0..2).map(|i| (a[i] - b[i]).unsigned_abs()).max()?;
                Some((length, counts[other]?))
            });
            filled[face] = beside.max_by_key(|(length, _)| *length).map(|(_, count)| count);
        }
        if filled == counts {
            break;
        }
        counts = filled;
    }
    counts.into_iter().map(|count| count.unwrap_or(Count { solutions: 0, working: false })).collect()
}

impl Counted {
    /// The faces joined where a quantity of their counts is the same, with that quantity.
    pub(super) fn joined<T: PartialEq>(&self, quantity: impl Fn(&Count) -> T) -> (Faces, Vec<T>) {
        let value = |half_edge: usize| self.faces.left[half_edge].map(|face| quantity(&self.counts[face]));
        let kept: Vec<usize> =
            (0..self.faces.edges.len()).filter(|edge| value(2 * edge) != value(2 * edge + 1)).collect();
        let edges = kept.iter().map(|edge| self.faces.edges[*edge]).collect();
        let faces = Faces::of(edges);
        let values = faces
            .rings
            .iter()
            .map(|(outer, _)| {
                let half_edge = outer.half_edges[0];
                let own = 2 * kept[half_edge / 2] + half_edge % 2;
                // An outer ring has a face to its left.
                value(own).unwrap_or_else(|| quantity(&Count { solutions: 0, working: false }))
            })
            .collect();
        (faces, values)
    }
}

/// A joined face as a polygon with its area, mm.
pub(super) fn polygon(faces: &Faces, face: usize, arcs: &[Arc<'_>], grid: &Grid, unit: f64) -> Face {
    let (outer, holes) = &faces.rings[face];
    let corners = |ring: &Ring| -> Vec<[f64; 2]> {
        let place =
            |half_edge: &usize| grid.place(faces.ends(*half_edge)[0]).map(|coordinate| coordinate * unit);
        ring.half_edges.iter().map(place).collect()
    };
    let rings = || std::iter::once(outer).chain(holes);
    #[expect(clippy::cast_precision_loss, reason = "the rounding is far below the error")]
    let straight = faces.doubled_area(face) as f64 / 2.0 / grid.scale.powi(2);
    let (mut curved, mut error) = (0.0, 0.0);
    for half_edge in rings().flat_map(|ring| &ring.half_edges) {
        let edge = faces.edges[half_edge / 2];
        let Some(Origin { arc, segment, part }) = edge.origin else { continue };
        let [a, b] = [&arcs[arc].nodes[segment], &arcs[arc].nodes[segment + 1]];
        let bulge = Cubic::between(a, b).area(part);
        curved += if half_edge % 2 == 0 { bulge } else { -bulge };
        let length = (b.at[0] - a.at[0]).hypot(b.at[1] - a.at[1]) * (part[1] - part[0]).abs();
        error += length * (2.0 * b.deviation + SAME_END_LENGTH / grid.scale);
    }
    let label = interior(faces, face, 1, 0.0)
        .first()
        .map_or([0.0; 2], |place| std::array::from_fn(|i| grid.window.low[i] + place.at[i] / grid.scale));
    Face {
        outer: corners(outer),
        holes: holes.iter().map(corners).collect(),
        label: label.map(|coordinate| coordinate * unit),
        area: (straight + curved) * unit * unit,
        area_error: error * unit * unit,
    }
}

/// Rounding of a corner, in grid steps.
const SAME_END_LENGTH: f64 = 1.0;

//! The points at which arcs cross, on the true curves.

use super::answer::PointKind;
use super::arc::Arc;
use super::arc_node::{ArcNode, distance_to_segment};
use super::segment_grid::SegmentGrid;
use crate::workspace::zero;

/// Steps of the iteration from the crossing of two chords, and the distance at which it has converged.
const STEPS: usize = 40;
const CONVERGED: f64 = 1e-14;

/// A node to be inserted: arc, number of the segment, fraction along it.
type Insertion = (usize, usize, f64, ArcNode);

/// Distance within which an end of an arc is on another arc.
const SAME: f64 = 1e-9;

/// Inserts the points at which arcs end on other arcs, or touch them, as nodes of these.
pub(super) fn insert_ends(arcs: &mut [Arc<'_>], tolerance: f64) {
    let is_end = |node: &&ArcNode| matches!(node.mark, Some(PointKind::Corner | PointKind::Tangency));
    let ends: Vec<(usize, ArcNode)> = arcs
        .iter()
        .enumerate()
        .flat_map(|(number, arc)| arc.nodes.iter().filter(is_end).map(move |node| (number, *node)))
        .collect();
    for (owner, end) in ends {
        for (_, arc) in arcs.iter_mut().enumerate().filter(|(number, _)| *number != owner) {
            let is_near =
                |pair: &[ArcNode]| distance_to_segment(end.at, [pair[0].at, pair[1].at]) < tolerance;
            let near: Vec<usize> =
                arc.nodes.windows(2).enumerate().filter(|(_, pair)| is_near(pair)).map(|(i, _)| i).collect();
            for i in near.into_iter().rev() {
                if let Some(node) = passing(arc, i, end.at) {
                    arc.nodes.insert(i + 1, node);
                }
            }
        }
    }
}

/// The node of an arc in a segment at a point, if the arc passes there between the segment's ends.
fn passing(arc: &Arc<'_>, segment: usize, point: [f64; 2]) -> Option<ArcNode> {
    let [a, b] = [&arc.nodes[segment], &arc.nodes[segment + 1]];
    let chord = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
    // How far the point is ahead of a place, along the chord.
    let ahead = |at: [f64; 2]| (point[0] - at[0]) * chord[0] + (point[1] - at[1]) * chord[1];
    let [start, end] = [ahead(a.at), ahead(b.at)];
    if start < 0.0 || end > 0.0 {
        return None;
    }
    let place = |fraction: f64| arc.path.between(&a.q, &b.q, fraction);
    let fraction =
        zero(start, end, 1e-15, |fraction| place(fraction).map_or(f64::NAN, |q| ahead(arc.path.image(&q))));
    let node = arc.path.node(place(fraction)?);
    let is_same = (0..2).all(|i| (node.at[i] - point[i]).abs() < SAME);
    is_same.then_some(ArcNode { at: point, ..node })
}

/// Inserts the crossings of all arcs as nodes of both.
pub(super) fn insert_crossings(arcs: &mut [Arc<'_>]) {
    let segments: Vec<(usize, usize)> = arcs
        .iter()
        .enumerate()
        .flat_map(|(number, arc)| (0..arc.nodes.len().saturating_sub(1)).map(move |i| (number, i)))
        .collect();
    let ends = |&(arc, i): &(usize, usize)| {
        let nodes = &arcs[arc].nodes;
        [nodes[i].at, nodes[i + 1].at]
    };
    let boxes: Vec<[[f64; 2]; 2]> = segments.iter().map(ends).collect();
    let mut insertions: Vec<Insertion> = Vec::new();
    SegmentGrid::new(&boxes).for_each_pair(|i, j| {
        if let Some(at) = fractions(boxes[i], boxes[j]) {
            insertions.extend(crossing(arcs, [segments[i], segments[j]], at).into_iter().flatten());
        }
    });
    // From the last of each segment, so that numbers stay valid.
    insertions.sort_by(|a, b| (b.0, b.1).cmp(&(a.0, a.1)).then(b.2.total_cmp(&a.2)));
    for (arc, segment, _, node) in insertions {
        arcs[arc].nodes.insert(segment + 1, node);
    }
}

/// Where two chords cross, strictly between their ends.
fn fractions([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    const END: f64 = 1e-9;
    let (r, s, o) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]], [c[0] - a[0], c[1] - a[1]]);
    let cross = r[0] * s[1] - r[1] * s[0];
    let at = [(o[0] * s[1] - o[1] * s[0]) / cross, (o[0] * r[1] - o[1] * r[0]) / cross];
    at.iter().all(|fraction| *fraction > END && *fraction < 1.0 - END).then_some(at)
}

/// The crossing on both curves, near that of two chords.
fn crossing(arcs: &[Arc<'_>], of: [(usize, usize); 2], start: [f64; 2]) -> Option<[Insertion; 2]> {
    let nodes = of.map(|(arc, i)| [&arcs[arc].nodes[i], &arcs[arc].nodes[i + 1]]);
    let chords = nodes.map(|[a, b]| [b.at[0] - a.at[0], b.at[1] - a.at[1]]);
    let cross = chords[0][0] * chords[1][1] - chords[0][1] * chords[1][0];
    let place = |which: usize, fraction: f64| {
        let path = &arcs[of[which].0].path;
        path.between(&nodes[which][0].q, &nodes[which][1].q, fraction).map(|q| (q, path.image(&q)))
    };
    let mut at = start;
    for _ in 0..STEPS {
        let [(p, first), (q, second)] = [place(0, at[0])?, place(1, at[1])?];
        let gap = [second[0] - first[0], second[1] - first[1]];
        if gap[0].abs().max(gap[1].abs()) < CONVERGED {
            let point = [0.5 * (first[0] + second[0]), 0.5 * (first[1] + second[1])];
            let is_drawn = of.iter().all(|(arc, _)| arcs[*arc].kind.is_some());
            let insertion = |which: usize, q| {
                let (arc, segment) = of[which];
                let mark = is_drawn.then_some(PointKind::Crossing);
                (arc, segment, at[which], ArcNode { at: point, mark, ..arcs[arc].path.node(q) })
            };
            return Some([insertion(0, p), insertion(1, q)]);
        }
        // Newton's method with the chords in place of the tangents.
        at[0] += (gap[0] * chords[1][1] - gap[1] * chords[1][0]) / cross;
        at[1] += (gap[0] * chords[0][1] - gap[1] * chords[0][0]) / cross;
        if !at.iter().all(|fraction| (0.0..=1.0).contains(fraction)) {
            return None;
        }
    }
    None
}

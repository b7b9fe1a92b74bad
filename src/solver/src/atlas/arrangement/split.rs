//! Cuts segments where they meet.

use std::collections::BTreeMap;

use super::super::segment_grid::SegmentGrid;
use super::{Edge, GridPoint, Origin, orientation};

/// Most rounds. Rounding makes few new meetings, and those of the next round are fewer.
const MOST_ROUNDS: usize = 20;

/// Cuts the edges at all their meetings. Edges of the same two ends are one. `None` if rounding makes new meetings
/// again and again.
pub(in crate::atlas) fn split_at_meetings(mut edges: Vec<Edge>) -> Option<Vec<Edge>> {
    for _ in 0..MOST_ROUNDS {
        edges = distinct(edges);
        let cuts = cuts(&edges);
        if cuts.iter().all(Vec::is_empty) {
            return Some(edges);
        }
        edges = edges.iter().zip(cuts).flat_map(|(edge, cuts)| edge.cut_at(cuts)).collect();
    }
    None
}

/// The edges without those of no length and without repetitions.
fn distinct(edges: Vec<Edge>) -> Vec<Edge> {
    let mut known: BTreeMap<[GridPoint; 2], Edge> = BTreeMap::new();
    for edge in edges {
        let [a, b] = edge.ends;
        if a != b {
            known.entry([a.min(b), a.max(b)]).or_insert(edge);
        }
    }
    known.into_values().collect()
}

/// The points at which each edge must be cut.
fn cuts(edges: &[Edge]) -> Vec<Vec<GridPoint>> {
    let boxes: Vec<[[f64; 2]; 2]> = edges.iter().map(|edge| edge.ends.map(rounded)).collect();
    let mut cuts = vec![Vec::new(); edges.len()];
    SegmentGrid::new(&boxes).for_each_pair(|i, j| {
        let [e, f] = [edges[i].ends, edges[j].ends];
        for (own, other, number) in [(e, f, i), (f, e, j)] {
            cuts[number].extend(other.into_iter().filter(|end| is_within(own, *end)));
        }
        if let Some(at) = proper_meeting(e, f) {
            for (number, ends) in [(i, e), (j, f)] {
                if !ends.contains(&at) {
                    cuts[number].push(at);
                }
            }
        }
    });
    cuts
}

#[expect(clippy::cast_precision_loss, reason = "grid points have at most 34 bits")]
fn rounded(point: GridPoint) -> [f64; 2] {
    point.map(|coordinate| coordinate as f64)
}

/// Whether a point lies on a segment, but is none of its ends.
fn is_within([a, b]: [GridPoint; 2], point: GridPoint) -> bool {
    let between = |i: usize| (a[i].min(b[i])..=a[i].max(b[i])).contains(&point[i]);
    point != a && point != b && between(0) && between(1) && orientation(a, b, point) == 0
}

/// The grid point nearest to the place where two segments cross in their interiors.
fn proper_meeting([a, b]: [GridPoint; 2], [c, d]: [GridPoint; 2]) -> Option<GridPoint> {
    let [ca, cb] = [orientation(c, d, a), orientation(c, d, b)];
    let [ac, ad] = [orientation(a, b, c), orientation(a, b, d)];
    if ca.signum() * cb.signum() >= 0 || ac.signum() * ad.signum() >= 0 {
        return None;
    }
    // a + (b - a) ca / (ca - cb), rounded.
    let whole = ca - cb;
    Some(std::array::from_fn(|i| {
        let product = (i128::from(b[i]) - i128::from(a[i])) * ca;
        let (product, whole) = if whole < 0 { (-product, -whole) } else { (product, whole) };
        let shift = (2 * product + whole).div_euclid(2 * whole);
        a[i] + i64::try_from(shift).unwrap_or_default()
    }))
}

impl Edge {
    /// The parts between some of its points.
    fn cut_at(&self, mut points: Vec<GridPoint>) -> Vec<Self> {
        let [a, b] = self.ends.map(rounded);
        let (run, rise) = (b[0] - a[0], b[1] - a[1]);
        let square = run * run + rise * rise;
        let fraction = |point: GridPoint| {
            let at = rounded(point);
            (((at[0] - a[0]) * run + (at[1] - a[1]) * rise) / square).clamp(0.0, 1.0)
        };
        points.sort_by(|p, q| fraction(*p).total_cmp(&fraction(*q)).then(p.cmp(q)));
        points.dedup();
        let mut chain = vec![(self.ends[0], 0.0)];
        chain.extend(points.into_iter().map(|point| (point, fraction(point))));
        chain.push((self.ends[1], 1.0));
        chain
            .windows(2)
            .map(|pair| {
                let [(from, start), (to, end)] = [pair[0], pair[1]];
                let origin = self.origin.map(|origin| {
                    let at = |fraction: f64| origin.part[0] + (origin.part[1] - origin.part[0]) * fraction;
                    Origin { part: [at(start), at(end)], ..origin }
                });
                Self { ends: [from, to], origin }
            })
            .collect()
    }
}

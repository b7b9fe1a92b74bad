//! Curves as chains of points on them, with tangents, within a tolerance.

use super::answer::{CurveKind, PointKind};
use super::arc_node::{ArcNode, distance_to_segment};
use super::cubic::Cubic;
use super::path::Path;
use super::place::Configuration;
use super::rectangle::Rectangle;

/// Halvings of a chord.
const DEEPEST: u32 = 48;
/// A chord is off by about this part of its length times the sine of the angle between it and the tangent at an end.
const SAG: f64 = 0.2;
/// The part of the tolerance that chords use.
const SHARE: f64 = 0.4;

/// A piece of a curve.
#[derive(Clone, Debug)]
pub(super) struct Arc<'a> {
    /// `None` for a boundary of the working mode that changes no number of solutions.
    pub(super) kind: Option<CurveKind>,
    pub(super) path: Path<'a>,
    pub(super) nodes: Vec<ArcNode>,
    pub(super) closed: bool,
}

/// How fine an arc is, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fineness {
    pub(super) tolerance: f64,
    pub(super) window: Rectangle,
}

impl Path<'_> {
    /// A node at a configuration.
    pub(super) fn node(&self, q: Configuration) -> ArcNode {
        ArcNode { q, at: self.image(&q), direction: self.direction(&q), mark: None, deviation: 0.0 }
    }

    /// The nodes of a chain of configurations, with more between them.
    pub(super) fn refined(&self, chain: &[Configuration], fineness: &Fineness) -> Vec<ArcNode> {
        let mut nodes: Vec<ArcNode> = Vec::with_capacity(2 * chain.len());
        let Some(first) = chain.first() else { return nodes };
        nodes.push(self.node(*first));
        for pair in chain.windows(2) {
            let (a, b) = (self.node(pair[0]), self.node(pair[1]));
            self.refine(&a, &b, 0, fineness, &mut nodes);
        }
        self.mark_cusps(&mut nodes);
        nodes
    }

    /// Marks the cusps that were nodes already, as where a symmetric curve begins.
    fn mark_cusps(&self, nodes: &mut [ArcNode]) {
        if !self.is_critical() || nodes.len() < 3 {
            return;
        }
        let last = nodes.len() - 1;
        let is_closed = nodes[0].at == nodes[last].at || {
            let [a, b] = [nodes[0].at, nodes[last].at];
            (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12
        };
        for i in 0..last {
            let before = match (i, is_closed) {
                (0, true) => last - 1,
                (0, false) => continue,
                _ => i - 1,
            };
            let [p, q, r] = [nodes[before].at, nodes[i].at, nodes[i + 1].at];
            if (q[0] - p[0]) * (r[0] - q[0]) + (q[1] - p[1]) * (r[1] - q[1]) < 0.0 {
                nodes[i].mark = Some(PointKind::Cusp);
            }
        }
    }

    /// Adds the nodes after `a` up to `b`.
    fn refine(&self, a: &ArcNode, b: &ArcNode, depth: u32, fineness: &Fineness, nodes: &mut Vec<ArcNode>) {
        let reaches = fineness.window.may_meet([a.at, b.at]);
        let middle = if depth < DEEPEST && reaches { self.between(&a.q, &b.q, 0.5) } else { None };
        let Some(middle) = middle.map(|q| self.node(q)) else {
            nodes.push(*b);
            return;
        };
        if let Some([from, cusp, to]) = self.cusp([a, &middle, b]) {
            self.refine(&from, &cusp, depth + 1, fineness, nodes);
            self.refine(&cusp, &to, depth + 1, fineness, nodes);
            return;
        }
        let chord = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
        let length = chord[0].hypot(chord[1]);
        let most = SHARE * fineness.tolerance;
        let off = distance_to_segment(middle.at, [a.at, b.at]);
        let sag =
            |node: &ArcNode| node.direction.map_or(0.0, |d| SAG * (d[0] * chord[1] - d[1] * chord[0]).abs());
        if length < 1e-3 * most || (off <= most && sag(a) <= most && sag(b) <= most && sag(&middle) <= most) {
            nodes.push(ArcNode { deviation: Cubic::between(a, b).deviation(middle.at), ..*b });
        } else {
            self.refine(a, &middle, depth + 1, fineness, nodes);
            self.refine(&middle, b, depth + 1, fineness, nodes);
        }
    }

    /// The cusp between two of three consecutive nodes of a critical curve, with its neighbours: the ends, where the
    /// image moves in opposite senses.
    fn cusp(&self, nodes: [&ArcNode; 3]) -> Option<[ArcNode; 3]> {
        let chord: Configuration = std::array::from_fn(|i| nodes[2].q[i] - nodes[0].q[i]);
        let velocity = |node: &ArcNode| {
            let is_known = node.mark != Some(PointKind::Cusp);
            if is_known { self.critical_velocity(&node.q, &chord) } else { None }
        };
        let velocities = nodes.map(velocity);
        for i in 0..2 {
            let (Some(a), Some(b)) = (velocities[i], velocities[i + 1]) else { continue };
            if a[0] * b[0] + a[1] * b[1] >= 0.0 {
                continue;
            }
            let along = [a[0] - b[0], a[1] - b[1]];
            let speed = |v: [f64; 2]| v[0] * along[0] + v[1] * along[1];
            let (from, to) = (nodes[i], nodes[i + 1]);
            let fraction = crate::workspace::zero(speed(a), speed(b), 1e-13, |fraction| {
                let at = self.between(&from.q, &to.q, fraction);
                at.and_then(|q| self.critical_velocity(&q, &chord)).map_or(f64::NAN, speed)
            });
            let q = self.between(&from.q, &to.q, fraction)?;
            let cusp = ArcNode { mark: Some(PointKind::Cusp), ..self.node(q) };
            return Some([*nodes[0], cusp, *nodes[2]]);
        }
        None
    }
}

//! The part of an arc in the window.

use super::arc::Arc;
use super::arc_node::ArcNode;
use super::rectangle::Rectangle;

/// Halvings in search of a part of a segment in the window.
const DEEPEST: u32 = 12;

impl Arc<'_> {
    /// The pieces in the window. Their ends on its sides are exact.
    pub(super) fn clipped(self, window: &Rectangle) -> Vec<Self> {
        if self.nodes.iter().all(|node| window.contains(node.at)) {
            return vec![self];
        }
        let mut pieces: Vec<Vec<ArcNode>> = Vec::new();
        let mut piece: Vec<ArcNode> =
            self.nodes.first().filter(|n| window.contains(n.at)).copied().into_iter().collect();
        for pair in self.nodes.windows(2) {
            self.clip([&pair[0], &pair[1]], window, 0, &mut piece, &mut pieces);
        }
        pieces.push(piece);
        // The last piece of a closed arc continues in its first.
        if self.closed
            && pieces.len() > 1
            && window.contains(self.nodes[0].at)
            && let Some(mut last) = pieces.pop()
        {
            last.pop();
            last.append(&mut pieces[0]);
            pieces[0] = last;
        }
        let Self { kind, path, .. } = self;
        pieces
            .into_iter()
            .filter(|nodes| nodes.len() >= 2)
            .map(|nodes| Self { kind, path, nodes, closed: false })
            .collect()
    }

    fn clip(
        &self,
        [a, b]: [&ArcNode; 2],
        window: &Rectangle,
        depth: u32,
        piece: &mut Vec<ArcNode>,
        pieces: &mut Vec<Vec<ArcNode>>,
    ) {
        match (window.contains(a.at), window.contains(b.at)) {
            (true, true) => piece.push(*b),
            (true, false) => {
                piece.extend(self.border([a, b], window));
                pieces.push(std::mem::take(piece));
            }
            (false, true) => {
                piece.extend(self.border([b, a], window));
                piece.push(*b);
            }
            (false, false) => {
                let Some(fraction) = chord_inside(window, [a.at, b.at]) else { return };
                if depth >= DEEPEST {
                    return;
                }
                let Some(middle) = self.path.between(&a.q, &b.q, fraction).map(|q| self.path.node(q)) else {
                    return;
                };
                self.clip([a, &middle], window, depth + 1, piece, pieces);
                self.clip([&middle, b], window, depth + 1, piece, pieces);
            }
        }
    }

    /// The point on the window's side between a node inside and one outside.
    fn border(&self, [inside, outside]: [&ArcNode; 2], window: &Rectangle) -> Option<ArcNode> {
        let reserve = |at| window.reserve(at);
        let fraction = crate::workspace::zero(reserve(inside.at), reserve(outside.at), 1e-15, |fraction| {
            let q = self.path.between(&inside.q, &outside.q, fraction);
            q.map_or(f64::NAN, |q| reserve(self.path.image(&q)))
        });
        let node = self.path.node(self.path.between(&inside.q, &outside.q, fraction)?);
        // On the side exactly.
        let mut at = window.clamped(node.at);
        let sides = [(0, window.low[0]), (0, window.high[0]), (1, window.low[1]), (1, window.high[1])];
        let nearest =
            sides.into_iter().min_by(|a, b| (at[a.0] - a.1).abs().total_cmp(&(at[b.0] - b.1).abs()))?;
        at[nearest.0] = nearest.1;
        Some(ArcNode { at, ..node })
    }
}

/// The fraction of the middle of the part of a segment in the rectangle.
fn chord_inside(window: &Rectangle, [a, b]: [[f64; 2]; 2]) -> Option<f64> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for i in 0..2 {
        let run = b[i] - a[i];
        if run == 0.0 {
            if a[i] < window.low[i] || a[i] > window.high[i] {
                return None;
            }
            continue;
        }
        let [x, y] = [(window.low[i] - a[i]) / run, (window.high[i] - a[i]) / run];
        (from, to) = (from.max(x.min(y)), to.min(x.max(y)));
    }
    (from < to).then_some(0.5 * (from + to))
}

//! Boxes that cover the plane domain: outside, inside, or crossed by known limits.
//!
//! The rectangle that the legs reach is halved again and again. Bounds of every limit over a box prove that it is
//! outside, prove that it is inside, or leave the limits that may vanish there. A box is `simple` if each of these
//! limits rises or falls throughout along y. Then every line x = const crosses the domain in at most one interval in
//! the box. A box is `open` if all of them rise in one common direction. Then a walk in that direction from a point
//! of the domain stays in the domain as far as the box reaches, and no piece and no hole of the domain is hidden
//! inside the box.

mod first;
mod interval;
mod judgement;
mod ranges;
mod rectangle;
mod search;
mod separation;
#[cfg(test)]
#[allow(clippy::cast_precision_loss, reason = "53 bits")]
mod tests;

pub(super) use rectangle::Rectangle;
use rectangle::meets;

/// The purpose of the boxes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Purpose {
    /// Integration over lines x = const. Where a line's structure may change, the boxes become so small that their
    /// area is negligible, or is part of the error.
    Lines,
    /// Detection of pieces and holes: none that is wider than this is hidden in a box.
    Pieces(f64),
}

/// The state of a box.
#[derive(Clone, Copy, Debug)]
pub(super) enum State {
    /// Some limit is violated everywhere in the box.
    Outside,
    /// Every limit is kept everywhere in the box.
    Inside,
    /// The limits, a bit each, that may vanish in the box; the others are kept.
    Crossed {
        limits: u32,
        /// Whether each of them rises or falls along y everywhere.
        simple: bool,
        /// Whether a line's structure may change in the box.
        event: bool,
    },
}

#[derive(Clone, Copy, Debug)]
struct Node {
    place: Rectangle,
    state: State,
    /// The first of the two halves.
    halves: Option<usize>,
    /// Size down to which pieces of the domain may be hidden near this box.
    grain: f64,
    /// A bound of a column's volume over its area.
    weight: f64,
}

/// A box that is not halved any more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    pub(super) place: Rectangle,
    pub(super) state: State,
    /// A bound of a column's volume over its area, where a line's structure may change.
    pub(super) weight: f64,
}

/// The boxes of one domain, as a tree.
pub(super) struct Cover {
    nodes: Vec<Node>,
    /// The trees below and above y = 0.
    roots: Vec<usize>,
}

impl Cover {
    /// The boxes that are not outside.
    pub(super) fn leaves(&self) -> impl Iterator<Item = Leaf> {
        let leaf = |node: &Node| Leaf { place: node.place, state: node.state, weight: node.weight };
        self.nodes.iter().filter(|node| node.halves.is_none() && !node.is_outside()).map(leaf)
    }

    /// Whether the cover has an inside box that is at least this wide.
    pub(super) fn holds(&self, width: f64) -> bool {
        self.leaves().any(|leaf| {
            let [low, high] = leaf.place;
            matches!(leaf.state, State::Inside) && (high[0] - low[0]).min(high[1] - low[1]) >= width
        })
    }

    /// A rectangle that holds the domain; `None` where it is empty.
    pub(super) fn bounds(&self) -> Option<Rectangle> {
        bounds(self.nodes.iter())
    }

    /// Calls `meet` with the boxes that the line at x crosses and that are not outside, by rising y.
    pub(super) fn line(&self, x: f64, meet: &mut dyn FnMut(&Leaf)) {
        for &root in &self.roots {
            self.line_from(root, x, meet);
        }
    }

    fn line_from(&self, number: usize, x: f64, meet: &mut dyn FnMut(&Leaf)) {
        let node = &self.nodes[number];
        let Some(first) = node.halves else {
            let [low, high] = node.place;
            if !node.is_outside() && (low[0]..=high[0]).contains(&x) {
                meet(&Leaf { place: node.place, state: node.state, weight: node.weight });
            }
            return;
        };
        let beside = self.nodes[first + 1].place[0][0];
        if beside == node.place[0][0] {
            self.line_from(first, x, meet);
            self.line_from(first + 1, x, meet);
        } else {
            self.line_from(first + usize::from(x >= beside), x, meet);
        }
    }

    /// The least size down to which something may be hidden near a segment, among the boxes that it crosses: a piece
    /// of the domain if the segment is `outside`, else a hole or a limit.
    pub(super) fn grain(&self, ends: [[f64; 2]; 2], outside: bool) -> f64 {
        self.roots.iter().map(|&root| self.grain_from(root, ends, outside)).fold(f64::INFINITY, f64::min)
    }

    fn grain_from(&self, number: usize, ends: [[f64; 2]; 2], outside: bool) -> f64 {
        let node = &self.nodes[number];
        if !meets(&node.place, ends) {
            return f64::INFINITY;
        }
        match (node.halves, node.state) {
            (Some(first), _) => {
                self.grain_from(first, ends, outside).min(self.grain_from(first + 1, ends, outside))
            }
            (None, State::Outside) if outside => f64::INFINITY,
            (None, State::Inside) if !outside => f64::INFINITY,
            _ => node.grain,
        }
    }
}

impl Node {
    const fn is_outside(&self) -> bool {
        matches!(self.state, State::Outside)
    }
}

/// A rectangle around the boxes that are not outside.
fn bounds<'a>(nodes: impl Iterator<Item = &'a Node>) -> Option<Rectangle> {
    nodes.filter(|node| node.halves.is_none() && !node.is_outside()).map(|node| node.place).reduce(|a, b| {
        [[a[0][0].min(b[0][0]), a[0][1].min(b[0][1])], [a[1][0].max(b[1][0]), a[1][1].max(b[1][1])]]
    })
}

//! Boxes that cover the plane domain: outside, inside, or crossed by known limits.
//!
//! The rectangle that the legs reach is halved again and again. Bounds of every limit over a box prove that it is
//! outside, prove that it is inside, or leave the limits that may vanish there. A box is `simple` if each of these
//! limits rises or falls throughout along y. Then every line x = const crosses the domain in at most one interval in
//! the box. A box is `open` if all of them rise in one common direction. Then a walk in that direction from a point
//! of the domain stays in the domain as far as the box reaches, and no component and no hole of the domain is hidden
//! inside the box.

mod classification;
mod leg_one;
mod limit_bounds;
mod posture_bounds;
mod rectangle;
mod rod_distance;
mod subdivision;
#[cfg(test)]
#[allow(clippy::cast_precision_loss, clippy::unwrap_used, reason = "tests")]
mod tests;

use super::domain::LimitSet;
pub(super) use rectangle::Rectangle;
use rectangle::meets;

/// The purpose of the boxes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Purpose {
    /// Integration over lines x = const. Where a line's structure may change, the boxes become so small that their
    /// area is negligible, or is added to the error.
    Integration,
    /// Detection of components and holes: none that is wider than this, mm, is hidden in a box.
    Meshing(f64),
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
        limits: LimitSet,
        /// Whether each of them rises or falls along y everywhere.
        simple: bool,
        /// Whether a line's structure may change in the box.
        event: bool,
    },
}

#[derive(Clone, Copy, Debug)]
struct Node {
    rectangle: Rectangle,
    state: State,
    /// The first of the two halves.
    halves: Option<usize>,
    /// Size down to which components or holes of the domain may be hidden near this box.
    hidden_size: f64,
    /// A bound of a column's volume over its area.
    weight: f64,
}

/// A box that is not halved any more.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoverBox {
    pub(super) rectangle: Rectangle,
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
    pub(super) fn boxes(&self) -> impl Iterator<Item = CoverBox> {
        self.nodes.iter().filter(|node| node.is_covering()).map(Node::cover_box)
    }

    /// Whether the cover has an inside box that is at least this wide.
    pub(super) fn has_inside_box(&self, width: f64) -> bool {
        self.boxes().any(|found| {
            let [low, high] = found.rectangle;
            matches!(found.state, State::Inside) && (high[0] - low[0]).min(high[1] - low[1]) >= width
        })
    }

    /// A rectangle that contains the domain; `None` where it is empty.
    pub(super) fn bounds(&self) -> Option<Rectangle> {
        bounds(self.nodes.iter())
    }

    /// Calls `meet` with the boxes that the line at x crosses and that are not outside, by rising y.
    pub(super) fn line(&self, x: f64, meet: &mut dyn FnMut(&CoverBox)) {
        for &root in &self.roots {
            self.line_from(root, x, meet);
        }
    }

    fn line_from(&self, number: usize, x: f64, meet: &mut dyn FnMut(&CoverBox)) {
        let node = &self.nodes[number];
        let Some(first) = node.halves else {
            let [low, high] = node.rectangle;
            if !node.is_outside() && (low[0]..=high[0]).contains(&x) {
                meet(&node.cover_box());
            }
            return;
        };
        let beside = self.nodes[first + 1].rectangle[0][0];
        if beside == node.rectangle[0][0] {
            self.line_from(first, x, meet);
            self.line_from(first + 1, x, meet);
        } else {
            self.line_from(first + usize::from(x >= beside), x, meet);
        }
    }

    /// The least size down to which something may be hidden near a segment, among the boxes that it crosses: a
    /// component of the domain if the segment is `outside`, else a hole or a limit.
    pub(super) fn hidden_size(&self, ends: [[f64; 2]; 2], outside: bool) -> f64 {
        self.roots
            .iter()
            .map(|&root| self.hidden_size_from(root, ends, outside))
            .fold(f64::INFINITY, f64::min)
    }

    fn hidden_size_from(&self, number: usize, ends: [[f64; 2]; 2], outside: bool) -> f64 {
        let node = &self.nodes[number];
        if !meets(&node.rectangle, ends) {
            return f64::INFINITY;
        }
        match (node.halves, node.state) {
            (Some(first), _) => self.hidden_size_from(first, ends, outside).min(self.hidden_size_from(
                first + 1,
                ends,
                outside,
            )),
            (None, State::Outside) if outside => f64::INFINITY,
            (None, State::Inside) if !outside => f64::INFINITY,
            _ => node.hidden_size,
        }
    }
}

impl Node {
    const fn cover_box(&self) -> CoverBox {
        CoverBox { rectangle: self.rectangle, state: self.state, weight: self.weight }
    }

    /// Whether the box is not halved and not outside.
    const fn is_covering(&self) -> bool {
        self.halves.is_none() && !self.is_outside()
    }

    const fn is_outside(&self) -> bool {
        matches!(self.state, State::Outside)
    }
}

/// A rectangle around the boxes that are not outside.
fn bounds<'a>(nodes: impl Iterator<Item = &'a Node>) -> Option<Rectangle> {
    nodes.filter(|node| node.is_covering()).map(|node| node.rectangle).reduce(|a, b| {
        [[a[0][0].min(b[0][0]), a[0][1].min(b[0][1])], [a[1][0].max(b[1][0]), a[1][1].max(b[1][1])]]
    })
}

//! A circle about the tilting axis and the arcs of it that lie in the tool's workspace.
//!
//! The angle beta is zero above the axis: eta = r sin beta, zeta = -r cos beta. A part point at (V1, Z - dt) = (-r
//! sin psi, r cos psi) is at beta if theta1 = beta - psi, by Eq (26). Then phi1 = alpha - beta + psi.

use std::f64::consts::{PI, TAU};

use super::monotone_piece::{ALPHA, MonotonePiece};
use super::section::ToolWorkspace;
use crate::fast_math::sin_cos;
use crate::workspace::domain::{Binding, stroke_binding};
use crate::workspace::feasible_intervals::{LimitFunctions, intervals};

/// Least number of segments of a circle.
const SEGMENTS: f64 = 24.0;
/// Least number of segments of an arc.
const LEAST: f64 = 3.0;

/// An arc of a circle on which the tool's position keeps all limits but the table's, and on which phi1 + psi is
/// monotone.
#[derive(Clone, Copy)]
pub(super) struct Arc<'a> {
    pub(super) circle: Circle<'a>,
    /// Least and greatest beta.
    pub(super) ends: [f64; 2],
    /// The constraint that ends it; `None` if it was only cut there.
    pub(super) bindings: [Option<Binding>; 2],
    /// Whether alpha - beta rises with beta: the part's map is folded.
    pub(super) folded: bool,
}

/// A circle and a piece of the section that it crosses.
#[derive(Clone, Copy)]
pub(super) struct Circle<'a> {
    pub(super) tool: &'a ToolWorkspace<'a>,
    pub(super) piece: &'a MonotonePiece,
    pub(super) radius: f64,
}

/// The arcs of the circle of a radius in a section.
pub(super) fn arcs<'a>(
    tool: &'a ToolWorkspace<'a>,
    section: &'a [MonotonePiece],
    radius: f64,
) -> Vec<Arc<'a>> {
    let mut found = Vec::new();
    for piece in section {
        let circle = Circle { tool, piece, radius };
        for (window, bindings) in windows(piece, radius) {
            if circle.meets(window) {
                circle.within(window, bindings, &mut found);
            }
        }
    }
    found
}

/// Finds the angles at which a circle is within a piece's range of eta.
fn windows(piece: &MonotonePiece, radius: f64) -> Vec<([f64; 2], [Option<Binding>; 2])> {
    let ([least, greatest], [low, high]) = (piece.range(), piece.bindings);
    let [from, to] = [least / radius, greatest / radius];
    match (from > -1.0, to < 1.0) {
        _ if from >= 1.0 || to <= -1.0 || radius <= 0.0 => Vec::new(),
        (false, false) => vec![([-PI, PI], [None; 2])],
        (true, false) => vec![([from.asin(), PI - from.asin()], [low; 2])],
        (false, true) => vec![([-PI - to.asin(), to.asin()], [high; 2])],
        (true, true) => {
            vec![([from.asin(), to.asin()], [low, high]), ([PI - to.asin(), PI - from.asin()], [high, low])]
        }
    }
}

impl<'a> Circle<'a> {
    /// Whether the heights of a window and of the piece overlap.
    fn meets(self, [from, to]: [f64; 2]) -> bool {
        // Between the ends zeta has extremes only at the top and the bottom of the circle.
        let crosses = |angle: f64| from <= angle && angle <= to;
        let ends = [from, to].map(|beta| -self.radius * beta.cos());
        let highest = if crosses(0.0) { -self.radius } else { ends[0].min(ends[1]) };
        let lowest = if crosses(PI) || crosses(-PI) { self.radius } else { ends[0].max(ends[1]) };
        highest <= self.piece.zetas[1] && lowest >= self.piece.zetas[0]
    }

    /// The arcs of a window on which the strokes are kept.
    fn within(self, window: [f64; 2], bindings: [Option<Binding>; 2], found: &mut Vec<Arc<'a>>) {
        for cuts in intervals(&Strokes(self), window, segments(window)) {
            let name = |end: usize| match cuts[end].limit {
                Some(limit) => Some(stroke_binding(SLIDERS[limit / 2], limit % 2 == 1)),
                None if cuts[end].t == window[end] => bindings[end],
                None => None,
            };
            let ends = cuts.map(|cut| cut.t);
            let arc = Arc { circle: self, ends, bindings: [name(0), name(1)], folded: false };
            if self.piece.folds { arc.unfolded(found) } else { found.push(arc) }
        }
    }

    /// alpha at an angle.
    #[inline]
    pub(super) fn alpha(&self, beta: f64) -> f64 {
        self.piece.value(ALPHA, self.radius * beta.sin())
    }
}

const SLIDERS: [u8; 3] = [0, 1, 2];

/// Number of segments for an interval of the angle.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
pub(super) fn segments([from, to]: [f64; 2]) -> u32 {
    (SEGMENTS * (to - from) / TAU).ceil().clamp(LEAST, 4.0 * SEGMENTS) as u32
}

impl Arc<'_> {
    /// Cuts the arc where the part's map folds.
    fn unfolded(self, found: &mut Vec<Self>) {
        for folded in [false, true] {
            let sign = if folded { -1.0 } else { 1.0 };
            for cuts in intervals(&Upright(self.circle, sign), self.ends, segments(self.ends)) {
                let ends = cuts.map(|cut| cut.t);
                let binding = |end: usize| self.bindings[end].filter(|_| ends[end] == self.ends[end]);
                found.push(Arc { ends, bindings: [binding(0), binding(1)], folded, ..self });
            }
        }
    }

    /// Whether it is a whole circle.
    pub(super) fn closed(&self) -> bool {
        self.ends == [-PI, PI] && self.bindings == [None; 2] && !self.folded
    }
}

/// The six ends of the strokes along a circle, mm.
struct Strokes<'a>(Circle<'a>);

impl Strokes<'_> {
    #[inline]
    fn rho(&self, beta: f64) -> [f64; 3] {
        let Circle { piece, radius, .. } = self.0;
        let (s, c) = sin_cos(beta);
        piece.drops(radius * s).map(|drop| -radius * c - drop)
    }
}

impl LimitFunctions<6> for Strokes<'_> {
    fn values(&self, beta: f64) -> [f64; 6] {
        let (rho, stroke) = (self.rho(beta), &self.0.tool.machine.limits().stroke);
        std::array::from_fn(|n| stroke_room(rho[n / 2], stroke[n / 2], n % 2))
    }

    fn value(&self, limit: usize, beta: f64) -> f64 {
        let slider = limit / 2;
        let Circle { piece, radius, .. } = self.0;
        let (s, c) = sin_cos(beta);
        let rho = -radius * c - piece.value(slider, radius * s);
        stroke_room(rho, self.0.tool.machine.limits().stroke[slider], limit % 2)
    }
}

fn stroke_room(rho: f64, [low, high]: [f64; 2], end: usize) -> f64 {
    if end == 0 { rho - low } else { high - rho }
}

/// The sign of d(beta - alpha)/d(beta).
struct Upright<'a>(Circle<'a>, f64);

impl LimitFunctions<1> for Upright<'_> {
    fn values(&self, beta: f64) -> [f64; 1] {
        [self.value(0, beta)]
    }

    fn value(&self, _: usize, beta: f64) -> f64 {
        let Circle { piece, radius, .. } = self.0;
        self.1 * (1.0 - piece.alpha_rate(radius * beta.sin()) * radius * beta.cos())
    }
}

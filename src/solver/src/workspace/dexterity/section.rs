//! The tool's workspace at constant x: a plane region between two graphs.
//!
//! The tool centre point U is measured from the table's tilting axis: eta = U_y and zeta = U_z - da, down.

use super::floor::Floor;
use super::monotone_piece::{ALPHA, HermiteNode, MonotonePiece};
use super::request::DexterityRequest;
use crate::clearance::Clearance;
use crate::machine::Machine;
use crate::workspace::column::Column;
use crate::workspace::domain::{Domain, Limit};
use crate::workspace::feasible_intervals::{Curve, Cut, LimitFunctions, intervals};
use crate::workspace::request::{Kind, Request};

/// Number of segments of a line x = const on which its intervals in the plane domain are searched.
const SEGMENTS: u32 = 53;
/// Number of samples along a piece, at first and at most.
const NODES: [u32; 2] = [64, 1_024];
/// Greatest error of the cubics between samples, mm; for alpha, times the machine's size.
const PRECISE: f64 = 1e-7;
/// Margin around the range of sampled values, as a fraction of it.
const ROOM: f64 = 0.1;
/// Jacobian determinant of the part's map below which a piece is examined for folds.
const UPRIGHT: f64 = 0.05;
/// An arbitrary tolerance: no surface is made here.
const NO_TOLERANCE: f64 = 1.0;

/// The tool workspace of a machine. Planes x = const cut it in sections.
pub(super) struct ToolWorkspace<'a> {
    pub(super) machine: &'a Machine,
    pub(super) domain: Domain<'a>,
    pub(super) length: f64,
    /// Middle and half of the tilting range; `None` if it is a whole turn.
    pub(super) tilt: Option<[f64; 2]>,
    /// Whether the rotary angle is out of its range.
    pub(super) empty: bool,
    /// The table's plane, if it is a limit.
    pub(super) floor: Option<Floor<'a>>,
}

impl<'a> ToolWorkspace<'a> {
    pub(super) fn new(machine: &'a Machine, request: &DexterityRequest) -> Self {
        let DexterityRequest { tool_length, table_clearance, tool_radius, phi2, .. } = *request;
        let question = |kind| Request { tool_length, phi2, ..Request::new(kind, NO_TOLERANCE) };
        // The table's limits belong to the part's domain. Here they depend on more than a column.
        let part = Domain::new(machine, &question(Kind::Part), None);
        let domain = Domain::new(machine, &question(Kind::Tool), None);
        let clearance = Clearance::of(machine, table_clearance, tool_length, tool_radius);
        let floor = clearance.map(|clearance| Floor { machine, clearance });
        Self { machine, domain, length: tool_length, tilt: part.alpha_range, empty: part.empty, floor }
    }

    /// The pieces at x, ascending in y.
    pub(super) fn section(&self, x: f64) -> Vec<MonotonePiece> {
        if self.empty {
            return Vec::new();
        }
        let [low, high] = self.domain.rectangle();
        let line = Curve { domain: &self.domain, at: |y| [x, y] };
        let mut pieces = Vec::new();
        for ends in intervals(&line, [low[1], high[1]], SEGMENTS) {
            self.pieces(x, ends, &mut pieces);
        }
        pieces
    }

    /// An interval of y, cut where the tool's map folds.
    fn pieces(&self, x: f64, ends: [Cut; 2], pieces: &mut Vec<MonotonePiece>) {
        let whole = self.piece(x, ends);
        let rising = whole.nodes.windows(2).all(|pair| pair[0].eta < pair[1].eta);
        if rising {
            pieces.extend((whole.nodes.len() > 1).then_some(whole));
            return;
        }
        for sign in [1.0, -1.0] {
            let turning = Turning { tool: self, x, sign };
            for mut cuts in intervals(&turning, ends.map(|end| end.t), NODES[0]) {
                for (cut, end) in cuts.iter_mut().zip(&ends) {
                    cut.limit = if cut.limit.is_none() { end.limit } else { None };
                }
                let mut piece = self.piece(x, cuts);
                if sign < 0.0 {
                    piece.nodes.reverse();
                    piece.bindings.reverse();
                }
                pieces.push(piece);
            }
        }
    }

    fn piece(&self, x: f64, [low, high]: [Cut; 2]) -> MonotonePiece {
        let nodes = self.nodes(x, [low.t, high.t]);
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let (mut folds, mut zetas, mut alphas) = (false, nothing, nothing);
        for node in &nodes {
            let (alpha, rate) = (node.values[ALPHA], node.slopes[ALPHA]);
            alphas = [alphas[0].min(alpha), alphas[1].max(alpha)];
            zetas = [zetas[0].min(node.zetas[0]), zetas[1].max(node.zetas[1])];
            folds |= node.zetas.iter().any(|zeta| 1.0 + rate * zeta < UPRIGHT);
        }
        let [alphas, zetas] = [alphas, zetas].map(with_room);
        let name = |cut: Cut| Some(self.domain.binding_at(Limit::ALL[cut.limit?], [x, cut.t]));
        MonotonePiece { nodes, alphas, zetas, bindings: [name(low), name(high)], folds }
    }

    /// Samples that are so dense that the cubics between them are precise half-way.
    fn nodes(&self, x: f64, [low, high]: [f64; 2]) -> Vec<HermiteNode> {
        let mut count = NODES[0];
        let node = |n: u32, of: u32| self.node([x, low + (high - low) * (f64::from(n) / f64::from(of))]);
        let mut all: Vec<HermiteNode> = (0..=2 * count).map(|n| node(n, 2 * count)).collect();
        loop {
            let nodes: Vec<HermiteNode> = all.iter().copied().step_by(2).collect();
            let precise = |[a, middle, b]: [&HermiteNode; 3]| {
                let fraction = a.fraction(b, middle.eta);
                let off = |n: usize| (a.cubic(b, fraction, n) - middle.values[n]).abs();
                let turned = off(ALPHA) * self.machine.mechanism.longest;
                off(0).max(off(1)).max(off(2)).max(turned) <= PRECISE
            };
            let enough = all.windows(3).step_by(2).all(|three| precise([&three[0], &three[1], &three[2]]));
            if enough || count >= NODES[1] {
                return nodes;
            }
            count *= 2;
            let between = (0..count).map(|n| node(2 * n + 1, 2 * count));
            let mut finer: Vec<HermiteNode> =
                all.iter().copied().zip(between).flat_map(|(a, b)| [a, b]).collect();
            finer.extend(all.last());
            all = finer;
        }
    }

    fn node(&self, at: [f64; 2]) -> HermiteNode {
        let column = self.domain.column(at);
        let rates = column.angle_rates(self.machine);
        let drops = column.drop_rates(self.machine, rates);
        let inverse = 1.0 / self.eta_rate(&column);
        let up = self.length * column.c - self.machine.table().da;
        let up_rate = -self.length * column.s * rates[1];
        let [f1, f2, f3] = column.f.map(|f| f + up);
        let [d1, d2, d3] = drops.map(|rate| (rate[1] + up_rate) * inverse);
        HermiteNode {
            eta: self.eta(&column),
            values: [f1, f2, f3, column.alpha()],
            slopes: [d1, d2, d3, rates[1] * inverse],
            zetas: self.domain.ends(&column).map(|z| z + up),
        }
    }

    #[inline]
    pub(super) fn eta(&self, column: &Column) -> f64 {
        column.y - self.length * column.s
    }

    /// d(eta)/dy.
    #[inline]
    pub(super) fn eta_rate(&self, column: &Column) -> f64 {
        let [_, rate] = column.angle_rates(self.machine);
        1.0 - self.length * column.c * rate
    }
}

fn with_room([low, high]: [f64; 2]) -> [f64; 2] {
    let room = ROOM * (high - low);
    [low - room, high + room]
}

/// The sign of d(eta)/dy along a line.
struct Turning<'a> {
    tool: &'a ToolWorkspace<'a>,
    x: f64,
    sign: f64,
}

impl LimitFunctions<1> for Turning<'_> {
    fn values(&self, y: f64) -> [f64; 1] {
        [self.value(0, y)]
    }

    fn value(&self, _: usize, y: f64) -> f64 {
        self.sign * self.tool.eta_rate(&self.tool.domain.column([self.x, y]))
    }
}

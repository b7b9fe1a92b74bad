//! The tool's workspace at constant x: a plane region between two graphs.
//!
//! The tool centre point U is measured from the table's tilting axis: eta = U_y and zeta = U_z - da, down.

use super::super::column::Column;
use super::super::domain::{Binding, Domain};
use super::super::path::{Cut, Limits, Path, intervals};
use super::super::request::{Kind, Request};
use super::DexterityRequest;
use super::floor::Floor;
use crate::clearance::Clearance;
use crate::machine::Machine;

/// Number of segments of a line x = const on which its intervals in the plane domain are searched.
const SEGMENTS: u32 = 53;
/// Number of samples along a piece, at first and at most.
const LOOKS: [u32; 2] = [64, 1_024];
/// Greatest error of the cubics between samples, mm; for alpha, times the machine's size.
const PRECISE: f64 = 1e-7;
/// Margin around the range of sampled values, as a fraction of it.
const ROOM: f64 = 0.1;
/// Jacobian determinant of the part's map below which a piece is examined for folds.
const UPRIGHT: f64 = 0.05;
/// An arbitrary tolerance: no surface is made here.
const NO_TOLERANCE: f64 = 1.0;

/// A machine with a tool, and its plane domain.
pub(super) struct Setting<'a> {
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

/// A part of the domain's line x = const on which eta is monotone in y.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// The samples, by ascending eta.
    looks: Vec<Look>,
    /// Least and greatest sampled alpha, with a margin for the values between the samples.
    pub(super) alphas: [f64; 2],
    /// Least and greatest sampled zeta, with the same margin.
    pub(super) zetas: [f64; 2],
    /// The constraints that end the domain at the least and the greatest eta.
    pub(super) bindings: [Option<Binding>; 2],
    /// Whether the part's map may fold.
    pub(super) folds: bool,
}

/// A sample of a piece.
#[derive(Clone, Copy, Debug)]
struct Look {
    eta: f64,
    values: Values,
    /// Their derivatives by eta.
    slopes: Values,
    /// zeta of the column's ends.
    zetas: [f64; 2],
}

/// zeta - rho of the three sliders, mm, and alpha.
pub(super) type Values = [f64; 4];
/// The index of alpha among them.
pub(super) const ALPHA: usize = 3;

impl<'a> Setting<'a> {
    pub(super) fn new(machine: &'a Machine, request: &DexterityRequest) -> Self {
        let DexterityRequest { tool_length, table_clearance, tool_radius, phi2, .. } = *request;
        let question = |kind| Request {
            kind,
            tool_length,
            phi1: 0.0,
            phi2,
            table_clearance: None,
            tool_radius: 0.0,
            tolerance: NO_TOLERANCE,
        };
        // The table's limits belong to the part's domain. Here they depend on more than a column.
        let part = Domain::new(machine, &question(Kind::Part), None);
        let domain = Domain::new(machine, &question(Kind::Tool), None);
        let clearance = Clearance::of(machine, table_clearance, tool_length, tool_radius);
        let floor = clearance.map(|clearance| Floor { machine, clearance });
        Self { machine, domain, length: tool_length, tilt: part.tilted(), empty: part.empty, floor }
    }

    /// The pieces at x, ascending in y.
    pub(super) fn section(&self, x: f64) -> Vec<Piece> {
        if self.empty {
            return Vec::new();
        }
        let [low, high] = self.domain.rectangle();
        let path = Path { domain: &self.domain, at: |y| [x, y] };
        let mut pieces = Vec::new();
        for ends in intervals(&path, [low[1], high[1]], SEGMENTS) {
            self.pieces(x, ends, &mut pieces);
        }
        pieces
    }

    /// An interval of y, cut where the tool's map folds.
    fn pieces(&self, x: f64, ends: [Cut; 2], pieces: &mut Vec<Piece>) {
        let whole = self.piece(x, ends);
        let rising = whole.looks.windows(2).all(|pair| pair[0].eta < pair[1].eta);
        if rising {
            pieces.extend((whole.looks.len() > 1).then_some(whole));
            return;
        }
        for sign in [1.0, -1.0] {
            let turning = Turning { setting: self, x, sign };
            for mut cuts in intervals(&turning, ends.map(|end| end.t), LOOKS[0]) {
                for (cut, end) in cuts.iter_mut().zip(&ends) {
                    cut.limit = if cut.limit.is_none() { end.limit } else { None };
                }
                let mut piece = self.piece(x, cuts);
                if sign < 0.0 {
                    piece.looks.reverse();
                    piece.bindings.reverse();
                }
                pieces.push(piece);
            }
        }
    }

    fn piece(&self, x: f64, [low, high]: [Cut; 2]) -> Piece {
        let looks = self.looks(x, [low.t, high.t]);
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let (mut folds, mut zetas, mut alphas) = (false, nothing, nothing);
        for look in &looks {
            let (alpha, rate) = (look.values[3], look.slopes[3]);
            alphas = [alphas[0].min(alpha), alphas[1].max(alpha)];
            zetas = [zetas[0].min(look.zetas[0]), zetas[1].max(look.zetas[1])];
            folds |= look.zetas.iter().any(|zeta| 1.0 + rate * zeta < UPRIGHT);
        }
        let [alphas, zetas] = [alphas, zetas].map(with_room);
        let limit = |cut: Cut| cut.limit.and_then(|limit| u8::try_from(limit).ok());
        let name = |cut: Cut| limit(cut).map(|limit| self.domain.binding_at(limit, [x, cut.t]));
        Piece { looks, alphas, zetas, bindings: [name(low), name(high)], folds }
    }

    /// Samples that are so dense that the cubics between them are precise half-way.
    fn looks(&self, x: f64, [low, high]: [f64; 2]) -> Vec<Look> {
        let mut count = LOOKS[0];
        let look = |n: u32, of: u32| self.look([x, low + (high - low) * (f64::from(n) / f64::from(of))]);
        let mut all: Vec<Look> = (0..=2 * count).map(|n| look(n, 2 * count)).collect();
        loop {
            let looks: Vec<Look> = all.iter().copied().step_by(2).collect();
            let precise = |[a, middle, b]: [&Look; 3]| {
                let part = a.part(b, middle.eta);
                let off = |n: usize| (a.cubic(b, part, n) - middle.values[n]).abs();
                let turned = off(3) * self.machine.mechanism.longest;
                off(0).max(off(1)).max(off(2)).max(turned) <= PRECISE
            };
            let enough = all.windows(3).step_by(2).all(|three| precise([&three[0], &three[1], &three[2]]));
            if enough || count >= LOOKS[1] {
                return looks;
            }
            count *= 2;
            let between = (0..count).map(|n| look(2 * n + 1, 2 * count));
            let mut finer: Vec<Look> = all.iter().copied().zip(between).flat_map(|(a, b)| [a, b]).collect();
            finer.extend(all.last());
            all = finer;
        }
    }

    fn look(&self, at: [f64; 2]) -> Look {
        let column = self.domain.column(at);
        let rates = column.angle_rates(self.machine);
        let drops = column.drop_rates(self.machine, rates);
        let inverse = 1.0 / self.eta_rate(&column);
        let up = self.length * column.c - self.machine.table().da;
        let up_rate = -self.length * column.s * rates[1];
        let [f1, f2, f3] = column.f.map(|f| f + up);
        let [d1, d2, d3] = drops.map(|rate| (rate[1] + up_rate) * inverse);
        Look {
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

impl Piece {
    /// Least and greatest eta.
    pub(super) fn range(&self) -> [f64; 2] {
        let end = |look: Option<&Look>| look.map_or(0.0, |look| look.eta);
        [end(self.looks.first()), end(self.looks.last())]
    }

    /// zeta - rho of the three sliders at eta, mm.
    #[inline]
    pub(super) fn drops(&self, eta: f64) -> [f64; 3] {
        let ([a, b], t) = self.around(eta);
        [0, 1, 2].map(|n| a.cubic(b, t, n))
    }

    /// One of the values at eta.
    #[inline]
    pub(super) fn value(&self, n: usize, eta: f64) -> f64 {
        let ([a, b], t) = self.around(eta);
        a.cubic(b, t, n)
    }

    /// d(alpha)/d(eta).
    pub(super) fn alpha_rate(&self, eta: f64) -> f64 {
        let ([a, b], t) = self.around(eta);
        let (width, rise) = (b.eta - a.eta, b.values[3] - a.values[3]);
        let (first, second) = (a.slopes[3], b.slopes[3]);
        (1.0 - t) * (1.0 - 3.0 * t) * first
            + t * (3.0 * t - 2.0) * second
            + 6.0 * t * (1.0 - t) * rise / width
    }

    /// The samples next to eta, and its fraction of the way between them.
    #[inline]
    fn around(&self, eta: f64) -> ([&Look; 2], f64) {
        let next = self.looks.partition_point(|look| look.eta <= eta).clamp(1, self.looks.len() - 1);
        let (a, b) = (&self.looks[next - 1], &self.looks[next]);
        ([a, b], a.part(b, eta))
    }

    /// eta, alpha and the ends' zetas at each sample.
    pub(super) fn outline(&self) -> impl Iterator<Item = (f64, f64, [f64; 2])> {
        self.looks.iter().map(|look| (look.eta, look.values[3], look.zetas))
    }
}

impl Look {
    /// The fraction of the way to the next sample at which eta lies.
    #[inline]
    fn part(&self, next: &Self, eta: f64) -> f64 {
        ((eta - self.eta) / (next.eta - self.eta)).clamp(0.0, 1.0)
    }

    /// The value of the cubic between two samples, at a fraction of the way.
    #[inline]
    fn cubic(&self, next: &Self, t: f64, n: usize) -> f64 {
        let (width, rest) = (next.eta - self.eta, 1.0 - t);
        let rise = next.values[n] - self.values[n];
        let (first, second) = (self.slopes[n] * width - rise, next.slopes[n] * width - rise);
        self.values[n] + t * (rise + rest * (rest * first - t * second))
    }
}

fn with_room([low, high]: [f64; 2]) -> [f64; 2] {
    let room = ROOM * (high - low);
    [low - room, high + room]
}

/// The sign of d(eta)/dy along a line.
struct Turning<'a> {
    setting: &'a Setting<'a>,
    x: f64,
    sign: f64,
}

impl Limits<1> for Turning<'_> {
    fn all(&self, y: f64) -> [f64; 1] {
        [self.one(0, y)]
    }

    fn one(&self, _: usize, y: f64) -> f64 {
        self.sign * self.setting.eta_rate(&self.setting.domain.column([self.x, y]))
    }
}

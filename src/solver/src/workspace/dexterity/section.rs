//! The tool's workspace at a fixed x: a plane region between two graphs.
//!
//! U is taken from the table's tilting axis: eta = U_y and zeta = U_z - da, down.

use super::super::column::Column;
use super::super::domain::{Binding, Domain};
use super::super::path::{Cut, Limits, Path, intervals};
use super::super::request::{Kind, Request};
use super::DexterityRequest;
use crate::machine::Machine;

/// Segments of a line x = const on which its part in the plane domain is looked for.
const SEGMENTS: u32 = 53;
/// Looks along a piece, from which eta is inverted.
const LOOKS: u32 = 16;
/// Newton steps of that inversion; two or three are usual.
const STEPS: usize = 30;
/// Precision of the inversion, relative to the machine.
const PRECISE: f64 = 1e-14;
/// Jacobian of the part's map below which a piece is looked at for folds.
const UPRIGHT: f64 = 0.05;
/// Any tolerance: a domain is not drawn here.
const NO_TOLERANCE: f64 = 1.0;

/// A machine with a tool, and its plane domain.
pub(super) struct Setting<'a> {
    pub(super) machine: &'a Machine,
    pub(super) domain: Domain<'a>,
    pub(super) length: f64,
    /// Middle and half of the tilting range; `None` if it is a whole turn.
    pub(super) tilt: Option<[f64; 2]>,
    /// The rotary angle is out of its range.
    pub(super) empty: bool,
}

/// A part of the domain's line x = const on which eta goes one way with y.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    x: f64,
    /// (eta, y), eta ascending.
    looks: Vec<[f64; 2]>,
    /// What ends the domain at the least and the greatest eta.
    pub(super) bindings: [Option<Binding>; 2],
    /// Whether the part's map may fold.
    pub(super) folds: bool,
}

impl<'a> Setting<'a> {
    pub(super) fn new(machine: &'a Machine, request: &DexterityRequest) -> Self {
        let DexterityRequest { tool_length, phi2, .. } = *request;
        let question = |kind| Request { kind, tool_length, phi1: 0.0, phi2, tolerance: NO_TOLERANCE };
        // The table's limits are those of the part's domain; here they depend on more than a column.
        let part = Domain::new(machine, &question(Kind::Part), None);
        let domain = Domain::new(machine, &question(Kind::Tool), None);
        Self { machine, domain, length: tool_length, tilt: part.tilted(), empty: part.empty }
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
        let rising = whole.looks.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        if rising {
            pieces.extend((whole.looks.len() > 1).then_some(whole));
            return;
        }
        for sign in [1.0, -1.0] {
            let turning = Turning { setting: self, x, sign };
            for mut cuts in intervals(&turning, ends.map(|end| end.t), LOOKS) {
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
        let step = (high.t - low.t) / f64::from(LOOKS);
        let mut folds = false;
        let looks = (0..=LOOKS)
            .map(|n| {
                let y = if n == LOOKS { high.t } else { low.t + step * f64::from(n) };
                let column = self.domain.column([x, y]);
                let [_, rate] = column.angle_rates(self.machine);
                let da = self.machine.table().da;
                folds |= self.domain.ends(&column).iter().any(|z| 1.0 + rate * (z - da) < UPRIGHT);
                [self.eta(&column), y]
            })
            .collect();
        let limit = |cut: Cut| cut.limit.and_then(|limit| u8::try_from(limit).ok());
        let name = |cut: Cut| limit(cut).map(|limit| self.domain.binding_at(limit, [x, cut.t]));
        Piece { x, looks, bindings: [name(low), name(high)], folds }
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

    /// z of the platform at a column for a tool at zeta.
    #[inline]
    pub(super) fn z(&self, column: &Column, zeta: f64) -> f64 {
        zeta + self.machine.table().da - self.length * column.c
    }

    /// zeta of the lower and the upper end of a column (z points down).
    pub(super) fn zetas(&self, column: &Column) -> [f64; 2] {
        self.domain.ends(column).map(|z| z - self.machine.table().da + self.length * column.c)
    }

    /// The column of a piece at which the tool is at eta: Newton's method within a bracket.
    #[inline]
    pub(super) fn column(&self, piece: &Piece, eta: f64) -> Column {
        let last = piece.looks.len() - 1;
        let next = piece.looks.partition_point(|look| look[0] <= eta).clamp(1, last);
        let [[from, a], [to, b]] = [piece.looks[next - 1], piece.looks[next]];
        let part = if to > from { ((eta - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let mut y = a + part * (b - a);
        let (mut low, mut high) = (a.min(b), a.max(b));
        let precise = PRECISE * self.machine.derived.scale;
        for _ in 0..STEPS {
            let column = self.domain.column([piece.x, y]);
            let off = self.eta(&column) - eta;
            if off.abs() <= precise || high - low <= precise {
                return column;
            }
            if (off > 0.0) == (b > a) {
                high = y
            } else {
                low = y
            }
            let next = y - off / self.eta_rate(&column);
            y = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        self.domain.column([piece.x, y])
    }
}

impl Piece {
    /// Least and greatest eta.
    pub(super) fn range(&self) -> [f64; 2] {
        let end = |look: Option<&[f64; 2]>| look.map_or(0.0, |look| look[0]);
        [end(self.looks.first()), end(self.looks.last())]
    }

    /// The places that have been looked at, in the plane.
    pub(super) fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.looks.iter().map(|look| [self.x, look[1]])
    }
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

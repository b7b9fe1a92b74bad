//! A triangle that is simple and flat enough, cut along the curves that cross it.
//!
//! First the limits cut, and the outside is discarded. Then the creases cut, and both sides stay. A new point on an
//! edge of the triangle follows from that edge alone, and the signs of all curves along the edge follow from its
//! ends. So the triangle on the other side is cut alike.

mod deliver;

use super::super::domain::{Domain, LIMITS};
use super::super::observer::{Observer, go_on};
use super::super::request::WorkspaceError;
use super::super::root;
use super::bend;
use super::patch::Patch;
use super::refine::Refinement;
use super::site::{CREASES, CURVES, FLOOR, Site, value};

/// Resolution of a point on an edge, as a fraction of the edge.
const RESOLUTION: f64 = 1e-12;

/// Difference of heights, in units of the machine, below which they are the same where two curves meet.
const SAME: f64 = 1e-9;

/// A polygon by the numbers of its sites, counter-clockwise.
pub(super) type Piece = Vec<usize>;

/// A triangle while it is cut.
pub(super) struct Leaf<'a> {
    pub(super) domain: &'a Domain<'a>,
    pub(super) tolerance: f64,
    pub(super) observer: &'a dyn Observer,
    pub(super) sites: Vec<Site>,
    pieces: Vec<Piece>,
    /// Sides that were divided: the two ends, in order, and the point between.
    divided: Vec<([usize; 2], usize)>,
}

impl<'a> Leaf<'a> {
    pub(super) fn new(refinement: &Refinement<'a>, corners: [&Site; 3]) -> Self {
        Self::with_points(refinement, corners, [const { Vec::new() }; 3])
    }

    /// A triangle with further points on its edges, in order.
    pub(super) fn with_points(
        refinement: &Refinement<'a>,
        corners: [&Site; 3],
        points: [Vec<Site>; 3],
    ) -> Self {
        let mut sites: Vec<Site> = corners.into_iter().cloned().collect();
        for (site, border) in sites.iter_mut().zip([0b101, 0b011, 0b110]) {
            site.border = border;
        }
        let mut piece = Piece::new();
        for (edge, points) in points.into_iter().enumerate() {
            piece.push(edge);
            for point in points {
                piece.push(sites.len());
                sites.push(Site { border: 1 << edge, ..point });
            }
        }
        let Refinement { domain, tolerance, observer, .. } = *refinement;
        Self { domain, tolerance, observer, sites, pieces: vec![piece], divided: Vec::new() }
    }

    /// Cuts the triangle and adds the result to the patch.
    pub(super) fn cut_into(mut self, patch: &mut Patch) -> Result<(), WorkspaceError> {
        go_on(self.observer)?;
        for limit in 0..LIMITS {
            self.cut(limit, false)?;
        }
        if self.pieces.is_empty() {
            return Ok(());
        }
        if self.domain.floored() {
            self.cut(FLOOR, true)?;
            self.cut(FLOOR + 1, true)?;
        }
        if !self.domain.flat() {
            for crease in [0, 2] {
                self.cut(CREASES + crease, true)?;
                self.cut(CREASES + crease + 1, true)?;
            }
        }
        self.deliver(patch)
    }

    fn cut(&mut self, curve: usize, keep: bool) -> Result<(), WorkspaceError> {
        // A sheet's creases end where the table begins to bind. The second one also ends at the first, where slider 1
        // begins to bind.
        let crease = (CREASES..FLOOR).contains(&curve).then(|| curve - CREASES);
        let before = [
            crease.map(|crease| FLOOR + crease / 2),
            crease.filter(|crease| crease % 2 == 1).map(|_| curve - 1),
        ];
        let mut pieces = Vec::with_capacity(self.pieces.len());
        for piece in std::mem::take(&mut self.pieces) {
            let piece = if keep { self.with_divisions(&piece) } else { piece };
            let elsewhere = before.into_iter().flatten().any(|other| self.side(other, &piece) >= 0.0);
            let negative = |site: &usize| self.sites[*site].values[curve] < 0.0;
            if elsewhere || !piece.iter().any(negative) {
                pieces.push(piece);
            } else if piece.iter().any(|&site| self.sites[site].values[curve] > 0.0) {
                self.divide(curve, &piece, keep, &mut pieces)?;
            } else if keep {
                pieces.push(piece);
            }
        }
        self.pieces = pieces;
        Ok(())
    }

    /// The sign of a curve's function on a piece that the curve does not cut.
    fn side(&self, curve: usize, piece: &[usize]) -> f64 {
        let values = piece.iter().map(|&site| self.sites[site].values[curve]);
        values.fold(0.0, |most: f64, value| if value.abs() > most.abs() { value } else { most })
    }

    /// Divides a piece along a curve that crosses it.
    fn divide(
        &mut self,
        curve: usize,
        piece: &[usize],
        keep: bool,
        pieces: &mut Vec<Piece>,
    ) -> Result<(), WorkspaceError> {
        let mut ring = Piece::with_capacity(piece.len() + 4);
        for (i, &a) in piece.iter().enumerate() {
            let b = piece[(i + 1) % piece.len()];
            ring.push(a);
            // The product of the values is not used, because it may underflow to zero.
            let [first, last] = [a, b].map(|site| self.sites[site].values[curve]);
            if first < 0.0 && last > 0.0 || first > 0.0 && last < 0.0 {
                ring.push(self.crossing(curve, a, b));
            }
        }
        let joined = self.joined(curve, &ring);
        let (inner, cut_off) = self.split(curve, &ring, joined)?;
        // The parts cut off are negative if the positive side is joined, and positive otherwise.
        if joined {
            pieces.extend(inner);
            if keep {
                pieces.extend(cut_off);
            }
        } else {
            pieces.extend(cut_off);
            if keep {
                pieces.extend(inner);
            }
        }
        Ok(())
    }

    /// Whether the positive parts of a ring are connected between several negative ones.
    fn joined(&self, curve: usize, ring: &[usize]) -> bool {
        let zeros: Vec<[f64; 2]> = ring
            .iter()
            .filter(|&&site| self.sites[site].values[curve] == 0.0)
            .map(|&site| self.sites[site].at())
            .collect();
        if zeros.len() <= 2 {
            return true;
        }
        let part = 1.0 / f64::from(u32::try_from(zeros.len()).unwrap_or(u32::MAX));
        let centre = [0, 1].map(|axis| zeros.iter().map(|zero| zero[axis]).sum::<f64>() * part);
        value(self.domain, curve, &self.domain.column(centre)) >= 0.0
    }

    /// Cuts off the runs of one sign: the negative ones if the positive side is `joined`. Returns the remainder, if
    /// it has an area, and the parts cut off.
    fn split(
        &mut self,
        curve: usize,
        ring: &[usize],
        joined: bool,
    ) -> Result<(Option<Piece>, Vec<Piece>), WorkspaceError> {
        let sign = if joined { -1.0 } else { 1.0 };
        let off = |leaf: &Self, site: usize| leaf.sites[site].values[curve] * sign > 0.0;
        let count = ring.len();
        let mut rest = Piece::with_capacity(count);
        let mut parts = Vec::new();
        // Begin where the ring is not cut off.
        let Some(start) = (0..count).find(|&i| !off(self, ring[i])) else {
            return Ok((None, vec![ring.to_vec()]));
        };
        let mut run = Piece::new();
        for step in 1..=count {
            let (before, site) = (ring[(start + step - 1) % count], ring[(start + step) % count]);
            if off(self, site) {
                if run.is_empty() {
                    run.push(before);
                }
                run.push(site);
                continue;
            }
            if !run.is_empty() {
                let from = run[0];
                run.push(site);
                if from == site {
                    // The curve only touches the ring here.
                    return Ok((None, vec![ring.to_vec()]));
                }
                let bent = bend::between(self, curve, from, site)?;
                rest.extend(&bent);
                run.extend(bent.iter().rev());
                parts.push(std::mem::take(&mut run));
            }
            rest.push(site);
        }
        let other = rest.iter().any(|&site| self.sites[site].values[curve] * sign < 0.0);
        let area = rest.len() >= 3 && (other || rest.iter().any(|site| !ring.contains(site)));
        Ok(if area { (Some(rest), parts) } else { (None, vec![ring.to_vec()]) })
    }

    /// The point at which a curve crosses a side.
    fn crossing(&mut self, curve: usize, a: usize, b: usize) -> usize {
        let (a, b) = if self.sites[b].precedes(&self.sites[a]) { (b, a) } else { (a, b) };
        if let Some((_, between)) = self.divided.iter().find(|(ends, _)| *ends == [a, b]) {
            return *between;
        }
        let (first, last) = (self.sites[a].clone(), self.sites[b].clone());
        let border = first.border & last.border;
        let along = first.on() & last.on();
        let site = if border == 0 && along != 0 {
            self.junction(curve, along.trailing_zeros() as usize, &first, &last)
        } else {
            self.on_segment(curve, &first, &last, border)
        };
        self.sites.push(site);
        self.divided.push(([a, b], self.sites.len() - 1));
        self.sites.len() - 1
    }

    fn on_segment(&self, curve: usize, a: &Site, b: &Site, border: u8) -> Site {
        let at = |part: f64| {
            let ([ax, ay], [bx, by]) = (a.at(), b.at());
            [ax + part * (bx - ax), ay + part * (by - ay)]
        };
        let part = root::zero(a.values[curve], b.values[curve], RESOLUTION, |part| {
            value(self.domain, curve, &self.domain.column(at(part)))
        });
        let mut site = Site::new(self.domain, at(part));
        if border != 0 {
            for other in 0..CURVES {
                site.values[other] = between(a.values[other], b.values[other], site.values[other]);
            }
        }
        site.values[curve] = 0.0;
        site.border = border;
        site
    }

    /// The point where two curves meet: a and b lie on `first`, and `curve` changes its sign between them.
    fn junction(&self, curve: usize, first: usize, a: &Site, b: &Site) -> Site {
        let drawn = |part: f64| bend::drawn(self.domain, first, [a.at(), b.at()], part);
        let part = root::zero(a.values[curve], b.values[curve], RESOLUTION, |part| {
            value(self.domain, curve, &self.domain.column(drawn(part)))
        });
        let mut site = Site::new(self.domain, drawn(part));
        // A crease of the common sheet ends where two limits of the strokes meet.
        for value in &mut site.values[CREASES..] {
            if value.abs() <= SAME * self.domain.machine.mechanism.longest {
                *value = 0.0;
            }
        }
        site.values[first] = 0.0;
        site.values[curve] = 0.0;
        site
    }

    /// A piece with the points that divide its neighbours' sides.
    fn with_divisions(&self, piece: &[usize]) -> Piece {
        let mut whole = Piece::with_capacity(piece.len());
        for (i, &a) in piece.iter().enumerate() {
            whole.push(a);
            self.side_divisions(a, piece[(i + 1) % piece.len()], &mut whole);
        }
        whole
    }

    fn side_divisions(&self, a: usize, b: usize, whole: &mut Piece) {
        let found = self.divided.iter().find(|(ends, _)| *ends == [a, b] || *ends == [b, a]);
        if let Some(&(_, between)) = found {
            self.side_divisions(a, between, whole);
            whole.push(between);
            self.side_divisions(between, b, whole);
        }
    }
}

/// A curve's value at a point of an edge, with the sign of the values at the edge's ends where they agree.
fn between(a: f64, b: f64, value: f64) -> f64 {
    if a == 0.0 && b == 0.0 {
        0.0
    } else if a >= 0.0 && b >= 0.0 {
        value.max(f64::MIN_POSITIVE)
    } else if a <= 0.0 && b <= 0.0 {
        value.min(-f64::MIN_POSITIVE)
    } else {
        value
    }
}

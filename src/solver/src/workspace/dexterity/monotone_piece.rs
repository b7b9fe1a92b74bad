//! One interval of a section: alpha and the sliders' distances as functions of eta.

use crate::workspace::domain::Binding;

/// An interval of the domain's line x = const on which eta is monotone in y.
#[derive(Clone, Debug)]
pub(super) struct MonotonePiece {
    /// The samples, by ascending eta.
    pub(super) nodes: Vec<HermiteNode>,
    /// Least and greatest sampled alpha, with a margin for the values between the samples.
    pub(super) alphas: [f64; 2],
    /// Least and greatest sampled zeta, with the same margin.
    pub(super) zetas: [f64; 2],
    /// The constraints that end the domain at the least and the greatest eta.
    pub(super) bindings: [Option<Binding>; 2],
    /// Whether the part's map may fold.
    pub(super) folds: bool,
}

/// A sample: a node of the cubic Hermite interpolants.
#[derive(Clone, Copy, Debug)]
pub(super) struct HermiteNode {
    pub(super) eta: f64,
    pub(super) values: Values,
    /// Their derivatives by eta.
    pub(super) slopes: Values,
    /// zeta of the column's ends.
    pub(super) zetas: [f64; 2],
}

/// zeta - rho of the three sliders, mm, and alpha.
pub(super) type Values = [f64; 4];
/// The index of alpha among them.
pub(super) const ALPHA: usize = 3;

impl MonotonePiece {
    /// Least and greatest eta.
    pub(super) fn range(&self) -> [f64; 2] {
        let end = |node: Option<&HermiteNode>| node.map_or(0.0, |node| node.eta);
        [end(self.nodes.first()), end(self.nodes.last())]
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
        let (width, rise) = (b.eta - a.eta, b.values[ALPHA] - a.values[ALPHA]);
        let (first, second) = (a.slopes[ALPHA], b.slopes[ALPHA]);
        (1.0 - t) * (1.0 - 3.0 * t) * first
            + t * (3.0 * t - 2.0) * second
            + 6.0 * t * (1.0 - t) * rise / width
    }

    /// The samples next to eta, and its fraction of the way between them.
    #[inline]
    fn around(&self, eta: f64) -> ([&HermiteNode; 2], f64) {
        let next = self.nodes.partition_point(|node| node.eta <= eta).clamp(1, self.nodes.len() - 1);
        let (a, b) = (&self.nodes[next - 1], &self.nodes[next]);
        ([a, b], a.fraction(b, eta))
    }

    /// eta, alpha and the ends' zetas at each sample.
    pub(super) fn outline(&self) -> impl Iterator<Item = (f64, f64, [f64; 2])> {
        self.nodes.iter().map(|node| (node.eta, node.values[ALPHA], node.zetas))
    }
}

impl HermiteNode {
    /// The fraction of the way to the next sample at which eta lies.
    #[inline]
    pub(super) fn fraction(&self, next: &Self, eta: f64) -> f64 {
        ((eta - self.eta) / (next.eta - self.eta)).clamp(0.0, 1.0)
    }

    /// The value of the cubic between two samples, at a fraction of the way.
    #[inline]
    pub(super) fn cubic(&self, next: &Self, t: f64, n: usize) -> f64 {
        let (width, rest) = (next.eta - self.eta, 1.0 - t);
        let rise = next.values[n] - self.values[n];
        let (first, second) = (self.slopes[n] * width - rise, next.slopes[n] * width - rise);
        self.values[n] + t * (rise + rest * (rest * first - t * second))
    }
}

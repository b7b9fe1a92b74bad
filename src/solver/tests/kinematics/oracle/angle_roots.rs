//! Real zeros of a continuous function of an angle, by scanning.

use std::f64::consts::{PI, TAU};

/// How many nodes a scan starts with.
const NODES: u32 = 400;
/// How often a suspicious interval between two nodes is halved.
const HALVINGS: u32 = 5;
/// A dip to this fraction of the function's largest value, without reaching zero, is a touch.
const TOUCH: f64 = 1e-10;
/// Step of the numerical slope.
const STEP: f64 = 1e-7;

/// Zeros of a function with period 2π.
#[derive(Default)]
pub(crate) struct Zeros {
    /// Angles at which the function changes sign, in ascending order.
    pub(crate) crossings: Vec<f64>,
    /// Angles at which the function comes close to zero without changing sign.
    pub(crate) touches: Vec<f64>,
    /// It vanishes everywhere, as closely as double precision can tell.
    pub(crate) vanishes: bool,
}

#[derive(Clone, Copy)]
struct Node {
    t: f64,
    value: f64,
    slope: f64,
}

struct Scan<F> {
    f: F,
    largest: f64,
    zeros: Zeros,
}

/// Finds the zeros of `f`, whose values are of the order of one, on `[-π, π)`.
pub(crate) fn zeros(f: impl Fn(f64) -> f64) -> Zeros {
    let mut scan = Scan { f, largest: 0.0, zeros: Zeros::default() };
    // Not at round angles, because symmetric cases have their zeros there.
    let nodes: Vec<Node> =
        (0..NODES).map(|i| scan.node(-PI + TAU * (f64::from(i) + 0.377) / f64::from(NODES))).collect();
    scan.largest = nodes.iter().map(|n| n.value.abs()).fold(0.0, f64::max);
    if scan.largest < 1e-14 {
        return Zeros { vanishes: true, ..Zeros::default() };
    }
    for pair in nodes.windows(2) {
        scan.interval(pair[0], pair[1], HALVINGS);
    }
    let (last, first) = (nodes[nodes.len() - 1], nodes[0]);
    scan.interval(last, Node { t: first.t + TAU, ..first }, HALVINGS);
    let mut zeros = scan.zeros;
    zeros.crossings.sort_by(f64::total_cmp);
    zeros
}

impl<F: Fn(f64) -> f64> Scan<F> {
    fn node(&self, t: f64) -> Node {
        let slope = ((self.f)(t + STEP) - (self.f)(t - STEP)) / (2.0 * STEP);
        Node { t, value: (self.f)(t), slope }
    }

    fn positive(value: f64) -> bool {
        value >= 0.0
    }

    /// Finds the zeros between two nodes: one where the sign changes and the slopes agree, a pair
    /// where the function dips towards zero and comes back; what is neither is halved.
    fn interval(&mut self, a: Node, b: Node, halvings: u32) {
        let up = if Self::positive(a.value) { 1.0 } else { -1.0 };
        let crosses = Self::positive(a.value) != Self::positive(b.value);
        let plain = if crosses {
            up * a.slope <= 0.0 && up * b.slope <= 0.0
        } else {
            up * a.slope >= 0.0 || up * b.slope <= 0.0
        };
        if crosses && (plain || halvings == 0) {
            self.bisect(a.t, b.t);
        } else if crosses {
            let middle = self.node(f64::midpoint(a.t, b.t));
            self.interval(a, middle, halvings - 1);
            self.interval(middle, b, halvings - 1);
        } else if !plain {
            self.dip(a.t, b.t, up);
        }
    }

    fn bisect(&mut self, mut low: f64, mut high: f64) {
        let side = Self::positive((self.f)(low));
        loop {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                self.zeros.crossings.push(middle);
                return;
            }
            if Self::positive((self.f)(middle)) == side {
                low = middle;
            } else {
                high = middle;
            }
        }
    }

    /// Golden-section search for the least value of `up * f`.
    fn dip(&mut self, start: f64, end: f64, up: f64) {
        let ratio = (5_f64.sqrt() - 1.0) / 2.0;
        let (mut low, mut high) = (start, end);
        let mut least = (f64::INFINITY, low);
        for _ in 0..60 {
            let (c, d) = (high - ratio * (high - low), low + ratio * (high - low));
            let (fc, fd) = (up * (self.f)(c), up * (self.f)(d));
            least = if fc < least.0 { (fc, c) } else { least };
            least = if fd < least.0 { (fd, d) } else { least };
            if least.0 < 0.0 {
                self.bisect(start, least.1);
                self.bisect(least.1, end);
                return;
            }
            if fc < fd { high = d } else { low = c }
        }
        if least.0 < TOUCH * self.largest {
            self.zeros.touches.push(least.1);
        }
    }
}

/// A closed curve of pairs (angle, ± root of a discriminant), run through by a parameter of
/// period 2π.
#[derive(Clone, Copy)]
pub(crate) enum Curve {
    /// The discriminant is positive everywhere: one sign of its root, all around.
    Sheet(f64),
    /// The discriminant is positive between two zeros: there with one sign, back with the other.
    Arc { middle: f64, half: f64 },
}

impl Curve {
    /// The angle and the sign of the root.
    pub(crate) fn at(self, t: f64) -> (f64, f64) {
        match self {
            Self::Sheet(sign) => (t, sign),
            Self::Arc { middle, half } => (middle - half * t.cos(), if t.sin() < 0.0 { -1.0 } else { 1.0 }),
        }
    }
}

/// The closed curves over the angles where the discriminant is positive, and the angles where it
/// hardly reaches zero from below.
pub(crate) fn curves(discriminant: impl Fn(f64) -> f64) -> (Vec<Curve>, Vec<f64>) {
    let ends = zeros(&discriminant);
    let grazes = ends.touches.into_iter().filter(|&a| discriminant(a) < 0.0).collect();
    if ends.crossings.is_empty() {
        let sheets =
            if discriminant(0.1) > 0.0 { vec![Curve::Sheet(1.0), Curve::Sheet(-1.0)] } else { vec![] };
        return (sheets, grazes);
    }
    let next = ends.crossings.iter().skip(1).copied().chain([ends.crossings[0] + TAU]);
    let arcs = ends.crossings.iter().zip(next).filter_map(|(&start, end)| {
        let middle = f64::midpoint(start, end);
        (discriminant(middle) > 0.0).then_some(Curve::Arc { middle, half: (end - start) / 2.0 })
    });
    (arcs.collect(), grazes)
}

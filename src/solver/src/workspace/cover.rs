//! Boxes that cover the plane domain: outside, inside, or crossed by known limits.
//!
//! The rectangle that the legs reach is halved again and again. Bounds of every limit over a box
//! prove it outside, prove it inside, or leave the limits that may vanish there. A box is `simple`
//! if each of these rises or falls all along y: then every line x = const crosses the domain in at
//! most one interval there. It is `open` if all of them rise in one common direction: then from
//! every point of the domain one stays in it in that direction as far as the box's end, and no
//! piece of the domain, and no hole, lies hidden inside.

mod interval;
mod ranges;
mod separation;
#[cfg(test)]
mod tests;

use super::domain::{Domain, INTERFERENCE, LIMITS, STROKES};
use super::observer::{Observer, Pace};
use super::request::WorkspaceError;
use ranges::Ranges;

/// Boxes looked at before the rest is left undecided.
const BUDGET: usize = 60_000;
/// Greatest part of the domain's area that may be left undecided.
const UNDECIDED: f64 = 1e-8;
/// Boxes along the domain at least, where only its pieces are looked for.
const ALONG: f64 = 16.0;
/// Room for rounding in a bound, in units of the limit.
const ROUNDING: f64 = 1e-11;
/// Least side of a box, in units of the machine.
const SMALLEST: f64 = 1e-13;
/// Directions in which all limits may rise together.
const DIRECTIONS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
/// First of the limits that are not leg I's.
const OTHERS: usize = 4;

/// Least and greatest x and y.
pub(super) type Rectangle = [[f64; 2]; 2];

/// What the boxes are for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Purpose {
    /// Integration over lines x = const: wherever a line's structure may change, the boxes are so
    /// small that their area can be neglected, or given as an error.
    Lines,
    /// No piece and no hole of the domain that is wider than this is hidden in a box.
    Pieces(f64),
}

/// What is known of a box.
#[derive(Clone, Copy, Debug)]
pub(super) enum State {
    /// Some limit is not kept anywhere.
    Outside,
    /// Every limit is kept everywhere.
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
    /// Size down to which pieces of the domain may be hidden around here.
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
    pub(super) fn of(
        domain: &Domain<'_>,
        purpose: Purpose,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        let mut cover = Self { nodes: Vec::new(), roots: Vec::new() };
        let Some([[x0, y0], [x1, y1]]) = parallelograms_apart(domain) else { return Ok(cover) };
        if domain.empty {
            return Ok(cover);
        }
        let mut pace = Pace::new(observer);
        let mut search = Search { domain, purpose, settled: 0.0, looked: 0, nodes: Vec::new() };
        let mut pending = Vec::new();
        for place in [[[x0, y0], [x1, 0.0]], [[x0, 0.0], [x1, y1]]] {
            cover.roots.push(search.nodes.len());
            pending.extend(search.look(place, all_limits(domain), f64::INFINITY));
        }
        while search.goes_on(&pending) {
            let mut next = Vec::with_capacity(2 * pending.len());
            let reach = search.reach();
            for task in std::mem::take(&mut pending) {
                pace.step()?;
                if !search.is_due(&task, reach) {
                    continue;
                }
                let halves = halves(search.nodes[task.node].place);
                search.nodes[task.node].halves = Some(search.nodes.len());
                for half in halves {
                    next.extend(search.look(half, task.limits, task.grain));
                }
            }
            pending = next;
        }
        cover.nodes = search.nodes;
        Ok(cover)
    }

    /// The boxes that are not outside.
    pub(super) fn leaves(&self) -> impl Iterator<Item = Leaf> {
        let leaf = |node: &Node| Leaf { place: node.place, state: node.state, weight: node.weight };
        self.nodes.iter().filter(|node| node.halves.is_none() && !node.is_outside()).map(leaf)
    }

    /// Whether some box that is inside is at least so wide.
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

    /// The least size, among the boxes that a segment crosses, down to which something may be
    /// hidden from it: a piece of the domain if it is `outside`, else a hole or a limit.
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

/// A box that may be halved.
struct Task {
    node: usize,
    limits: u32,
    grain: f64,
    size: f64,
    open: bool,
    event: bool,
}

struct Search<'a> {
    domain: &'a Domain<'a>,
    purpose: Purpose,
    /// Area of the boxes that are inside, and half of that of those that one limit crosses.
    settled: f64,
    looked: usize,
    nodes: Vec<Node>,
}

impl Search<'_> {
    fn goes_on(&self, pending: &[Task]) -> bool {
        let area: f64 =
            pending.iter().filter(|task| task.event).map(|task| area(&self.nodes[task.node].place)).sum();
        let enough = match self.purpose {
            Purpose::Lines => area <= UNDECIDED * self.settled,
            Purpose::Pieces(_) => false,
        };
        !pending.is_empty() && !enough && self.looked < BUDGET
    }

    fn is_due(&self, task: &Task, reach: f64) -> bool {
        let least = SMALLEST * self.domain.machine.derived.scale;
        task.size > least
            && match self.purpose {
                Purpose::Lines => task.event,
                Purpose::Pieces(width) => !task.open && task.size > width || task.size > reach / ALONG,
            }
    }

    /// The longer side of what may hold the domain.
    fn reach(&self) -> f64 {
        match self.purpose {
            Purpose::Lines => 0.0,
            Purpose::Pieces(_) => bounds(self.nodes.iter()).map_or(0.0, |place| longest(&place)),
        }
    }

    /// Looks at a box; what is to be done if it is not decided. `limits` may vanish in the box it is
    /// a half of, and `grain` is that box's.
    fn look(&mut self, place: Rectangle, limits: u32, grain: f64) -> Option<Task> {
        self.looked += 1;
        let found = judged(self.domain, place, limits);
        let size = longest(&place);
        let (state, open, weight) = match found {
            Judgement::Outside => (State::Outside, true, 0.0),
            Judgement::Inside => (State::Inside, true, 0.0),
            Judgement::Crossed { limits, simple, smooth, open, weight } => {
                let event = !simple || !smooth || limits.count_ones() > 1;
                (State::Crossed { limits, simple, event }, open, weight)
            }
        };
        let node = self.nodes.len();
        // What is not hidden in an open box is not hidden in a part of it.
        let grain = if grain.is_finite() { grain } else { size };
        self.nodes.push(Node { place, state, halves: None, grain, weight });
        match state {
            State::Outside => None,
            State::Inside => {
                self.settled += area(&place);
                None
            }
            State::Crossed { limits, event, .. } => {
                if !event {
                    self.settled += 0.5 * area(&place);
                }
                Some(Task {
                    node,
                    limits,
                    grain: if open { grain } else { f64::INFINITY },
                    size,
                    open,
                    event,
                })
            }
        }
    }
}

enum Judgement {
    Outside,
    Inside,
    Crossed { limits: u32, simple: bool, smooth: bool, open: bool, weight: f64 },
}

/// What the bounds of the limits tell of a box.
fn judged(domain: &Domain<'_>, place: Rectangle, pending: u32) -> Judgement {
    let Some(ranges) = Ranges::over(domain, place) else { return Judgement::Outside };
    let (mut left, mut simple, mut smooth, mut open) = (0, true, true, [true; DIRECTIONS.len()]);
    if !ranges.first {
        // Leg I's limits that hold together at X1 = y = 0 cease to hold, the further away, with the
        // one on its rod that is the less steep: where the rods cross, w1 is 0.
        let side = if ranges.side > 0.0 { 2 } else { 3 };
        left |= 1 << side;
        for (open, [x, y]) in open.iter_mut().zip(DIRECTIONS) {
            let inwards = f64::from(ranges.beside());
            *open = y * ranges.side < 0.0 && (x == 0.0 || x * inwards < 0.0);
        }
    }
    for limit in (OTHERS..LIMITS).filter(|limit| pending & (1 << limit) != 0) {
        let (jet, kinked) = ranges.limit(limit);
        let room = ROUNDING * unit(domain, limit);
        if jet.value.high < -room {
            return Judgement::Outside;
        }
        if jet.value.low > room {
            continue;
        }
        left |= 1 << limit;
        smooth &= !kinked;
        // u falls with |y|: leg I's rods come nearer.
        simple &= jet.slopes[1].sign() != 0 || limit == INTERFERENCE;
        for (open, [x, y]) in open.iter_mut().zip(DIRECTIONS) {
            *open &= (jet.slopes[0].times(x) + jet.slopes[1].times(y)).low > 0.0;
        }
    }
    if left == 0 {
        return Judgement::Inside;
    }
    Judgement::Crossed { limits: left, simple, smooth, open: open.contains(&true), weight: ranges.weight() }
}

/// The size of a limit's values.
fn unit(domain: &Domain<'_>, limit: usize) -> f64 {
    let scale = domain.machine.derived.scale;
    match limit {
        4 | 5 => scale * scale,
        INTERFERENCE..STROKES => scale,
        STROKES.. if limit < super::domain::TILT => scale,
        _ => 1.0,
    }
}

/// Every limit that can be broken. Leg I's two rods and those of different legs are never nearer
/// than nothing.
fn all_limits(domain: &Domain<'_>) -> u32 {
    let all = (1 << LIMITS) - 1;
    let parallelogram = 1 << (INTERFERENCE + 1);
    let rods = if domain.machine.geometry().rod_radius > 0.0 { 0 } else { 0b111 << INTERFERENCE };
    all & !(1 | parallelogram | rods)
}

/// The rectangle that the legs reach, as far as a parallelogram's rods keep apart: their distance
/// depends on x alone and falls with |x + e2|.
fn parallelograms_apart(domain: &Domain<'_>) -> Option<Rectangle> {
    let (g, d) = (domain.machine.geometry(), &domain.machine.derived);
    let (width, least) = (2.0 * g.parallelogram_half_width, 2.0 * g.rod_radius);
    if width < least {
        return None;
    }
    let across = |length: f64| {
        let aligned = (1.0 - (least / width).powi(2)).sqrt();
        let beside = (width * width + length * length - least * least) / (2.0 * width * length);
        length * if aligned * width <= length { aligned } else { beside.min(1.0) }
    };
    let most = across(g.L2).min(across(g.L3));
    let [[x0, y0], [x1, y1]] = domain.rectangle();
    let (x0, x1) = (x0.max(-d.e2 - most), x1.min(most - d.e2));
    (x0 < x1).then_some([[x0, y0], [x1, y1]])
}

fn bounds<'a>(nodes: impl Iterator<Item = &'a Node>) -> Option<Rectangle> {
    nodes.filter(|node| node.halves.is_none() && !node.is_outside()).map(|node| node.place).reduce(|a, b| {
        [[a[0][0].min(b[0][0]), a[0][1].min(b[0][1])], [a[1][0].max(b[1][0]), a[1][1].max(b[1][1])]]
    })
}

fn halves([low, high]: Rectangle) -> [Rectangle; 2] {
    let axis = usize::from(high[1] - low[1] > high[0] - low[0]);
    let middle = 0.5 * (low[axis] + high[axis]);
    let (mut first, mut second) = ([low, high], [low, high]);
    first[1][axis] = middle;
    second[0][axis] = middle;
    [first, second]
}

fn longest([low, high]: &Rectangle) -> f64 {
    (high[0] - low[0]).max(high[1] - low[1])
}

fn area([low, high]: &Rectangle) -> f64 {
    (high[0] - low[0]) * (high[1] - low[1])
}

/// Whether a segment meets a rectangle.
fn meets([low, high]: &Rectangle, [a, b]: [[f64; 2]; 2]) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let step = b[axis] - a[axis];
        if step == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return false;
            }
        } else {
            let (s, t) = ((low[axis] - a[axis]) / step, (high[axis] - a[axis]) / step);
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        }
    }
    from <= to
}

//! The search for the boxes. It halves those that are not decided.

use super::super::domain::Domain;
use super::super::observer::{Observer, go_on};
use super::super::request::WorkspaceError;
use super::judgement::{Judgement, all_limits, judged, parallelograms_apart};
use super::rectangle::{Rectangle, area, halves, longest};
use super::{Cover, Node, Purpose, State, bounds};

/// Boxes that are examined before the rest is left undecided.
const BUDGET: usize = 60_000;
/// Greatest fraction of the domain's area that may be left undecided.
const UNDECIDED: f64 = 1e-8;
/// Least number of boxes along the domain, if only its pieces matter.
const ALONG: f64 = 16.0;
/// Least side of a box, in units of the machine.
const SMALLEST: f64 = 1e-13;

impl Cover {
    pub(in super::super) fn of(
        domain: &Domain<'_>,
        purpose: Purpose,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        let mut cover = Self { nodes: Vec::new(), roots: Vec::new() };
        let Some([[x0, y0], [x1, y1]]) = parallelograms_apart(domain) else { return Ok(cover) };
        if domain.empty {
            return Ok(cover);
        }
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
                go_on(observer)?;
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
    /// Area of the inside boxes, and half the area of those that one limit crosses.
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
        let least = SMALLEST * self.domain.machine.mechanism.longest;
        task.size > least
            && match self.purpose {
                Purpose::Lines => task.event,
                Purpose::Pieces(width) => !task.open && task.size > width || task.size > reach / ALONG,
            }
    }

    /// The longer side of the rectangle that may contain the domain.
    fn reach(&self) -> f64 {
        match self.purpose {
            Purpose::Lines => 0.0,
            Purpose::Pieces(_) => bounds(self.nodes.iter()).map_or(0.0, |place| longest(&place)),
        }
    }

    /// Examines a box. If it is not decided, the function returns the task of halving it. `limits` are those that may
    /// vanish in the box of which it is a half, and `grain` is that box's.
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
        // Nothing is hidden in a part of an open box.
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

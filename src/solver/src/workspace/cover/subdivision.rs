//! The subdivision into boxes. It halves those that are not decided.

use super::classification::{Class, all_limits, classify, parallelograms_apart};
use super::rectangle::{Rectangle, area, halves, longest};
use super::{Cover, Node, Purpose, State, bounds};
use crate::workspace::domain::{Domain, LimitSet};
use crate::workspace::observer::{Observer, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// Boxes that are examined before the rest is left undecided.
const BUDGET: usize = 60_000;
/// Greatest fraction of the domain's area that may be left undecided.
const UNDECIDED: f64 = 1e-8;
/// Least number of boxes along the domain, if only its components matter.
const ALONG: f64 = 16.0;
/// Least side of a box, in units of the machine.
const SMALLEST: f64 = 1e-13;

impl Cover {
    pub(in crate::workspace) fn of(
        domain: &Domain<'_>,
        purpose: Purpose,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        let mut cover = Self { nodes: Vec::new(), roots: Vec::new() };
        let Some([[x0, y0], [x1, y1]]) = parallelograms_apart(domain) else { return Ok(cover) };
        if domain.empty {
            return Ok(cover);
        }
        let mut subdivision = Subdivision { domain, purpose, settled: 0.0, examined: 0, nodes: Vec::new() };
        let mut pending = Vec::new();
        for rectangle in [[[x0, y0], [x1, 0.0]], [[x0, 0.0], [x1, y1]]] {
            cover.roots.push(subdivision.nodes.len());
            pending.extend(subdivision.examine(rectangle, all_limits(domain), f64::INFINITY));
        }
        while subdivision.goes_on(&pending) {
            let mut next = Vec::with_capacity(2 * pending.len());
            let reach = subdivision.reach();
            for candidate in std::mem::take(&mut pending) {
                check_cancelled(observer)?;
                if !subdivision.is_due(&candidate, reach) {
                    continue;
                }
                let halves = halves(subdivision.nodes[candidate.node].rectangle);
                subdivision.nodes[candidate.node].halves = Some(subdivision.nodes.len());
                for half in halves {
                    next.extend(subdivision.examine(half, candidate.limits, candidate.hidden_size));
                }
            }
            pending = next;
        }
        cover.nodes = subdivision.nodes;
        Ok(cover)
    }
}

/// A box that may be halved.
struct PendingBox {
    node: usize,
    limits: LimitSet,
    hidden_size: f64,
    size: f64,
    open: bool,
    event: bool,
}

struct Subdivision<'a> {
    domain: &'a Domain<'a>,
    purpose: Purpose,
    /// Area of the inside boxes, and half the area of those that one limit crosses.
    settled: f64,
    examined: usize,
    nodes: Vec<Node>,
}

impl Subdivision<'_> {
    fn goes_on(&self, pending: &[PendingBox]) -> bool {
        let area: f64 = pending
            .iter()
            .filter(|candidate| candidate.event)
            .map(|candidate| area(&self.nodes[candidate.node].rectangle))
            .sum();
        let enough = match self.purpose {
            Purpose::Integration => area <= UNDECIDED * self.settled,
            Purpose::Meshing(_) => false,
        };
        !pending.is_empty() && !enough && self.examined < BUDGET
    }

    fn is_due(&self, candidate: &PendingBox, reach: f64) -> bool {
        let least = SMALLEST * self.domain.machine.mechanism.longest;
        candidate.size > least
            && match self.purpose {
                Purpose::Integration => candidate.event,
                Purpose::Meshing(width) => {
                    !candidate.open && candidate.size > width || candidate.size > reach / ALONG
                }
            }
    }

    /// The longer side of the rectangle that may contain the domain.
    fn reach(&self) -> f64 {
        match self.purpose {
            Purpose::Integration => 0.0,
            Purpose::Meshing(_) => bounds(self.nodes.iter()).map_or(0.0, |rectangle| longest(&rectangle)),
        }
    }

    /// Examines a box. If it is not decided, the function returns a candidate for halving. `limits` are those that may
    /// vanish in the box of which it is a half, and `hidden_size` is that box's.
    fn examine(&mut self, rectangle: Rectangle, limits: LimitSet, hidden_size: f64) -> Option<PendingBox> {
        self.examined += 1;
        let found = classify(self.domain, rectangle, limits);
        let size = longest(&rectangle);
        let (state, open, weight) = match found {
            Class::Outside => (State::Outside, true, 0.0),
            Class::Inside => (State::Inside, true, 0.0),
            Class::Crossed { limits, simple, smooth, open, weight } => {
                let event = !simple || !smooth || limits.count_ones() > 1;
                (State::Crossed { limits, simple, event }, open, weight)
            }
        };
        let node = self.nodes.len();
        // Nothing is hidden in a half of an open box.
        let hidden_size = if hidden_size.is_finite() { hidden_size } else { size };
        self.nodes.push(Node { rectangle, state, halves: None, hidden_size, weight });
        match state {
            State::Outside => None,
            State::Inside => {
                self.settled += area(&rectangle);
                None
            }
            State::Crossed { limits, event, .. } => {
                if !event {
                    self.settled += 0.5 * area(&rectangle);
                }
                Some(PendingBox {
                    node,
                    limits,
                    hidden_size: if open { hidden_size } else { f64::INFINITY },
                    size,
                    open,
                    event,
                })
            }
        }
    }
}

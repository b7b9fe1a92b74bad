//! What a plan says about its set-up, so that set-ups compare.

use super::criteria::Criteria;
use crate::machine::Machine;
use crate::toolpath::report::Report;

/// What a plan says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Verdict {
    /// The least ratio of a margin to its reserve; `None` if a place is out of reach, or without such a margin.
    pub(super) t: Option<f64>,
    /// How much the worst margin without a reserve is beyond its limit, as a fraction of its range; at least zero.
    pub(super) missing: f64,
    /// Number of stretches that the machine does not reach.
    unreached: usize,
}

impl Verdict {
    pub(super) fn of(machine: &Machine, report: &Report, criteria: &Criteria) -> Self {
        let unreached = report.failures.iter().filter(|failure| failure.joints.is_none()).count();
        let (mut t, mut missing): (Option<f64>, f64) = (None, 0.0);
        for least in &report.least {
            match criteria.reserve(least.margin.constraint) {
                Some(reserve) => {
                    let ratio = least.margin.value / reserve;
                    t = Some(t.map_or(ratio, |t| t.min(ratio)));
                }
                None => missing = missing.max(-least.margin.fraction(machine)),
            }
        }
        Self { t: t.filter(|_| unreached == 0 && report.rows > 0), missing, unreached }
    }

    /// Whether every place is reached, and no margin without a reserve is beyond its limit.
    pub(super) fn is_feasible(&self) -> bool {
        self.unreached == 0 && self.missing <= 0.0
    }

    /// Whether it is better: first fewer stretches out of reach, then the other limits, then the reserve.
    pub(super) fn is_better_than(&self, other: &Self) -> bool {
        let t = |verdict: &Self| verdict.t.unwrap_or(f64::NEG_INFINITY);
        let order = other.unreached.cmp(&self.unreached).then(other.missing.total_cmp(&self.missing));
        order.then(t(self).total_cmp(&t(other))).is_gt()
    }

    /// By how much t is greater, if only t differs; without end for any other improvement.
    pub(super) fn gain_over(&self, other: &Self) -> f64 {
        if !self.is_better_than(other) {
            return 0.0;
        }
        match (self.t, other.t) {
            (Some(now), Some(before)) if self.is_feasible() && other.is_feasible() => now - before,
            _ => f64::INFINITY,
        }
    }
}

//! Observers of the solver's computations, made of others.

use verne_solver::workspace::Observer;

/// An observer made of two functions: one takes the progress, the other says whether to stop.
pub(crate) struct ObserverFns<P, C> {
    /// Takes the fraction of the work that is done, 0 to 1.
    pub progress: P,
    /// Whether the computation is to stop.
    pub cancelled: C,
}

impl<P: Fn(f64) + Sync, C: Fn() -> bool + Sync> Observer for ObserverFns<P, C> {
    fn progress(&self, fraction: f64) {
        (self.progress)(fraction);
    }

    fn cancelled(&self) -> bool {
        (self.cancelled)()
    }
}

/// The observer of one of several computations: its progress runs from `start` to `end` of the whole.
pub(crate) fn section(observer: &dyn Observer, start: f64, end: f64) -> impl Observer {
    ObserverFns {
        progress: move |fraction| observer.progress(start + fraction * (end - start)),
        cancelled: || observer.cancelled(),
    }
}

/// The observer of computation `i` of `count` computations of about the same length.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(crate) fn equal_section(observer: &dyn Observer, i: usize, count: usize) -> impl Observer {
    let count = count as f64;
    section(observer, i as f64 / count, (i + 1) as f64 / count)
}

//! Progress of one of several computations.

use verne_solver::workspace::Observer;

/// One of several computations: its progress is a part of the whole.
pub(crate) struct Stage<'a> {
    observer: &'a dyn Observer,
    start: f64,
    end: f64,
}

impl<'a> Stage<'a> {
    /// The computation that goes from `start` to `end`, of 0 to 1.
    pub(crate) fn of(observer: &'a dyn Observer, start: f64, end: f64) -> Self {
        Self { observer, start, end }
    }
}

impl Observer for Stage<'_> {
    fn progress(&self, part: f64) {
        self.observer.progress(self.start + part * (self.end - self.start));
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

/// One of several computations of about the same length.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(crate) fn part_of(observer: &dyn Observer, i: usize, count: usize) -> Stage<'_> {
    let count = count as f64;
    Stage::of(observer, i as f64 / count, (i + 1) as f64 / count)
}

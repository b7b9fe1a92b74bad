//! The progress of a computation on the terminal.

use indicatif::{ProgressBar, ProgressStyle};
use verne_solver::workspace::Observer;

const STEPS: u64 = 1000;

/// A progress bar on standard error; invisible if that is no terminal.
pub(crate) struct TerminalProgress(ProgressBar);

impl TerminalProgress {
    /// Shows the bar until it is dropped.
    pub(crate) fn new() -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {percent} % {elapsed}");
        Self(ProgressBar::new(STEPS).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }
}

/// The bytes read from a file or a pipe, on standard error; invisible if that is no terminal.
pub(crate) struct ReadProgress(ProgressBar);

impl ReadProgress {
    /// Shows which part of `total` bytes is read; if `total` is not known, how many are.
    pub(crate) fn new(total: Option<u64>) -> Self {
        let template =
            if total.is_some() { "{wide_bar} {percent} % {elapsed}" } else { "{bytes} read {elapsed}" };
        let style = ProgressStyle::with_template(template);
        let bar = total.map_or_else(ProgressBar::no_length, ProgressBar::new);
        Self(bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }

    /// Shows nothing.
    pub(crate) fn hidden() -> Self {
        Self(ProgressBar::hidden())
    }

    /// Adds bytes.
    pub(crate) fn add(&self, bytes: usize) {
        self.0.inc(bytes as u64);
    }
}

impl Drop for ReadProgress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Drop for TerminalProgress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Observer for TerminalProgress {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a float's cast stays in range"
    )]
    #[expect(clippy::cast_precision_loss, reason = "a thousand is exact")]
    fn progress(&self, part: f64) {
        let position = (part * STEPS as f64) as u64;
        // Several threads report, and not in order.
        if position > self.0.position() {
            self.0.set_position(position);
        }
    }

    /// Ctrl-C ends the process instead.
    fn cancelled(&self) -> bool {
        false
    }
}

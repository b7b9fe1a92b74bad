//! How far a computation is, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use verne_solver::workspace::Observer;

const STEPS: u64 = 1000;

/// A bar on standard error; nothing where that is no terminal. Ctrl-C ends the process: nothing has been written then.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new() -> Self {
        let style = ProgressStyle::with_template("{wide_bar} {percent} % {elapsed}");
        Self(ProgressBar::new(STEPS).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Observer for Bar {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a float's cast stays in range"
    )]
    #[expect(clippy::cast_precision_loss, reason = "a thousand is exact")]
    fn progress(&self, part: f64) {
        let position = (part * STEPS as f64) as u64;
        // Several threads report: the bar never falls.
        if position > self.0.position() {
            self.0.set_position(position);
        }
    }

    fn cancelled(&self) -> bool {
        false
    }
}

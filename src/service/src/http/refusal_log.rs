//! Lines in the log about requests whose sender may not: a few in a minute, and how many more there were.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Refusals in a minute that have a line of their own.
const LINES: u64 = 10;

const MINUTE: Duration = Duration::from_mins(1);

/// The refusals of the current minute, which begins with the first of them.
#[derive(Debug, Default)]
pub(crate) struct Refusals(Mutex<u64>);

impl Refusals {
    /// Counts a refusal with this status; whether it has a line of its own.
    pub(crate) fn has_line(self: &Arc<Self>, status: u16) -> bool {
        let mut count = self.count();
        *count += 1;
        if *count == 1 {
            let refusals = Arc::clone(self);
            tokio::spawn(async move {
                tokio::time::sleep(MINUTE).await;
                refusals.end(status);
            });
        }
        *count <= LINES
    }

    /// The minute is over.
    fn end(&self, status: u16) {
        let untold = std::mem::take(&mut *self.count()).saturating_sub(LINES);
        if untold > 0 {
            tracing::info!(status, requests = untold, "rejected more requests in the last minute");
        }
    }

    fn count(&self) -> MutexGuard<'_, u64> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{LINES, Refusals};
    use crate::telemetry::captured_log::CapturedLog;

    #[tokio::test]
    async fn few_have_a_line_and_the_others_are_counted() {
        let refusals = Arc::new(Refusals::default());
        let told = |count: u64| (0..count).filter(|_| refusals.has_line(401)).count();
        assert_eq!(told(24_000), 10);
        let logged = CapturedLog::begin();
        refusals.end(401);
        let text = logged.text();
        assert!(text.lines().count() == 1 && text.contains("23990") && text.contains("401"), "{text}");
        assert_eq!(told(LINES), 10, "another minute");
        refusals.end(401);
        assert_eq!(logged.text(), text, "all had a line");
    }
}

//! Tests now and then whether a backing store is writable.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::watch;
use tokio::time::{Instant, timeout};

/// For how long the result of a probe is reused.
const REUSED: Duration = Duration::from_secs(5);

type Outcome = Result<(), String>;

#[derive(Clone, Default)]
pub(crate) struct Health(Arc<Mutex<State>>);

#[derive(Default)]
struct State {
    last: Option<(Instant, Outcome)>,
    /// The outcome of the running probe.
    running: Option<watch::Receiver<Option<Outcome>>>,
}

impl Health {
    /// The outcome of a probe, or that of the last one if it is a few seconds old. An error if the probe takes longer
    /// than `limit`.
    ///
    /// One probe runs at a time. It continues when its callers have gone: otherwise callers with a short timeout would
    /// never learn the outcome.
    pub(crate) async fn check(
        &self,
        limit: Duration,
        probe: impl Future<Output = Outcome> + Send + 'static,
    ) -> Outcome {
        let mut running = {
            let mut state = self.state();
            if let Some((when, outcome)) = &state.last
                && when.elapsed() < REUSED
            {
                return outcome.clone();
            }
            let running = state.running.take().unwrap_or_else(|| self.start(probe));
            state.running = Some(running.clone());
            running
        };
        let finished =
            async { running.wait_for(Option::is_some).await.ok().and_then(|outcome| outcome.clone()) };
        let outcome = timeout(limit, finished).await.ok().flatten();
        outcome.unwrap_or_else(|| Err(format!("no answer within {} ms", limit.as_millis())))
    }

    fn start(
        &self,
        probe: impl Future<Output = Outcome> + Send + 'static,
    ) -> watch::Receiver<Option<Outcome>> {
        let (sender, receiver) = watch::channel(None);
        let health = self.clone();
        tokio::spawn(async move {
            let outcome = probe.await;
            {
                let mut state = health.state();
                state.last = Some((Instant::now(), outcome.clone()));
                state.running = None;
            }
            sender.send_replace(Some(outcome));
        });
        receiver
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use tokio::sync::oneshot;

    use super::Health;

    #[tokio::test(start_paused = true)]
    async fn a_probe_continues_after_its_callers_have_timed_out() {
        let (health, limit) = (Health::default(), Duration::from_secs(1));
        let (sender, receiver) = oneshot::channel();
        let slow = async move { receiver.await.unwrap_or_else(|_| Err("dropped".to_owned())) };
        let no_answer = Err("no answer within 1000 ms".to_owned());
        assert_eq!(health.check(limit, slow).await, no_answer);
        let never = async { Err("a second probe".to_owned()) };
        assert_eq!(health.check(limit, never).await, no_answer);
        assert_eq!(sender.send(Ok(())), Ok(()));
        let never = async { Err("a second probe".to_owned()) };
        assert_eq!(health.check(limit, never).await, Ok(()));
    }
}

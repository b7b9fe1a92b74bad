//! Whether objects can be written, asked now and then.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::watch;
use tokio::time::{Instant, timeout};

/// How long what was learned is believed.
const BELIEVED: Duration = Duration::from_secs(5);

type Answer = Result<(), String>;

#[derive(Clone, Default)]
pub(crate) struct Health(Arc<Mutex<State>>);

#[derive(Default)]
struct State {
    known: Option<(Instant, Answer)>,
    /// Filled by the probe that is under way.
    asking: Option<watch::Receiver<Option<Answer>>>,
}

impl Health {
    /// What a probe says now, or said a few seconds ago. One probe at a time, which goes on when its callers have gone: who
    /// asks with little patience again and again would learn nothing otherwise. No answer in time is none.
    pub(crate) async fn ask(
        &self,
        patience: Duration,
        probe: impl Future<Output = Answer> + Send + 'static,
    ) -> Answer {
        let mut asking = {
            let mut state = self.state();
            if let Some((when, answer)) = &state.known
                && when.elapsed() < BELIEVED
            {
                return answer.clone();
            }
            let under_way = state.asking.take().unwrap_or_else(|| self.begin(probe));
            state.asking = Some(under_way.clone());
            under_way
        };
        let answered =
            async { asking.wait_for(Option::is_some).await.ok().and_then(|answer| answer.clone()) };
        let answer = timeout(patience, answered).await.ok().flatten();
        answer.unwrap_or_else(|| Err(format!("no answer within {} ms", patience.as_millis())))
    }

    fn begin(&self, probe: impl Future<Output = Answer> + Send + 'static) -> watch::Receiver<Option<Answer>> {
        let (sender, receiver) = watch::channel(None);
        let health = self.clone();
        tokio::spawn(async move {
            let answer = probe.await;
            {
                let mut state = health.state();
                state.known = Some((Instant::now(), answer.clone()));
                state.asking = None;
            }
            sender.send_replace(Some(answer));
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
    async fn a_probe_goes_on_whose_callers_have_no_patience() {
        let (health, patience) = (Health::default(), Duration::from_secs(1));
        let (sender, receiver) = oneshot::channel();
        let slow = async move { receiver.await.unwrap_or_else(|_| Err("dropped".to_owned())) };
        let no_answer = Err("no answer within 1000 ms".to_owned());
        assert_eq!(health.ask(patience, slow).await, no_answer);
        let never = async { Err("a second probe".to_owned()) };
        assert_eq!(health.ask(patience, never).await, no_answer);
        assert_eq!(sender.send(Ok(())), Ok(()));
        let never = async { Err("a second probe".to_owned()) };
        assert_eq!(health.ask(patience, never).await, Ok(()));
    }
}

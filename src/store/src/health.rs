//! Whether objects can be written, asked now and then.

use std::time::Duration;

use tokio::sync::Mutex;
use tokio::time::Instant;

/// How long what was learned is believed.
const BELIEVED: Duration = Duration::from_secs(5);

#[derive(Default)]
pub(crate) struct Health(Mutex<Option<(Instant, Result<(), String>)>>);

impl Health {
    /// What a probe says now, or said a few seconds ago. One probe at a time.
    pub(crate) async fn ask(&self, probe: impl Future<Output = Result<(), String>>) -> Result<(), String> {
        let mut health = self.0.lock().await;
        if let Some((when, state)) = health.as_ref()
            && when.elapsed() < BELIEVED
        {
            return state.clone();
        }
        let state = probe.await;
        *health = Some((Instant::now(), state.clone()));
        state
    }
}

//! The subjects that the broker has forbidden to this process. The broker does not answer a request with a forbidden
//! subject; it sends a denial beside the answers.

use std::sync::Arc;
use std::time::{Duration, Instant};

use async_nats::{Event, ServerError};
use futures_util::FutureExt;
use futures_util::future::{self, Either};
use tokio::sync::watch;

/// A denial is reported for so long. The next check repeats one that is still in force before.
const REPORTED: Duration = Duration::from_secs(30);

/// Prefix of the broker's text of a denial.
const VIOLATION: &str = "permissions violation";

/// The last denial. Clones share it.
#[derive(Clone, Default)]
pub(super) struct Denials(Arc<watch::Sender<Option<(Instant, String)>>>);

impl Denials {
    /// Remembers an event if it is a denial, and logs it unless one is reported already. A new connection may have
    /// other permissions.
    pub(super) fn note(&self, event: Event) {
        let denial = match event {
            Event::ServerError(ServerError::Other(text)) if text.to_lowercase().starts_with(VIOLATION) => {
                text
            }
            Event::Connected => return drop(self.0.send_replace(None)),
            _ => return,
        };
        if self.reported().is_none() {
            tracing::error!(denial, "the broker forbids an operation that jobs need");
        }
        self.0.send_replace(Some((Instant::now(), denial)));
    }

    /// The last denial, unless it is old.
    pub(super) fn reported(&self) -> Option<String> {
        let last = self.0.borrow();
        last.as_ref().filter(|(time, _)| time.elapsed() < REPORTED).map(|(_, denial)| denial.clone())
    }

    /// The output of `request`, or the first denial as an error if that comes before.
    pub(super) async fn or_denied<T>(&self, request: impl Future<Output = T>) -> Result<T, String> {
        let mut last = self.0.subscribe();
        let denied =
            last.wait_for(Option::is_some).map(|denial| denial.ok().and_then(|denial| denial.clone()));
        match future::select(Box::pin(request), Box::pin(denied)).await {
            Either::Left((output, _)) => Ok(output),
            Either::Right((denial, _)) => Err(denial.map(|(_, text)| text).unwrap_or_default()),
        }
    }
}

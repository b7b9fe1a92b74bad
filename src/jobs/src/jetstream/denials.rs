//! What the broker has forbidden this process. The broker answers no request whose subject it forbids: it tells the
//! connection of it beside the answers.

use std::sync::Arc;
use std::time::{Duration, Instant};

use async_nats::jetstream::context::PublishErrorKind;
use async_nats::{Event, HeaderMap, ServerError, header};
use bytes::Bytes;
use futures_util::FutureExt;
use futures_util::future::{self, Either};
use tokio::sync::watch;
use tokio::time::MissedTickBehavior;

use super::bus::{Bus, Line, line_prefix, unavailable};
use super::client::Client;
use super::record::LAYOUT;
use crate::Unavailable;

/// How often a process checks that the broker lets it write.
const CHECKED: Duration = Duration::from_secs(10);

/// A denial is reported for so long. One that is still in force is repeated before: a check and its time-out are
/// shorter.
const REPORTED: Duration = Duration::from_secs(30);

/// The broker's words for a denial begin so.
const VIOLATION: &str = "permissions violation";

/// The last denial. Clones share it.
#[derive(Clone, Default)]
pub(super) struct Denials(Arc<watch::Sender<Option<(Instant, String)>>>);

impl Denials {
    /// Keeps what the broker says if it is a denial, and logs it unless one is reported already. A new connection may
    /// have other permissions.
    pub(super) fn note(&self, event: Event) {
        let told = match event {
            Event::ServerError(ServerError::Other(told)) if told.to_lowercase().starts_with(VIOLATION) => {
                told
            }
            Event::Connected => return drop(self.0.send_replace(None)),
            _ => return,
        };
        if self.reported().is_none() {
            tracing::error!(told, "the broker forbids this process what jobs need");
        }
        self.0.send_replace(Some((Instant::now(), told)));
    }

    /// The last denial, unless it is old.
    pub(super) fn reported(&self) -> Option<String> {
        let last = self.0.borrow();
        last.as_ref().filter(|(when, _)| when.elapsed() < REPORTED).map(|(_, told)| told.clone())
    }

    /// What `asked` answers, or the first denial if that comes before.
    pub(super) async fn or_denied<T>(&self, asked: impl Future<Output = T>) -> Result<T, String> {
        let mut last = self.0.subscribe();
        let denied = last.wait_for(Option::is_some).map(|told| told.ok().and_then(|told| told.clone()));
        match future::select(Box::pin(asked), Box::pin(denied)).await {
            Either::Left((answer, _)) => Ok(answer),
            Either::Right((told, _)) => Err(told.map(|(_, told)| told).unwrap_or_default()),
        }
    }
}

impl Bus {
    /// Checks that the broker lets this process write. Returns early if it does not: the denial is noted then.
    pub(super) async fn check_permissions(&self) {
        drop(self.denials.or_denied(self.check_writes()).await);
    }

    /// Sends a record and a message for each line that the broker must refuse, because they name a predecessor that is
    /// not there. So nothing is written. No answer comes where the broker forbids the subject.
    async fn check_writes(&self) -> Result<(), Unavailable> {
        let checks = self.checked_subjects().into_iter().map(|subject| async {
            let mut headers = HeaderMap::new();
            headers.insert(header::NATS_EXPECTED_LAST_SUBJECT_SEQUENCE, "1");
            let sent = self.context.publish_with_headers(subject, headers, Bytes::new());
            match sent.await.map_err(unavailable)?.await {
                Err(fault) if fault.kind() == PublishErrorKind::WrongLastSequence => Ok(()),
                Err(fault) => Err(unavailable(fault)),
                Ok(_) => Err(Unavailable("the broker has taken a record that it had to refuse".to_owned())),
            }
        });
        future::try_join_all(checks).await.map(drop)
    }

    /// One subject of each kind that is written and answered. Nothing is ever kept under these.
    fn checked_subjects(&self) -> Vec<String> {
        let lines = Line::ALL.iter().map(|line| line_prefix(&self.config, *line));
        let prefixes = lines.chain([format!("{}{LAYOUT}.", self.records.prefix)]);
        prefixes.map(|prefix| format!("{prefix}check")).collect()
    }
}

/// Checks again and again: permissions may be changed while the broker runs.
pub(super) async fn watch(client: Arc<Client>) {
    let mut tick = tokio::time::interval(CHECKED);
    tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        tick.tick().await;
        if let Err(fault) = client.bus.check_writes().await {
            tracing::debug!(%fault, "the broker does not tell whether this process may write");
        }
    }
}

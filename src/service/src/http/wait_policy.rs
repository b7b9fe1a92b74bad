//! How long a request waits for the result of its job, by the header Prefer (RFC 7240).

use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Response};

use crate::http::client::Client;
use crate::http::error::HttpError;
use crate::http::state::SharedState;
use crate::limits::admission::RequestPermit;
use crate::wire::error::OperationError;

const PREFER: HeaderName = HeaderName::from_static("prefer");
const PREFERENCE_APPLIED: HeaderName = HeaderName::from_static("preference-applied");

/// How long a request waits for the result of its job.
#[derive(Debug)]
pub(crate) struct WaitPolicy {
    /// The client that waits.
    pub client: Client,
    /// The permit that the request returns while it waits.
    pub permit: Arc<RequestPermit>,
    /// The wait after which the response is 202. Zero: the request does not wait.
    wait: Duration,
    /// The end of every wait: the time limit of the request is near then.
    latest: Instant,
    /// The preference of the request that applies.
    applied: Option<String>,
}

impl FromRequestParts<SharedState> for WaitPolicy {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, state: &SharedState) -> Result<Self, HttpError> {
        let client = Client::from_request_parts(parts, state).await?;
        let permit = parts.extensions.get().cloned().ok_or(OperationError::Internal)?;
        let preferred = preferred_wait(&parts.headers);
        let wait = preferred.unwrap_or(state.limits.wait).min(state.limits.longest_wait);
        let applied = preferred.map(|_| match wait.as_secs() {
            0 => "respond-async".to_owned(),
            seconds => format!("wait={seconds}"),
        });
        let latest = Instant::now() + state.limits.longest_wait;
        Ok(Self { client, permit, wait, latest, applied })
    }
}

impl WaitPolicy {
    /// The wait from now on. It is shorter than preferred after a body that has arrived slowly.
    pub(crate) fn wait(&self) -> Duration {
        wait_until(self.latest, self.wait, Instant::now())
    }

    /// States in the response which preference applied.
    pub(crate) fn state_preference<B>(self, response: &mut Response<B>) {
        if let Some(value) = self.applied.and_then(|applied| HeaderValue::from_str(&applied).ok()) {
            response.headers_mut().insert(PREFERENCE_APPLIED, value);
        }
    }
}

fn wait_until(latest: Instant, preferred: Duration, now: Instant) -> Duration {
    preferred.min(latest.saturating_duration_since(now))
}

/// The wait that the request prefers. With both preferences, the response is asynchronous after `wait`.
fn preferred_wait(headers: &HeaderMap) -> Option<Duration> {
    let values = headers.get_all(PREFER).iter().filter_map(|value| value.to_str().ok());
    let mut preferred = None;
    for preference in values.flat_map(|value| value.split(',')) {
        let preference = preference.split(';').next().unwrap_or_default().trim();
        match preference.split_once('=') {
            None if preference.eq_ignore_ascii_case("respond-async") => {
                preferred = preferred.or(Some(Duration::ZERO));
            }
            Some((name, seconds)) if name.trim().eq_ignore_ascii_case("wait") => {
                let seconds = seconds.trim().trim_matches('"').parse::<u32>().ok();
                preferred = seconds.map(|seconds| Duration::from_secs(seconds.into())).or(preferred);
            }
            _ => {}
        }
    }
    preferred
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::time::{Duration, Instant};

    use axum::http::{HeaderMap, HeaderValue};

    use super::{PREFER, preferred_wait, wait_until};

    #[test]
    fn a_wait_ends_before_the_time_limit_also_after_a_slow_body() {
        let began = Instant::now();
        let seconds = Duration::from_secs;
        for (now, wait) in [(0, 10), (19, 10), (25, 4), (29, 0), (31, 0)] {
            assert_eq!(
                wait_until(began + seconds(29), seconds(10), began + seconds(now)),
                seconds(wait),
                "{now}"
            );
        }
    }

    #[test]
    fn preferences_follow_rfc_7240() {
        for (header, seconds) in [
            ("respond-async", Some(0)),
            ("Respond-Async", Some(0)),
            ("wait=10", Some(10)),
            ("respond-async, wait=10", Some(10)),
            ("wait=\"5\", respond-async", Some(5)),
            ("return=minimal; x=y", None),
            ("handling=lenient, wait=100; ok=1", Some(100)),
            ("wait=soon", None),
            ("wait=-1", None),
            ("", None),
        ] {
            let headers = HeaderMap::from_iter([(PREFER, HeaderValue::from_static(header))]);
            assert_eq!(preferred_wait(&headers), seconds.map(Duration::from_secs), "{header}");
        }
    }
}

//! How long a client is willing to wait: the header Prefer (RFC 7240).

use std::sync::Arc;
use std::time::Duration;

use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Response};

use crate::http::caller::Caller;
use crate::http::error::HttpError;
use crate::http::result_or_job::Patience;
use crate::http::state::Shared;
use crate::limits::admission::Place;
use crate::wire::error::OperationError;

const PREFER: HeaderName = HeaderName::from_static("prefer");
const PREFERENCE_APPLIED: HeaderName = HeaderName::from_static("preference-applied");

/// What a request says about waiting.
#[derive(Debug)]
pub(crate) struct Prefer {
    /// Who waits, and how long.
    pub patience: Patience,
    applied: Option<String>,
}

impl FromRequestParts<Shared> for Prefer {
    type Rejection = HttpError;

    async fn from_request_parts(parts: &mut Parts, state: &Shared) -> Result<Self, HttpError> {
        let caller = Caller::from_request_parts(parts, state).await?;
        // The gate has put it there.
        let place = parts.extensions.get::<Arc<Place>>().cloned().ok_or(OperationError::Internal)?;
        let preferred = preferred(&parts.headers);
        let wait = preferred.unwrap_or(state.limits.wait).min(state.limits.longest_wait);
        let applied = preferred.map(|_| match wait.as_secs() {
            0 => "respond-async".to_owned(),
            seconds => format!("wait={seconds}"),
        });
        Ok(Self { patience: Patience { caller, place, wait }, applied })
    }
}

impl Prefer {
    /// Says which preference was followed.
    pub(crate) fn tell<B>(self, response: &mut Response<B>) {
        if let Some(value) = self.applied.and_then(|applied| HeaderValue::from_str(&applied).ok()) {
            response.headers_mut().insert(PREFERENCE_APPLIED, value);
        }
    }
}

/// The wait that is asked for. Both preferences together: `respond-async` once `wait` has passed.
fn preferred(headers: &HeaderMap) -> Option<Duration> {
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
    use std::time::Duration;

    use axum::http::{HeaderMap, HeaderValue};

    use super::{PREFER, preferred};

    #[test]
    fn preferences_as_rfc_7240_has_them() {
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
            assert_eq!(preferred(&headers), seconds.map(Duration::from_secs), "{header}");
        }
    }
}

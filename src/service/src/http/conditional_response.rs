//! Sends content that never changes: entity tags, 304, byte ranges.

use std::convert::Infallible;
use std::ops::{Range, RangeInclusive};

use axum::body::Body;
use axum::extract::FromRequestParts;
use axum::http::header::{
    ACCEPT_RANGES, CACHE_CONTROL, CONTENT_DISPOSITION, CONTENT_LENGTH, CONTENT_LOCATION, CONTENT_RANGE,
    CONTENT_TYPE, ETAG, IF_RANGE, RANGE, VARY,
};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode};
use axum::response::{IntoResponse, Response};
use headers::{ETag, HeaderMapExt, IfNoneMatch, IfRange};
use verne_store::ContentReader;

use crate::http::error::HttpError;
use crate::limits::response_memory::Own;
use crate::wire::error::OperationError;

/// For what lies under its own id.
pub(crate) const FOR_EVER: &str = "public, max-age=31536000, immutable";

/// Under which conditions, and of which part, a representation is wanted.
#[derive(Debug, Default)]
pub(crate) struct Conditions {
    if_none_match: Option<IfNoneMatch>,
    if_range: Option<IfRange>,
    range: Option<String>,
}

impl<S: Sync> FromRequestParts<S> for Conditions {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        // They mean something for GET and HEAD only, a range for GET only.
        if ![Method::GET, Method::HEAD].contains(&parts.method) {
            return Ok(Self::default());
        }
        let if_range = parts.headers.typed_get();
        // A condition that cannot be read is not fulfilled: all is sent.
        let is_unreadable = if_range.is_none() && parts.headers.contains_key(IF_RANGE);
        let may_be_part = parts.method == Method::GET && !is_unreadable;
        let range = parts.headers.get(RANGE).filter(|_| may_be_part);
        Ok(Self {
            if_none_match: parts.headers.typed_get(),
            if_range,
            range: range.and_then(|range| range.to_str().ok()).map(str::to_owned),
        })
    }
}

/// Content with what is said about it.
#[derive(Debug)]
pub(crate) struct Delivery {
    /// The bytes, sent as they are read.
    pub content: ContentReader,
    /// They were made for this answer.
    pub own: bool,
    /// Their media type.
    pub media: &'static str,
    /// How long they may be kept; nothing for answers to POST.
    pub cache_control: Option<&'static str>,
    /// The path at which the same bytes are had by GET.
    pub location: String,
    /// The name under which a browser saves them.
    pub file_name: Option<String>,
}

impl Delivery {
    /// The answer to a request with these conditions.
    pub(crate) fn answer(self, conditions: &Conditions) -> Result<Response, HttpError> {
        let tag = format!("\"{}\"", &self.content.hash().to_hex()[..32]);
        let headers = self.headers(&tag);
        let Ok(etag) = tag.parse::<ETag>() else { return Err(OperationError::Internal.into()) };
        if conditions.if_none_match.as_ref().is_some_and(|condition| !condition.precondition_passes(&etag)) {
            return Ok((StatusCode::NOT_MODIFIED, headers).into_response());
        }
        let length = self.content.len();
        let outdated =
            conditions.if_range.as_ref().is_some_and(|condition| condition.is_modified(Some(&etag), None));
        let range = conditions.range.as_deref().filter(|_| !outdated);
        let mut answer = match range.and_then(|range| wanted(range, length)) {
            None => sent(StatusCode::OK, headers, &self.content, 0..length),
            Some(range) => partial(headers, &self.content, range?),
        };
        if self.own {
            answer.extensions_mut().insert(Own(length));
        }
        Ok(answer)
    }

    fn headers(&self, tag: &str) -> HeaderMap {
        let fixed = [
            (CONTENT_TYPE, Some(self.media.to_owned())),
            (ETAG, Some(tag.to_owned())),
            (VARY, Some("accept".to_owned())),
            (ACCEPT_RANGES, self.cache_control.map(|_| "bytes".to_owned())),
            (CACHE_CONTROL, self.cache_control.map(str::to_owned)),
            (CONTENT_LOCATION, Some(self.location.clone())),
            (CONTENT_DISPOSITION, self.file_name.as_ref().map(|name| format!("inline; filename=\"{name}\""))),
        ];
        fixed.into_iter().filter_map(|(name, value)| header(name, &value?)).collect()
    }
}

fn header(name: HeaderName, value: &str) -> Option<(HeaderName, HeaderValue)> {
    HeaderValue::from_str(value).ok().map(|value| (name, value))
}

fn partial(mut headers: HeaderMap, content: &ContentReader, range: RangeInclusive<u64>) -> Response {
    let (first, last) = (*range.start(), *range.end());
    headers.extend(header(CONTENT_RANGE, &format!("bytes {first}-{last}/{}", content.len())));
    sent(StatusCode::PARTIAL_CONTENT, headers, content, first..last + 1)
}

/// What cannot be read to its end breaks the connection off: the length was promised.
fn sent(status: StatusCode, mut headers: HeaderMap, content: &ContentReader, range: Range<u64>) -> Response {
    headers.insert(CONTENT_LENGTH, (range.end - range.start).into());
    (status, headers, Body::from_stream(content.stream(range))).into_response()
}

/// The bytes that a header Range asks for. Nothing, so that all are sent, if it is none of `bytes=a-b`, `bytes=a-` and
/// `bytes=-n`: several ranges at once included, which a server may answer in full.
fn wanted(header: &str, length: u64) -> Option<Result<RangeInclusive<u64>, HttpError>> {
    let (unit, range) = header.split_once('=')?;
    let (first, last) = range.trim().split_once('-')?;
    if !unit.trim().eq_ignore_ascii_case("bytes") {
        return None;
    }
    let number =
        |text: &str| text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().unwrap_or(u64::MAX));
    let end = length.saturating_sub(1);
    let (first, last) = match (first, last) {
        ("", "") => return None,
        ("", count) => match number(count)? {
            0 => (length, end),
            count => (length.saturating_sub(count), end),
        },
        (first, "") => (number(first)?, end),
        (first, last) => {
            let (first, last) = (number(first)?, number(last)?);
            if last < first {
                return None;
            }
            (first, last.min(end))
        }
    };
    Some(if first < length { Ok(first..=last) } else { Err(HttpError::RangeNotSatisfiable(length)) })
}

#[cfg(test)]
mod tests {
    use super::wanted;
    use crate::http::error::HttpError;

    #[test]
    fn ranges_as_rfc_9110_has_them() {
        for (header, range) in [
            ("bytes=0-0", Some(Ok(0..=0))),
            ("bytes=2-", Some(Ok(2..=9))),
            ("bytes=5-99", Some(Ok(5..=9))),
            ("bytes=-3", Some(Ok(7..=9))),
            ("bytes=-99", Some(Ok(0..=9))),
            ("Bytes=9-9", Some(Ok(9..=9))),
            ("bytes=10-", Some(Err(HttpError::RangeNotSatisfiable(10)))),
            ("bytes=99999999999999999999999-", Some(Err(HttpError::RangeNotSatisfiable(10)))),
            ("bytes=-0", Some(Err(HttpError::RangeNotSatisfiable(10)))),
            ("bytes=3-2", None),
            ("bytes=0-1,3-4", None),
            ("bytes=-", None),
            ("bytes=+1-2", None),
            ("lines=0-1", None),
            ("bytes", None),
        ] {
            assert_eq!(wanted(header, 10), range, "{header}");
        }
    }
}

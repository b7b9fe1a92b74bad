//! Responses to conditional requests and to requests for a byte range (RFC 9110, 13 and 14): 200, 206, 304 or 416.

use std::convert::Infallible;
use std::ops::{Range, RangeInclusive};

use axum::body::Body;
use axum::extract::FromRequestParts;
use axum::http::header::{
    ACCEPT_RANGES, CACHE_CONTROL, CONTENT_DISPOSITION, CONTENT_LENGTH, CONTENT_LOCATION, CONTENT_RANGE,
    CONTENT_TYPE, IF_RANGE, RANGE, VARY,
};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode};
use axum::response::{IntoResponse, Response};
use headers::{ETag, HeaderMapExt, IfNoneMatch, IfRange};
use verne_store::ContentReader;

use crate::http::error::HttpError;
use crate::limits::response_memory::UnsharedBytes;
use crate::wire::error::OperationError;

/// Cache-Control of content whose path contains its hash or id: the content of a path never changes.
pub(crate) const IMMUTABLE: &str = "public, max-age=31536000, immutable";

/// Cache-Control of answers that depend on their URL and on the published machines, which change only with a restart.
pub(crate) const UNTIL_RESTART: &str = "public, max-age=300";

/// The strong tag of a representation: the first 32 digits of its hash, and its coding.
pub(crate) fn entity_tag(hash: &blake3::Hash, coding: Option<&str>) -> Result<ETag, OperationError> {
    let coding = coding.map(|name| format!("-{name}")).unwrap_or_default();
    format!("\"{:.32}{coding}\"", hash.to_hex()).parse().map_err(|_| OperationError::Internal)
}

/// The conditions of a request, and the range that it asks for.
#[derive(Debug, Default)]
pub(crate) struct Conditions {
    if_none_match: Option<IfNoneMatch>,
    if_range: Option<IfRange>,
    range: Option<String>,
}

impl<S: Sync> FromRequestParts<S> for Conditions {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        // Conditions apply to GET and HEAD only, a range to GET only.
        if ![Method::GET, Method::HEAD].contains(&parts.method) {
            return Ok(Self::default());
        }
        let if_range = parts.headers.typed_get();
        // An If-Range that cannot be read counts as not fulfilled: the response has the whole content.
        let is_unreadable = if_range.is_none() && parts.headers.contains_key(IF_RANGE);
        let may_be_partial = parts.method == Method::GET && !is_unreadable;
        let range = parts.headers.get(RANGE).filter(|_| may_be_partial);
        Ok(Self {
            if_none_match: parts.headers.typed_get(),
            if_range,
            range: range.and_then(|range| range.to_str().ok()).map(str::to_owned),
        })
    }
}

impl Conditions {
    /// Whether the client has the representation with this tag, so that 304 is the response.
    pub(crate) fn are_unmodified(&self, etag: &ETag) -> bool {
        self.if_none_match.as_ref().is_some_and(|condition| !condition.precondition_passes(etag))
    }

    /// The range that the request asks for, unless If-Range names another tag.
    fn range(&self, etag: &ETag, length: u64) -> Option<Result<RangeInclusive<u64>, HttpError>> {
        let is_modified =
            self.if_range.as_ref().is_some_and(|condition| condition.is_modified(Some(etag), None));
        byte_range(self.range.as_deref().filter(|_| !is_modified)?, length)
    }
}

/// Content with the metadata that a response states.
#[derive(Debug)]
pub(crate) struct Representation {
    /// The bytes. The response reads them while it is sent.
    pub content: ContentReader,
    /// Whether the bytes were made for this response and are in memory for it alone.
    pub is_unshared: bool,
    /// The media type.
    pub media: &'static str,
    /// The value of Cache-Control; none for responses to POST.
    pub cache_control: Option<&'static str>,
    /// The path at which GET returns the same bytes, if it is another one than that of the request.
    pub location: Option<String>,
    /// The name under which a browser saves the content.
    pub file_name: Option<String>,
}

impl Representation {
    /// JSON that GET returns at a path.
    pub(crate) fn json(content: impl Into<ContentReader>, location: String) -> Self {
        Self {
            content: content.into(),
            is_unshared: false,
            media: "application/json",
            cache_control: None,
            location: Some(location),
            file_name: None,
        }
    }

    /// The representation with a value of Cache-Control.
    pub(crate) fn cached(self, cache_control: &'static str) -> Self {
        Self { cache_control: Some(cache_control), ..self }
    }

    /// The response to a request with these conditions.
    pub(crate) fn respond(self, conditions: &Conditions) -> Result<Response, HttpError> {
        let etag = entity_tag(&self.content.hash(), None)?;
        let mut headers = self.headers();
        headers.typed_insert(etag.clone());
        if conditions.are_unmodified(&etag) {
            return Ok((StatusCode::NOT_MODIFIED, headers).into_response());
        }
        let length = self.content.len();
        let mut response = match conditions.range(&etag, length) {
            None => send(StatusCode::OK, headers, &self.content, 0..length),
            Some(range) => {
                let (first, last) = range?.into_inner();
                headers.extend(header(CONTENT_RANGE, &format!("bytes {first}-{last}/{length}")));
                send(StatusCode::PARTIAL_CONTENT, headers, &self.content, first..last + 1)
            }
        };
        if self.is_unshared {
            response.extensions_mut().insert(UnsharedBytes(length));
        }
        Ok(response)
    }

    fn headers(&self) -> HeaderMap {
        let headers = [
            (CONTENT_TYPE, Some(self.media.to_owned())),
            (VARY, Some("accept".to_owned())),
            (ACCEPT_RANGES, self.cache_control.map(|_| "bytes".to_owned())),
            (CACHE_CONTROL, self.cache_control.map(str::to_owned)),
            (CONTENT_LOCATION, self.location.clone()),
            (CONTENT_DISPOSITION, self.file_name.as_deref().map(inline)),
        ];
        headers.into_iter().filter_map(|(name, value)| header(name, &value?)).collect()
    }
}

/// A text that is written while it is sent: its length is not known, so the response has no ranges. Its path never
/// returns other bytes.
pub(crate) struct StreamedText {
    /// The strong tag.
    pub etag: ETag,
    /// The request header that selects the text.
    pub vary: &'static str,
    /// The media type.
    pub media: &'static str,
    /// The name under which a browser saves the text.
    pub file_name: String,
}

impl StreamedText {
    /// The headers of the response; to a client that has the text already, the response 304 instead.
    pub(crate) fn begin(self, conditions: &Conditions) -> Result<HeaderMap, Box<Response>> {
        let always = [(CACHE_CONTROL, IMMUTABLE), (VARY, self.vary)];
        let mut headers: HeaderMap =
            always.into_iter().filter_map(|(name, value)| header(name, value)).collect();
        headers.typed_insert(self.etag.clone());
        if conditions.are_unmodified(&self.etag) {
            return Err(Box::new((StatusCode::NOT_MODIFIED, headers).into_response()));
        }
        headers.extend(header(CONTENT_TYPE, self.media));
        headers.extend(header(CONTENT_DISPOSITION, &inline(&self.file_name)));
        Ok(headers)
    }
}

/// A browser shows the content, and saves it under this name.
fn inline(file_name: &str) -> String {
    format!("inline; filename=\"{file_name}\"")
}

fn header(name: HeaderName, value: &str) -> Option<(HeaderName, HeaderValue)> {
    HeaderValue::from_str(value).ok().map(|value| (name, value))
}

/// A response with these bytes of the content. If they cannot be read to the end, the connection breaks off, because
/// the head has promised the length.
fn send(status: StatusCode, mut headers: HeaderMap, content: &ContentReader, range: Range<u64>) -> Response {
    headers.insert(CONTENT_LENGTH, (range.end - range.start).into());
    (status, headers, Body::from_stream(content.stream(range))).into_response()
}

/// The bytes that a header Range selects. `None` selects the whole content, for headers other than `bytes=a-b`,
/// `bytes=a-` and `bytes=-n`: a server may ignore several ranges at once.
fn byte_range(header: &str, length: u64) -> Option<Result<RangeInclusive<u64>, HttpError>> {
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
    use super::byte_range;
    use crate::http::error::HttpError;

    #[test]
    fn ranges_follow_rfc_9110() {
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
            assert_eq!(byte_range(header, 10), range, "{header}");
        }
    }
}

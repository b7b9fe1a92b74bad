//! Content that does not change while the process runs: the viewer's files and the OpenAPI document.
//!
//! The service compresses content when a client first accepts a coding, keeps the bytes, and sends them without a copy.

use std::io::{self, Read};

use axum::body::{Body, Bytes};
use axum::http::header::{ACCEPT_ENCODING, CACHE_CONTROL, CONTENT_ENCODING, CONTENT_TYPE, VARY};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use brotli::CompressorReader;
use flate2::Compression;
use flate2::read::GzEncoder;
use headers::HeaderMapExt;
use tokio::sync::OnceCell;

use crate::http::conditional_response::{Conditions, entity_tag};
use crate::http::negotiation::weighted;
use crate::operations::compute_pool::run_on_pool;
use crate::wire::error::OperationError;

/// Quality of Brotli, of 11. Levels 10 and 11 make the OpenAPI document a ninth smaller and take thirteen times as
/// long.
const BROTLI_QUALITY: u32 = 9;

/// Logarithm of the bytes of Brotli's window.
const BROTLI_WINDOW: u32 = 22;

/// Bytes that Brotli reads at once.
const BUFFER_BYTES: usize = 4096;

/// Content with its media type.
#[derive(Debug)]
pub(crate) struct StaticContent {
    identity: Bytes,
    media: HeaderValue,
    hash: blake3::Hash,
    brotli: OnceCell<Bytes>,
    gzip: OnceCell<Bytes>,
}

impl StaticContent {
    /// Content of a media type. The hash identifies the content.
    pub(crate) fn new(identity: Bytes, media: HeaderValue, hash: impl Into<blake3::Hash>) -> Self {
        Self { identity, media, hash: hash.into(), brotli: OnceCell::new(), gzip: OnceCell::new() }
    }

    /// The response to a request with these headers: the content in the coding that it accepts, or 304.
    pub(crate) async fn respond(
        &self,
        headers: &HeaderMap,
        conditions: &Conditions,
        cache_control: &'static str,
    ) -> Result<Response, OperationError> {
        let coding = Coding::accepted(headers);
        // Each coding is a representation with a tag of its own.
        let etag = entity_tag(&self.hash, coding.map(Coding::name))?;
        let about = [(CACHE_CONTROL, cache_control), (VARY, ACCEPT_ENCODING.as_str())];
        let (status, body) = if conditions.are_unmodified(&etag) {
            (StatusCode::NOT_MODIFIED, Bytes::new())
        } else {
            (StatusCode::OK, self.coded(coding).await?)
        };
        let mut response = (status, about, Body::from(body)).into_response();
        response.headers_mut().typed_insert(etag);
        if status == StatusCode::OK {
            response.headers_mut().insert(CONTENT_TYPE, self.media.clone());
            let coding = coding.map(|coding| (CONTENT_ENCODING, HeaderValue::from_static(coding.name())));
            response.headers_mut().extend(coding);
        }
        Ok(response)
    }

    async fn coded(&self, coding: Option<Coding>) -> Result<Bytes, OperationError> {
        let Some(coding) = coding else { return Ok(self.identity.clone()) };
        let coded = match coding {
            Coding::Brotli => &self.brotli,
            Coding::Gzip => &self.gzip,
        };
        let identity = self.identity.clone();
        let encode = || run_on_pool(move |_| coding.encode(&identity).map_err(|_| OperationError::Internal));
        coded.get_or_try_init(encode).await.cloned()
    }
}

/// A content coding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Coding {
    Brotli,
    Gzip,
}

impl Coding {
    /// The coding with the greatest weight in Accept-Encoding, Brotli of equals; none without the header.
    fn accepted(headers: &HeaderMap) -> Option<Self> {
        let weights: Vec<_> = weighted(headers, ACCEPT_ENCODING).collect();
        let weight = |coding: Self| {
            let of = |name: &str| weights.iter().find(|(coding, _)| coding == name);
            of(coding.name()).or_else(|| of("*")).map_or(0.0, |(_, weight)| *weight)
        };
        let (brotli, gzip) = (weight(Self::Brotli), weight(Self::Gzip));
        if brotli > 0.0 && brotli >= gzip {
            return Some(Self::Brotli);
        }
        (gzip > 0.0).then_some(Self::Gzip)
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Brotli => "br",
            Self::Gzip => "gzip",
        }
    }

    fn encode(self, identity: &[u8]) -> io::Result<Bytes> {
        let mut coded = Vec::new();
        match self {
            Self::Brotli => CompressorReader::new(identity, BUFFER_BYTES, BROTLI_QUALITY, BROTLI_WINDOW)
                .read_to_end(&mut coded)?,
            Self::Gzip => GzEncoder::new(identity, Compression::best()).read_to_end(&mut coded)?,
        };
        Ok(coded.into())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Bytes, to_bytes};
    use axum::http::header::ACCEPT_ENCODING;
    use axum::http::{HeaderMap, HeaderValue};

    use super::{Coding, StaticContent};
    use crate::http::conditional_response::Conditions;

    fn accepting(accepted: &'static str) -> HeaderMap {
        HeaderMap::from_iter([(ACCEPT_ENCODING, accepted.parse().unwrap())])
    }

    #[tokio::test]
    async fn responses_share_the_bytes_of_the_content() {
        let content = StaticContent::new(
            Bytes::from_static(&[b'x'; 10_000]),
            HeaderValue::from_static("text/plain"),
            [0; 32],
        );
        for encoding in ["identity", "gzip", "br"] {
            let mut addresses = Vec::new();
            for _ in 0..2 {
                let answer =
                    content.respond(&accepting(encoding), &Conditions::default(), "no-cache").await.unwrap();
                addresses.push(to_bytes(answer.into_body(), usize::MAX).await.unwrap().as_ptr());
            }
            assert_eq!(addresses[0], addresses[1], "{encoding}");
        }
    }

    #[test]
    fn the_best_accepted_encoding_is_chosen() {
        for (accepted, wanted) in [
            ("gzip, deflate, br, zstd", Some(Coding::Brotli)),
            ("gzip", Some(Coding::Gzip)),
            ("GZIP;q=0.5, br;q=0.4", Some(Coding::Gzip)),
            ("*", Some(Coding::Brotli)),
            ("br;q=0, *;q=0.1", Some(Coding::Gzip)),
            ("gzip;q=0", None),
            ("gzip;q=nonsense", None),
            ("identity", None),
            ("zstd", None),
            ("", None),
        ] {
            assert_eq!(Coding::accepted(&accepting(accepted)), wanted, "{accepted}");
        }
        assert_eq!(Coding::accepted(&HeaderMap::new()), None);
    }
}

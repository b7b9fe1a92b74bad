//! Content that is the same for everybody as long as the process lives: compressed once, sent without a copy.

use std::io::Write;

use axum::body::{Body, Bytes};
use axum::http::header::{ACCEPT_ENCODING, CACHE_CONTROL, CONTENT_ENCODING, CONTENT_TYPE, ETAG, VARY};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use brotli::enc::BrotliEncoderParams;
use flate2::Compression;
use flate2::write::GzEncoder;
use headers::{ETag, HeaderMapExt, IfNoneMatch};
use tokio::sync::OnceCell;

use crate::operations::compute_pool::run_on_pool;
use crate::wire::error::OperationError;

/// How hard Brotli tries, of 11: with the document the last two steps save one byte in nine and take thirteen times as long.
const QUALITY: i32 = 9;

/// Content with what is said about it.
#[derive(Debug)]
pub(crate) struct Fixed {
    plain: Bytes,
    media: String,
    hash: [u8; 32],
    brotli: OnceCell<Bytes>,
    gzip: OnceCell<Bytes>,
}

impl Fixed {
    /// Content of a media type, whose hash names it.
    pub(crate) fn new(plain: Bytes, media: String, hash: [u8; 32]) -> Self {
        Self { plain, media, hash, brotli: OnceCell::new(), gzip: OnceCell::new() }
    }

    /// The answer to a request with these headers: encoded as it accepts, or 304.
    pub(crate) async fn answer(
        &self,
        headers: &HeaderMap,
        cache_control: &'static str,
    ) -> Result<Response, OperationError> {
        let encoding = Encoding::accepted(headers);
        let name = encoding.map(Encoding::name);
        let tag = self.tag(name);
        let about = [(CACHE_CONTROL, cache_control), (ETAG, &tag), (VARY, ACCEPT_ENCODING.as_str())];
        let etag: ETag = tag.parse().map_err(|_| OperationError::Internal)?;
        if headers.typed_get::<IfNoneMatch>().is_some_and(|condition| !condition.precondition_passes(&etag)) {
            return Ok((StatusCode::NOT_MODIFIED, about).into_response());
        }
        let bytes = self.encoded(encoding).await?;
        let mut response = (about, [(CONTENT_TYPE, self.media.as_str())], Body::from(bytes)).into_response();
        if let Some(name) = name {
            response.headers_mut().insert(CONTENT_ENCODING, HeaderValue::from_static(name));
        }
        Ok(response)
    }

    /// Each encoding is a representation of its own.
    fn tag(&self, encoding: Option<&str>) -> String {
        let hash = blake3::Hash::from_bytes(self.hash).to_hex();
        let encoding = encoding.map(|name| format!("-{name}")).unwrap_or_default();
        format!("\"{}{encoding}\"", hash.as_str().get(..32).unwrap_or_default())
    }

    async fn encoded(&self, encoding: Option<Encoding>) -> Result<Bytes, OperationError> {
        let Some(encoding) = encoding else { return Ok(self.plain.clone()) };
        let kept = match encoding {
            Encoding::Brotli => &self.brotli,
            Encoding::Gzip => &self.gzip,
        };
        let plain = self.plain.clone();
        kept.get_or_try_init(|| run_on_pool(move |_| encoding.encode(&plain))).await.cloned()
    }
}

/// How content may be compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Brotli,
    Gzip,
}

impl Encoding {
    /// The one that is accepted best, the denser of equals; without the header none.
    fn accepted(headers: &HeaderMap) -> Option<Self> {
        let values = headers.get_all(ACCEPT_ENCODING).iter().filter_map(|value| value.to_str().ok());
        let codings: Vec<_> = values.flat_map(|value| value.split(',')).map(coding).collect();
        let weight = |encoding: Self| {
            let of = |name: &str| codings.iter().find(|(coding, _)| coding.eq_ignore_ascii_case(name));
            of(encoding.name()).or_else(|| of("*")).map_or(0.0, |(_, weight)| *weight)
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

    fn encode(self, mut plain: &[u8]) -> Result<Bytes, OperationError> {
        let mut encoded = Vec::new();
        match self {
            Self::Brotli => {
                let parameters = BrotliEncoderParams { quality: QUALITY, ..BrotliEncoderParams::default() };
                brotli::BrotliCompress(&mut plain, &mut encoded, &parameters)
                    .map_err(|_| OperationError::Internal)?;
            }
            Self::Gzip => {
                let mut encoder = GzEncoder::new(&mut encoded, Compression::best());
                encoder
                    .write_all(plain)
                    .and_then(|()| encoder.finish().map(drop))
                    .map_err(|_| OperationError::Internal)?;
            }
        }
        Ok(encoded.into())
    }
}

/// A coding with its weight (RFC 9110, 12.5.3).
fn coding(text: &str) -> (&str, f32) {
    let (name, parameter) = text.split_once(';').unwrap_or((text, ""));
    let weight = parameter.split_once('=').map_or(1.0, |(_, weight)| weight.trim().parse().unwrap_or(0.0));
    (name.trim(), weight)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Bytes, to_bytes};
    use axum::http::HeaderMap;
    use axum::http::header::ACCEPT_ENCODING;

    use super::{Encoding, Fixed};

    fn accepting(accepted: &'static str) -> HeaderMap {
        HeaderMap::from_iter([(ACCEPT_ENCODING, accepted.parse().unwrap())])
    }

    #[tokio::test]
    async fn no_answer_has_a_copy_of_its_own() {
        let fixed = Fixed::new(Bytes::from_static(&[b'x'; 10_000]), "text/plain".to_owned(), [0; 32]);
        for encoding in ["identity", "gzip", "br"] {
            let mut places = Vec::new();
            for _ in 0..2 {
                let answer = fixed.answer(&accepting(encoding), "no-cache").await.unwrap();
                places.push(to_bytes(answer.into_body(), usize::MAX).await.unwrap().as_ptr());
            }
            assert_eq!(places[0], places[1], "{encoding}");
        }
    }

    #[test]
    fn the_best_accepted_encoding_is_chosen() {
        for (accepted, wanted) in [
            ("gzip, deflate, br, zstd", Some(Encoding::Brotli)),
            ("gzip", Some(Encoding::Gzip)),
            ("GZIP;q=0.5, br;q=0.4", Some(Encoding::Gzip)),
            ("*", Some(Encoding::Brotli)),
            ("br;q=0, *;q=0.1", Some(Encoding::Gzip)),
            ("gzip;q=0", None),
            ("gzip;q=nonsense", None),
            ("identity", None),
            ("zstd", None),
            ("", None),
        ] {
            assert_eq!(Encoding::accepted(&accepting(accepted)), wanted, "{accepted}");
        }
        assert_eq!(Encoding::accepted(&HeaderMap::new()), None);
    }
}

//! The content coding of a request body (RFC 9110, 8.4).

use std::io::Read;

use axum::http::HeaderMap;
use axum::http::header::CONTENT_ENCODING;
use flate2::bufread::GzDecoder;

use crate::http::error::{HttpError, RequestError};
use crate::limits::error::LimitError;

/// Bytes that are decoded at once.
const CHUNK_BYTES: usize = 8 * 1024;

/// A coding that the service decodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coding {
    Gzip,
    Brotli,
}

impl Coding {
    /// The names of all codings, as the header Accept-Encoding lists them.
    pub(crate) const ACCEPTED: &str = "gzip, br";

    /// The coding of a body with these headers; `None` for a body that is not compressed.
    pub(crate) fn of(headers: &HeaderMap) -> Result<Option<Self>, RequestError> {
        let declared: Vec<_> = headers
            .get_all(CONTENT_ENCODING)
            .iter()
            .flat_map(|value| value.to_str().unwrap_or("?").split(','))
            .map(|name| name.trim().to_ascii_lowercase())
            .filter(|name| !name.is_empty() && name != "identity")
            .collect();
        match declared.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
            [] => Ok(None),
            ["gzip" | "x-gzip"] => Ok(Some(Self::Gzip)),
            ["br"] => Ok(Some(Self::Brotli)),
            others => Err(RequestError::UnsupportedCoding(others.join(", "))),
        }
    }

    /// Decodes a body of at most `limit` bytes. Calls `reserve` with the new length before the decoded body grows.
    /// Call it on the worker threads: a few hostile bytes can take milliseconds.
    pub(crate) fn decode(
        self,
        encoded: &[u8],
        limit: usize,
        reserve: impl FnMut(usize) -> Result<(), LimitError>,
    ) -> Result<Vec<u8>, HttpError> {
        match self {
            Self::Gzip => {
                let mut decoder = GzDecoder::new(encoded);
                let decoded = self.read(&mut decoder, limit, reserve)?;
                if decoder.into_inner().is_empty() {
                    Ok(decoded)
                } else {
                    Err(self.unreadable("extra bytes follow the end of the compressed data").into())
                }
            }
            Self::Brotli => self.read(&mut brotli::Decompressor::new(encoded, CHUNK_BYTES), limit, reserve),
        }
    }

    fn read(
        self,
        decoder: &mut impl Read,
        limit: usize,
        mut reserve: impl FnMut(usize) -> Result<(), LimitError>,
    ) -> Result<Vec<u8>, HttpError> {
        let (mut decoded, mut chunk) = (Vec::new(), [0; CHUNK_BYTES]);
        loop {
            let count = decoder.read(&mut chunk).map_err(|error| self.unreadable(&error.to_string()))?;
            let read = chunk.get(..count).unwrap_or_default();
            if read.is_empty() {
                return Ok(decoded);
            }
            if decoded.len() + count > limit {
                return Err(RequestError::BodyTooLarge(limit).into());
            }
            reserve(decoded.len() + count)?;
            decoded.extend_from_slice(read);
        }
    }

    fn unreadable(self, reason: &str) -> RequestError {
        let name = match self {
            Self::Gzip => "gzip",
            Self::Brotli => "br",
        };
        RequestError::UnreadableBody(format!("it cannot be decoded from {name}: {reason}"))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::http::HeaderMap;
    use axum::http::header::CONTENT_ENCODING;

    use super::Coding;

    #[test]
    fn content_encoding_follows_rfc_9110() {
        for (declared, coding) in [
            ("gzip", Some(Some(Coding::Gzip))),
            ("GZIP", Some(Some(Coding::Gzip))),
            ("x-gzip", Some(Some(Coding::Gzip))),
            ("br", Some(Some(Coding::Brotli))),
            ("identity", Some(None)),
            ("", Some(None)),
            ("identity, gzip", Some(Some(Coding::Gzip))),
            ("gzip, br", None),
            ("zstd", None),
            ("deflate", None),
        ] {
            let headers = HeaderMap::from_iter([(CONTENT_ENCODING, declared.parse().unwrap())]);
            assert_eq!(Coding::of(&headers).ok(), coding, "{declared}");
        }
    }
}

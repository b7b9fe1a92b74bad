//! The content coding of a request body (RFC 9110, 8.4).

use std::io::{self, Write};

use axum::http::HeaderMap;
use axum::http::header::CONTENT_ENCODING;
use flate2::write::GzDecoder;

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
        let mut decoder = Decoder::new(Some(self), LimitedBody { bytes: Vec::new(), limit, reserve });
        decoder.push(encoded)?;
        Ok(decoder.finish()?.bytes)
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Brotli => "br",
        }
    }
}

/// Decodes a body that arrives in pieces, and writes it into a sink. An error of the sink that contains an
/// [`HttpError`] is returned as that.
pub(crate) struct Decoder<W: Write> {
    stage: Stage<W>,
    coding: Option<Coding>,
}

enum Stage<W: Write> {
    Identity(W),
    Gzip(Box<GzDecoder<W>>),
    Brotli(Box<brotli::DecompressorWriter<W>>),
}

impl<W: Write> Decoder<W> {
    /// A decoder that has decoded nothing yet.
    pub(crate) fn new(coding: Option<Coding>, sink: W) -> Self {
        let stage = match coding {
            None => Stage::Identity(sink),
            Some(Coding::Gzip) => Stage::Gzip(Box::new(GzDecoder::new(sink))),
            Some(Coding::Brotli) => {
                Stage::Brotli(Box::new(brotli::DecompressorWriter::new(sink, CHUNK_BYTES)))
            }
        };
        Self { stage, coding }
    }

    /// Decodes the next bytes. Call it on the worker threads.
    pub(crate) fn push(&mut self, encoded: &[u8]) -> Result<(), HttpError> {
        let written = match &mut self.stage {
            Stage::Identity(sink) => sink.write_all(encoded),
            Stage::Gzip(decoder) => decoder.write_all(encoded),
            Stage::Brotli(decoder) => decoder.write_all(encoded),
        };
        written.map_err(|error| explained(self.coding, error))
    }

    /// The sink.
    pub(crate) fn sink_mut(&mut self) -> &mut W {
        match &mut self.stage {
            Stage::Identity(sink) => sink,
            Stage::Gzip(decoder) => decoder.get_mut(),
            Stage::Brotli(decoder) => decoder.get_mut(),
        }
    }

    /// The sink, after the last byte.
    pub(crate) fn finish(self) -> Result<W, HttpError> {
        let sink = match self.stage {
            Stage::Identity(sink) => Ok(sink),
            Stage::Gzip(decoder) => decoder.finish(),
            Stage::Brotli(mut decoder) => {
                let closed = decoder.close();
                closed.and_then(|()| decoder.into_inner().map_err(|_| io::ErrorKind::InvalidData.into()))
            }
        };
        sink.map_err(|error| explained(self.coding, error))
    }
}

fn explained(coding: Option<Coding>, error: io::Error) -> HttpError {
    let error = match error.downcast::<HttpError>() {
        Ok(error) => return error,
        Err(error) => error,
    };
    let reason = match error.kind() {
        io::ErrorKind::WriteZero => "extra bytes follow the end of the compressed data".to_owned(),
        _ => error.to_string(),
    };
    let name = coding.map_or("identity", Coding::name);
    RequestError::UnreadableBody(format!("it cannot be decoded from {name}: {reason}")).into()
}

/// A decoded body in memory.
struct LimitedBody<R> {
    bytes: Vec<u8>,
    limit: usize,
    reserve: R,
}

impl<R: FnMut(usize) -> Result<(), LimitError>> Write for LimitedBody<R> {
    fn write(&mut self, decoded: &[u8]) -> io::Result<usize> {
        let length = self.bytes.len() + decoded.len();
        if length > self.limit {
            return Err(io::Error::other(HttpError::from(RequestError::BodyTooLarge(self.limit))));
        }
        (self.reserve)(length).map_err(|error| io::Error::other(HttpError::from(error)))?;
        self.bytes.extend_from_slice(decoded);
        Ok(decoded.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::io::Read;

    use axum::http::HeaderMap;
    use axum::http::header::CONTENT_ENCODING;

    use super::{Coding, Decoder};
    use crate::http::error::HttpError;

    const TEXT: &[u8] = b"GOTO/1,2,3\n";

    fn encoded(coding: Coding) -> Vec<u8> {
        let mut encoded = Vec::new();
        match coding {
            Coding::Gzip => {
                let mut encoder = flate2::read::GzEncoder::new(TEXT, flate2::Compression::fast());
                encoder.read_to_end(&mut encoded).unwrap();
            }
            Coding::Brotli => {
                brotli::CompressorReader::new(TEXT, 4096, 5, 20).read_to_end(&mut encoded).unwrap();
            }
        }
        encoded
    }

    #[test]
    fn bodies_are_decoded_in_pieces_of_any_size() {
        for coding in [Coding::Gzip, Coding::Brotli] {
            for size in [1, 7, 1000] {
                let mut decoder = Decoder::new(Some(coding), Vec::new());
                encoded(coding).chunks(size).for_each(|piece| decoder.push(piece).unwrap());
                assert_eq!(decoder.finish().unwrap(), TEXT, "{coding:?} {size}");
            }
        }
    }

    #[test]
    fn incomplete_and_overlong_bodies_are_refused() {
        for coding in [Coding::Gzip, Coding::Brotli] {
            let decode = |bytes: &[u8], limit| coding.decode(bytes, limit, |_| Ok(()));
            let whole = encoded(coding);
            assert_eq!(decode(&whole, TEXT.len()).unwrap(), TEXT);
            let error = |bytes: &[u8], limit| -> HttpError { decode(bytes, limit).unwrap_err() };
            assert!(error(&whole, 5).to_string().contains("larger than the limit of 5 bytes"));
            for length in 0..whole.len() {
                assert!(error(&whole[..length], 99).to_string().contains("cannot be decoded"), "{length}");
            }
            assert!(error(&[&whole, &b"more"[..]].concat(), 99).to_string().contains("extra bytes"));
        }
    }

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

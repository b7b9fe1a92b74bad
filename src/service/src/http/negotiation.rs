//! Chooses among representations by the weights in Accept and Accept-Encoding (RFC 9110, 12.5).

use std::convert::Infallible;

use axum::extract::FromRequestParts;
use axum::http::header::ACCEPT;
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName};

use crate::http::error::HttpError;

/// The alternatives of a header, in lowercase, with their weights from 0 to 1. Parameters other than the weight are
/// ignored.
pub(crate) fn weighted(headers: &HeaderMap, name: HeaderName) -> impl Iterator<Item = (String, f32)> {
    let values = headers.get_all(name).iter().filter_map(|value| value.to_str().ok());
    values.flat_map(|value| value.split(',')).map(|alternative| {
        let mut parts = alternative.split(';').map(str::trim);
        let name = parts.next().unwrap_or_default().to_ascii_lowercase();
        let weight = parts.find_map(|part| {
            let (name, value) = part.split_once('=')?;
            name.trim().eq_ignore_ascii_case("q").then(|| value.trim().parse().unwrap_or(0.0))
        });
        (name, weight.unwrap_or(1.0_f32).clamp(0.0, 1.0))
    })
}

/// The media ranges of the header Accept with their weights. Without the header it is empty and accepts everything.
#[derive(Debug)]
pub(crate) struct Accept(Vec<(String, f32)>);

impl<S: Sync> FromRequestParts<S> for Accept {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self::of(&parts.headers))
    }
}

impl Accept {
    fn of(headers: &HeaderMap) -> Self {
        Self(weighted(headers, ACCEPT).filter(|(range, _)| range.contains('/')).collect())
    }

    /// The offer with the greatest weight, the first of equals.
    pub(crate) fn choose<T>(
        &self,
        offers: impl IntoIterator<Item = (&'static str, T)>,
    ) -> Result<T, HttpError> {
        let mut available = Vec::new();
        let mut best: Option<(f32, T)> = None;
        for (media, offer) in offers {
            available.push(media);
            let weight = self.weight(media);
            if weight > best.as_ref().map_or(0.0, |(weight, _)| *weight) {
                best = Some((weight, offer));
            }
        }
        best.map(|(_, offer)| offer).ok_or(HttpError::NotAcceptable(available))
    }

    /// Requires that JSON is accepted.
    pub(crate) fn require_json(&self) -> Result<(), HttpError> {
        self.choose([("application/json", ())])
    }

    /// The weight of a media type: that of the most specific range that contains it.
    fn weight(&self, media: &str) -> f32 {
        if self.0.is_empty() {
            return 1.0;
        }
        let matching =
            self.0.iter().filter_map(|(range, weight)| Some((specificity(range, media)?, *weight)));
        matching.max_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map_or(0.0, |(_, weight)| weight)
    }
}

/// How specific a range is that contains the media type: 0 for `*/*`, 1 for `type/*`, 2 for the type itself.
fn specificity(range: &str, media: &str) -> Option<u8> {
    match range.split_once('/')? {
        _ if range == media => Some(2),
        ("*", "*") => Some(0),
        (kind, "*") if media.split_once('/')?.0 == kind => Some(1),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use axum::http::header::ACCEPT;
    use axum::http::{HeaderMap, HeaderValue};

    use super::Accept;

    fn chosen(accept: &'static str) -> Option<&'static str> {
        let headers = HeaderMap::from_iter([(ACCEPT, HeaderValue::from_static(accept))]);
        let offers = ["application/json", "model/gltf-binary", "model/stl"].map(|media| (media, media));
        Accept::of(&headers).choose(offers).ok()
    }

    #[test]
    fn the_best_accepted_offer_is_chosen() {
        for (accept, wanted) in [
            ("*/*", Some("application/json")),
            ("", Some("application/json")),
            ("model/*", Some("model/gltf-binary")),
            ("model/stl", Some("model/stl")),
            ("MODEL/STL; q=0.2, application/json;q=0.1", Some("model/stl")),
            ("model/gltf-binary;q=0, model/*", Some("model/stl")),
            ("text/html, application/xhtml+xml, application/xml;q=0.9, */*;q=0.8", Some("application/json")),
            ("*/*;q=0.1, model/stl", Some("model/stl")),
            ("model/stl;charset=x;q=0.5, model/*;q=0.4", Some("model/stl")),
            ("text/html", None),
            ("*/*;q=0", None),
            ("model/stl;q=nonsense", None),
        ] {
            assert_eq!(chosen(accept), wanted, "{accept}");
        }
    }
}

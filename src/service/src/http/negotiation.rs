//! Which of several representations a request accepts (RFC 9110, 12.5.1).

use std::convert::Infallible;

use axum::extract::FromRequestParts;
use axum::http::HeaderMap;
use axum::http::header::ACCEPT;
use axum::http::request::Parts;

use crate::http::error::HttpError;

/// The media ranges of the header Accept; without it, everything.
#[derive(Debug)]
pub(crate) struct Accept(Vec<Range>);

/// One media range with its weight.
#[derive(Debug)]
struct Range {
    kind: String,
    subtype: String,
    weight: f32,
}

impl<S: Sync> FromRequestParts<S> for Accept {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self::of(&parts.headers))
    }
}

impl Accept {
    fn of(headers: &HeaderMap) -> Self {
        let values = headers.get_all(ACCEPT).iter().filter_map(|value| value.to_str().ok());
        Self(values.flat_map(|value| value.split(',')).filter_map(Range::parse).collect())
    }

    /// The offer that is accepted best, the first of equals.
    pub(crate) fn choose<T>(
        &self,
        offers: impl IntoIterator<Item = (&'static str, T)>,
    ) -> Result<T, HttpError> {
        let mut refused = Vec::new();
        let mut best: Option<(f32, T)> = None;
        for (media, offer) in offers {
            refused.push(media);
            let weight = self.weight(media);
            if weight > best.as_ref().map_or(0.0, |(weight, _)| *weight) {
                best = Some((weight, offer));
            }
        }
        best.map(|(_, offer)| offer).ok_or(HttpError::NotAcceptable(refused))
    }

    /// The weight of a media type: that of the most specific range it falls into.
    fn weight(&self, media: &str) -> f32 {
        if self.0.is_empty() {
            return 1.0;
        }
        let fitting =
            self.0.iter().filter_map(|range| range.fits(media).map(|closeness| (closeness, range.weight)));
        fitting.max_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map_or(0.0, |(_, weight)| weight)
    }
}

impl Range {
    /// One media range; nothing if it is none. Parameters other than the weight make no difference here.
    fn parse(text: &str) -> Option<Self> {
        let mut parts = text.split(';').map(str::trim);
        let (kind, subtype) = parts.next()?.split_once('/')?;
        let weight = parts.find_map(|part| {
            let (name, value) = part.split_once('=')?;
            name.trim().eq_ignore_ascii_case("q").then(|| value.trim().parse::<f32>().unwrap_or(0.0))
        });
        let (kind, subtype) = (kind.to_ascii_lowercase(), subtype.to_ascii_lowercase());
        Some(Self { kind, subtype, weight: weight.unwrap_or(1.0).clamp(0.0, 1.0) })
    }

    /// How closely a media type fits: 0 for `*/*`, 2 for its very name.
    fn fits(&self, media: &str) -> Option<u8> {
        let (kind, subtype) = media.split_once('/')?;
        match (self.kind.as_str(), self.subtype.as_str()) {
            ("*", "*") => Some(0),
            (own, "*") if own == kind => Some(1),
            (own, own_subtype) if own == kind && own_subtype == subtype => Some(2),
            _ => None,
        }
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

//! The origin of a web page, as browsers send it.

use std::str::FromStr;

use axum::http::{HeaderValue, Uri};

const ANY: &str = "*";

/// The scheme, host and optional port of a web page, or every origin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin(pub(crate) HeaderValue);

impl Origin {
    /// Whether it stands for every origin.
    pub(crate) fn is_any(&self) -> bool {
        self.0 == ANY
    }
}

impl FromStr for Origin {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let error = || "must be an origin such as https://example.org, without a path, or *".to_owned();
        let header = |text: &str| HeaderValue::from_str(text).map(Self).map_err(|_| error());
        if text == ANY {
            return header(text);
        }
        let uri: Uri = text.parse().map_err(|_| error())?;
        let (Some(scheme), Some(authority)) = (uri.scheme_str(), uri.authority()) else {
            return Err(error());
        };
        // Browsers send origins in lowercase.
        let origin = format!("{scheme}://{authority}").to_ascii_lowercase();
        let is_origin = ["http", "https"].contains(&scheme)
            && !authority.as_str().contains('@')
            && text.to_ascii_lowercase() == origin;
        if is_origin { header(&origin) } else { Err(error()) }
    }
}

#[cfg(test)]
mod tests {
    use super::Origin;

    #[test]
    fn origins_are_written_as_browsers_write_them() {
        for (text, origin) in [
            ("https://example.org", Some("https://example.org")),
            ("HTTPS://Example.org:8443", Some("https://example.org:8443")),
            ("http://[::1]:3000", Some("http://[::1]:3000")),
            ("*", Some("*")),
            ("https://example.org/", None),
            ("https://example.org/page", None),
            ("https://me@example.org", None),
            ("ftp://example.org", None),
            ("example.org", None),
            ("null", None),
            ("", None),
        ] {
            let read = text.parse::<Origin>().ok();
            assert_eq!(read.as_ref().and_then(|read| read.0.to_str().ok()), origin, "{text}");
        }
    }
}

//! The address of a running service, and errors of requests to it.

use std::error::Error;

use axum::http::Uri;

/// The address, if it has a scheme that the client speaks.
pub(crate) fn checked(url: &Uri) -> Result<&Uri, String> {
    if matches!(url.scheme_str(), Some("http" | "https")) {
        Ok(url)
    } else {
        Err(format!("{url}: not an http:// or https:// address"))
    }
}

/// The innermost error; the outer ones only repeat the address.
pub(crate) fn root_cause<'a>(mut error: &'a (dyn Error + 'static)) -> &'a (dyn Error + 'static) {
    while let Some(source) = error.source() {
        error = source;
    }
    error
}

//! The viewer's files, which the build script embeds. A build without them serves one sentence in their place.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::LazyLock;

use axum::Router;
use axum::body::Bytes;
use axum::http::header::CACHE_CONTROL;
use axum::http::{HeaderMap, HeaderValue};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use rust_embed::{EmbeddedFile, RustEmbed};

use crate::http::conditional_response::{Conditions, IMMUTABLE};
use crate::http::error::HttpError;
use crate::http::extractors::PathParameter;
use crate::http::security_headers;
use crate::http::static_content::StaticContent;

#[derive(RustEmbed)]
#[folder = "$OUT_DIR/viewer"]
struct Files;

/// The files by path.
static FILES: LazyLock<HashMap<Cow<'static, str>, StaticContent>> = LazyLock::new(|| {
    Files::iter().filter_map(|path| Some((path.clone(), static_content(Files::get(&path)?)))).collect()
});

const NO_VIEWER: &str = "This binary was built without the viewer. The viewer needs Node.js 20.19 or later with npm: \
    install them and run `touch src/service/build.rs && cargo build --release`. The API is complete; see /docs.\n";

/// The routes of the viewer's page and of the files that it loads.
pub(crate) fn routes<S: Clone + Send + Sync + 'static>() -> Router<S> {
    security_headers::pages(
        Router::new().route("/", get(page)).route("/assets/{name}", get(asset)),
        security_headers::VIEWER,
    )
}

/// The page. Browsers revalidate it each time, because it names the files of its own build.
async fn page(headers: HeaderMap, conditions: Conditions) -> Result<Response, HttpError> {
    match FILES.get("index.html") {
        Some(file) => Ok(file.respond(&headers, &conditions, "no-cache").await?),
        None => Ok(([(CACHE_CONTROL, "no-cache")], NO_VIEWER).into_response()),
    }
}

/// A file that the page loads. Its name contains a hash of its content.
async fn asset(
    PathParameter(name): PathParameter,
    headers: HeaderMap,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let file = FILES.get(format!("assets/{name}").as_str()).ok_or(HttpError::UnknownPath)?;
    Ok(file.respond(&headers, &conditions, IMMUTABLE).await?)
}

fn static_content(file: EmbeddedFile) -> StaticContent {
    let media = file.metadata.mimetype();
    let charset = if media.starts_with("text/") { "; charset=utf-8" } else { "" };
    let media = HeaderValue::from_str(&format!("{media}{charset}"));
    let bytes = match file.data {
        Cow::Borrowed(bytes) => Bytes::from_static(bytes),
        Cow::Owned(bytes) => bytes.into(),
    };
    let unknown = HeaderValue::from_static("application/octet-stream");
    StaticContent::new(bytes, media.unwrap_or(unknown), file.metadata.sha256_hash())
}

//! The viewer's files, embedded by the build script; without them, one sentence in their place.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::LazyLock;

use axum::Router;
use axum::body::Bytes;
use axum::extract::Path;
use axum::extract::rejection::PathRejection;
use axum::http::HeaderMap;
use axum::http::header::CACHE_CONTROL;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use rust_embed::{EmbeddedFile, RustEmbed};

use crate::http::conditional_response::FOR_EVER;
use crate::http::error::HttpError;
use crate::http::security_headers;
use crate::http::static_content::Fixed;

#[derive(RustEmbed)]
#[folder = "$OUT_DIR/viewer"]
struct Files;

/// The files by their paths.
static FILES: LazyLock<HashMap<Cow<'static, str>, Fixed>> = LazyLock::new(|| {
    Files::iter().filter_map(|path| Some((path.clone(), fixed(Files::get(&path)?)))).collect()
});

const NO_VIEWER: &str = "This binary was built without the viewer. The viewer needs Node.js 20.19 or later with npm: \
    install them and run `touch src/service/build.rs && cargo build --release`. The API is complete; see /docs.\n";

/// The page and the files it loads.
pub(crate) fn routes<S: Clone + Send + Sync + 'static>() -> Router<S> {
    security_headers::pages(
        Router::new().route("/", get(page)).route("/assets/{name}", get(asset)),
        security_headers::VIEWER,
    )
}

/// The page names the files of its own build: it is asked for anew each time.
async fn page(headers: HeaderMap) -> Result<Response, HttpError> {
    match FILES.get("index.html") {
        Some(file) => Ok(file.answer(&headers, "no-cache").await?),
        None => Ok(([(CACHE_CONTROL, "no-cache")], NO_VIEWER).into_response()),
    }
}

/// Names hold a hash of the content.
async fn asset(name: Result<Path<String>, PathRejection>, headers: HeaderMap) -> Result<Response, HttpError> {
    let Path(name) = name.map_err(|_| HttpError::UnknownPath)?;
    let file = FILES.get(format!("assets/{name}").as_str()).ok_or(HttpError::UnknownPath)?;
    Ok(file.answer(&headers, FOR_EVER).await?)
}

fn fixed(file: EmbeddedFile) -> Fixed {
    let media = file.metadata.mimetype().to_owned();
    let media = if media.starts_with("text/") { media + "; charset=utf-8" } else { media };
    let bytes = match file.data {
        Cow::Borrowed(bytes) => Bytes::from_static(bytes),
        Cow::Owned(bytes) => bytes.into(),
    };
    Fixed::new(bytes, media, file.metadata.sha256_hash())
}

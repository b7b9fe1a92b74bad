//! The viewer's files, which the build script embeds. A build without them serves one sentence in their place.

use std::sync::LazyLock;

use axum::Router;
use axum::http::HeaderMap;
use axum::http::header::CACHE_CONTROL;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use rust_embed::RustEmbed;

use crate::http::conditional_response::{Conditions, IMMUTABLE};
use crate::http::embedded_files::{EmbeddedFiles, embedded_files};
use crate::http::error::HttpError;
use crate::http::extractors::PathParameter;
use crate::http::security_headers;

#[derive(RustEmbed)]
#[folder = "$OUT_DIR/viewer"]
struct Folder;

/// The files by path.
static FILES: LazyLock<EmbeddedFiles> = LazyLock::new(embedded_files::<Folder>);

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

//! The guide: the documentation as pages, which the build script makes of `docs`. A build without it serves one
//! sentence in its place.

use std::sync::LazyLock;

use axum::Router;
use axum::http::HeaderMap;
use axum::http::header::CACHE_CONTROL;
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::get;
use rust_embed::RustEmbed;

use crate::http::conditional_response::Conditions;
use crate::http::embedded_files::{EmbeddedFiles, embedded_files};
use crate::http::error::HttpError;
use crate::http::extractors::PathParameter;
use crate::http::security_headers;

#[derive(RustEmbed)]
#[folder = "$OUT_DIR/guide"]
struct Folder;

static FILES: LazyLock<EmbeddedFiles> = LazyLock::new(embedded_files::<Folder>);

const NO_GUIDE: &str =
    "This binary was built without the guide. Build it in the repository, without VERNE_GUIDE=skip.\n";

/// Browsers ask each time whether a file has changed: its address is the same in every version of the binary.
const REVALIDATED: &str = "no-cache";

/// The routes of the guide's pages and of the files that they load.
pub(crate) fn routes<S: Clone + Send + Sync + 'static>() -> Router<S> {
    let routes = Router::new()
        // The links of a page are relative to its folder.
        .route("/guide", get(async || Redirect::permanent("/guide/")))
        .route("/guide/", get(first_page))
        .route("/guide/{*path}", get(file));
    security_headers::pages(routes, security_headers::GUIDE)
}

async fn first_page(headers: HeaderMap, conditions: Conditions) -> Result<Response, HttpError> {
    match FILES.get("index.html") {
        Some(page) => Ok(page.respond(&headers, &conditions, REVALIDATED).await?),
        None => Ok(([(CACHE_CONTROL, REVALIDATED)], NO_GUIDE).into_response()),
    }
}

async fn file(
    PathParameter(path): PathParameter,
    headers: HeaderMap,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let file = FILES.get(path.as_str()).ok_or(HttpError::UnknownPath)?;
    Ok(file.respond(&headers, &conditions, REVALIDATED).await?)
}

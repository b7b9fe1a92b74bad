//! The viewer's files, embedded by the build script; without them, one sentence in their place.

use axum::Router;
use axum::extract::Path;
use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, ETAG};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use headers::{ETag, HeaderMapExt, IfNoneMatch};
use rust_embed::{EmbeddedFile, RustEmbed};

use crate::browsers;
use crate::delivery::FOR_EVER;
use crate::error::Error;

#[derive(RustEmbed)]
#[folder = "$OUT_DIR/viewer"]
struct Files;

const NO_VIEWER: &str = "This verne was built without its viewer, which needs Node.js 20.19 or later with npm: install them \
                         and run `touch src/service/build.rs && cargo build --release`; the API is complete, see \
                         /docs.\n";

/// The page and the files it loads.
pub(crate) fn routes<S: Clone + Send + Sync + 'static>() -> Router<S> {
    browsers::pages(Router::new().route("/", get(page)).route("/assets/{name}", get(asset)), browsers::VIEWER)
}

/// The page names the files of its own build: it is asked for anew each time.
async fn page(headers: HeaderMap) -> Response {
    let Some(file) = Files::get("index.html") else {
        return ([(CACHE_CONTROL, "no-cache")], NO_VIEWER).into_response();
    };
    let tag = format!("\"{}\"", blake3::hash(&file.data).to_hex().as_str().get(..32).unwrap_or_default());
    let condition = headers.typed_get::<IfNoneMatch>();
    let known = tag
        .parse::<ETag>()
        .is_ok_and(|tag| condition.is_some_and(|condition| !condition.precondition_passes(&tag)));
    let about = [(CACHE_CONTROL, "no-cache"), (ETAG, &tag)];
    if known {
        return (StatusCode::NOT_MODIFIED, about).into_response();
    }
    (about, whole(file)).into_response()
}

/// Names hold a hash of the content. No entity tag: it would keep the file from being compressed on the way.
async fn asset(Path(name): Path<String>) -> Result<Response, Error> {
    let file = Files::get(&format!("assets/{name}")).ok_or(Error::NoSuchPath)?;
    Ok(([(CACHE_CONTROL, FOR_EVER)], whole(file)).into_response())
}

fn whole(file: EmbeddedFile) -> Response {
    let media = file.metadata.mimetype().to_owned();
    let media = if media.starts_with("text/") { media + "; charset=utf-8" } else { media };
    ([(CONTENT_TYPE, media)], file.data.into_owned()).into_response()
}

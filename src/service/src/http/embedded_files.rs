//! Files that the build script writes and the binary contains.

use std::borrow::Cow;
use std::collections::HashMap;

use axum::body::Bytes;
use axum::http::HeaderValue;
use rust_embed::{EmbeddedFile, RustEmbed};

use crate::http::static_content::StaticContent;

/// The files of a folder by path.
pub(crate) type EmbeddedFiles = HashMap<Cow<'static, str>, StaticContent>;

/// The files of a folder, with their media types.
pub(crate) fn embedded_files<Folder: RustEmbed>() -> EmbeddedFiles {
    Folder::iter().filter_map(|path| Some((path.clone(), static_content(Folder::get(&path)?)))).collect()
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

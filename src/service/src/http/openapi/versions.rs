//! The OpenAPI document in each version, as the service sends it.

use std::borrow::Cow;

use axum::http::HeaderValue;
use serde_json::Value;
use tokio::sync::OnceCell;

use crate::http::openapi::version_3_0::to_3_0;
use crate::http::proxy::BasePath;
use crate::http::static_content::StaticContent;
use crate::operations::compute_pool::run_on_pool;
use crate::wire::error::OperationError;
use crate::wire::openapi_version::OpenapiVersion;

/// The OpenAPI document that the service sends: the committed file. A test compares it with the generated document,
/// whose examples take too long to compute at every start.
const DOCUMENT: &str = include_str!("../../../../../openapi/openapi.json");

/// The URL of the service in the document.
const SERVER: &str = "\"url\": \"/\"";

/// The address of the guide in the document.
const GUIDE: &str = "\"/guide/\"";

/// The document of a service below a base path.
pub(crate) struct Documents {
    text: Cow<'static, str>,
    version_3_1: StaticContent,
    /// Converted at the first request.
    version_3_0: OnceCell<StaticContent>,
}

impl Documents {
    /// The document of a service below a base path.
    pub(crate) fn new(base: &BasePath) -> Self {
        let text = match base.as_str() {
            "" => Cow::Borrowed(DOCUMENT),
            base => {
                let guide = format!("\"{base}/guide/\"");
                Cow::Owned(
                    DOCUMENT.replacen(SERVER, &SERVER.replace('/', base), 1).replacen(GUIDE, &guide, 1),
                )
            }
        };
        let version_3_1 = content(text.clone().into_owned());
        Self { text, version_3_1, version_3_0: OnceCell::new() }
    }

    /// The document in this version.
    pub(crate) async fn version(&self, version: OpenapiVersion) -> Result<&StaticContent, OperationError> {
        match version {
            OpenapiVersion::V3_1 => Ok(&self.version_3_1),
            OpenapiVersion::V3_0 => {
                let text = self.text.clone();
                let convert = || run_on_pool(move |_| converted(&text));
                self.version_3_0.get_or_try_init(convert).await
            }
        }
    }
}

fn converted(text: &str) -> Result<StaticContent, OperationError> {
    let document: Value = serde_json::from_str(text).map_err(|_| OperationError::Internal)?;
    Ok(content(format!("{:#}", to_3_0(document))))
}

fn content(text: String) -> StaticContent {
    let hash = blake3::hash(text.as_bytes());
    StaticContent::new(text.into(), HeaderValue::from_static("application/json"), hash)
}

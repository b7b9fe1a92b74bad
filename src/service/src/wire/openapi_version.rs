//! The query of the OpenAPI document.

use serde::Deserialize;
use utoipa::{IntoParams, ToSchema};

/// Parameters of GET /openapi.json.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct OpenapiQuery {
    /// Version of OpenAPI: 3.1, or 3.0 for generators that do not read 3.1.
    #[serde(default)]
    #[param(inline)]
    pub v: OpenapiVersion,
}

/// Version of OpenAPI.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, ToSchema)]
#[schema(default = "3.1")]
pub(crate) enum OpenapiVersion {
    /// OpenAPI 3.1.
    #[default]
    #[serde(rename = "3.1")]
    V3_1,
    /// OpenAPI 3.0.3.
    #[serde(rename = "3.0")]
    V3_0,
}

//! The request of `POST /toolpath`: JSON, or a file with the other fields in the query.

use axum::extract::{FromRequest, Request};
use axum::http::HeaderMap;
use axum::http::header::CONTENT_TYPE;
use form_urlencoded::Serializer;
use utoipa::IntoParams;

use crate::http::error::HttpError;
use crate::http::extractors::{BatchBody, is_json};
use crate::http::program_body::ProgramBody;
use crate::http::state::SharedState;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::program_query::ProgramQuery;
use crate::wire::query_string::parse_query;
use crate::wire::toolpath_query::ToolpathQuery;

/// The request, whose body is not read yet.
pub(crate) enum ToolpathBody {
    /// A request in JSON.
    Json(BatchBody),
    /// The program is the body.
    File(Box<FileRequest>),
}

/// A request whose program is the body.
pub(crate) struct FileRequest {
    /// How the program is read.
    pub reading: ProgramQuery,
    /// The other fields.
    pub query: ToolpathQuery,
    /// The program.
    pub body: ProgramBody,
}

impl FromRequest<SharedState> for ToolpathBody {
    type Rejection = HttpError;

    async fn from_request(request: Request, state: &SharedState) -> Result<Self, HttpError> {
        let query = request.uri().query().unwrap_or_default().to_owned();
        if declares_json(request.headers()) && !names(&query).any(|name| name == "format") {
            refuse_parameters(&query)?;
            return BatchBody::from_request(request, state).await.map(Self::Json);
        }
        FileRequest::from_request(request, state).await.map(|file| Self::File(Box::new(file)))
    }
}

impl FromRequest<SharedState> for FileRequest {
    type Rejection = HttpError;

    async fn from_request(request: Request, state: &SharedState) -> Result<Self, HttpError> {
        let [reading, options] = divided(request.uri().query().unwrap_or_default());
        let (reading, query) = (parse_query(&reading)?, parse_query(&options)?);
        let body = ProgramBody::from_request(request, state).await?;
        Ok(Self { reading, query, body })
    }
}

fn declares_json(headers: &HeaderMap) -> bool {
    headers.get(CONTENT_TYPE).and_then(|declared| declared.to_str().ok()).is_some_and(is_json)
}

fn names(query: &str) -> impl Iterator<Item = String> {
    form_urlencoded::parse(query.as_bytes()).map(|(name, _)| name.into_owned())
}

/// A request in JSON has all its fields in the body.
fn refuse_parameters(query: &str) -> Result<(), OperationError> {
    let faults: Vec<FieldError> = names(query)
        .map(|name| {
            let detail =
                "is a field of the JSON body; parameters are for a program as the body, with format=";
            FieldError::new(format!("/query/{name}"), detail)
        })
        .collect();
    if faults.is_empty() { Ok(()) } else { Err(OperationError::Fields(faults)) }
}

/// The parameters for reading the program, and the others.
fn divided(query: &str) -> [String; 2] {
    let reading = ProgramQuery::into_params(|| None);
    let (of_reading, others): (Vec<_>, Vec<_>) = form_urlencoded::parse(query.as_bytes())
        .partition(|(name, _)| reading.iter().any(|parameter| parameter.name == *name));
    [of_reading, others].map(|pairs| Serializer::new(String::new()).extend_pairs(pairs).finish())
}

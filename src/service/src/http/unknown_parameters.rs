//! Rejects query parameters that an operation does not document.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::Method;
use axum::middleware::{Next, from_fn_with_state};
use axum::response::Response;
use axum::routing::MethodRouter;
use utoipa::openapi::path::{Operation, ParameterIn};
use utoipa::openapi::{Paths, RefOr};

use crate::http::error::HttpError;
use crate::http::state::SharedState;
use crate::wire::error::{FieldError, OperationError};

/// Most unknown parameters that one response lists.
const MOST_LISTED: usize = 10;

/// The query parameters of each method of a path.
type Known = Vec<(Method, Vec<String>)>;

/// The route, which rejects parameters that the operations of its path do not have.
pub(crate) fn reject_unknown(route: MethodRouter<SharedState>, paths: &Paths) -> MethodRouter<SharedState> {
    let methods = paths.paths.values().flat_map(|item| {
        [
            (Method::GET, &item.get),
            (Method::HEAD, &item.get),
            (Method::POST, &item.post),
            (Method::DELETE, &item.delete),
        ]
    });
    let known: Known =
        methods.filter_map(|(method, operation)| Some((method, names(operation.as_ref()?)))).collect();
    route.layer(from_fn_with_state(Arc::new(known), check))
}

fn names(operation: &Operation) -> Vec<String> {
    let parameters = operation.parameters.iter().flatten();
    parameters
        .filter_map(|parameter| match parameter {
            RefOr::T(parameter) if parameter.parameter_in == ParameterIn::Query => {
                Some(parameter.name.clone())
            }
            _ => None,
        })
        .collect()
}

async fn check(State(known): State<Arc<Known>>, request: Request, next: Next) -> Result<Response, HttpError> {
    let names = known.iter().find(|(method, _)| method == request.method()).map(|(_, names)| names);
    if let (Some(names), Some(query)) = (names, request.uri().query()) {
        check_query(query, names, request.method())?;
    }
    Ok(next.run(request).await)
}

fn check_query(query: &str, known: &[String], method: &Method) -> Result<(), OperationError> {
    let mut unknown = Vec::new();
    for (name, _) in form_urlencoded::parse(query.as_bytes()) {
        if unknown.len() < MOST_LISTED
            && !known.iter().any(|known| *known == name)
            && !unknown.contains(&name)
        {
            unknown.push(name);
        }
    }
    if unknown.is_empty() {
        return Ok(());
    }
    let expected = match known {
        [] if method == Method::POST => "POST takes its fields in the body".to_owned(),
        [] => "this operation has no query parameters".to_owned(),
        known => format!("the parameters of this operation are {}", known.join(", ")),
    };
    let error = |name| FieldError::new(format!("/query/{name}"), format!("`{name}` is unknown: {expected}"));
    Err(OperationError::Fields(unknown.into_iter().map(error).collect()))
}

//! Parses query strings into requests.

use form_urlencoded::Serializer;
use serde::de::DeserializeOwned;
use utoipa::IntoParams;
use utoipa::openapi::Required;
use utoipa::openapi::path::Parameter;

use crate::wire::error::{FieldError, OperationError};
use crate::wire::parse::pointer;

/// Parses a query string. A list is `name=1,2`, `name=1&name=2` or `name=[1,2]`.
pub(crate) fn parse_query<T: DeserializeOwned + IntoParams>(query: &str) -> Result<T, OperationError> {
    // Nearly every query parses at once. Only another one is compared with the parameters.
    read(query).or_else(|_| {
        let parameters = T::into_params(|| None);
        let missing = missing(query, &parameters);
        if missing.is_empty() {
            read(&with_plain_lists(query, &parameters))
        } else {
            Err(OperationError::Fields(missing))
        }
    })
}

fn read<T: DeserializeOwned>(query: &str) -> Result<T, OperationError> {
    let pairs = serde_urlencoded::Deserializer::new(form_urlencoded::parse(query.as_bytes()));
    serde_path_to_error::deserialize(pairs).map_err(|error| {
        let message = error.inner().to_string();
        let pointer = format!("/query{}", pointer(error.path(), &message));
        let detail = required_value(&message).map_or(message, str::to_owned);
        OperationError::Fields(vec![FieldError::new(pointer, detail)])
    })
}

/// What a parameter must be, if the standard library could not read its text.
fn required_value(message: &str) -> Option<&'static str> {
    match message {
        "invalid float literal" | "cannot parse float from empty string" => Some("must be a number"),
        "invalid digit found in string" | "cannot parse integer from empty string" => {
            Some("must be a whole number, not negative")
        }
        "number too large to fit in target type" => Some("must be a smaller whole number"),
        "provided string was not `true` or `false`" => Some("must be true or false"),
        _ => None,
    }
}

fn missing(query: &str, parameters: &[Parameter]) -> Vec<FieldError> {
    let given = |name: &str| form_urlencoded::parse(query.as_bytes()).any(|(given, _)| given == name);
    parameters
        .iter()
        .filter(|parameter| parameter.required == Required::True && !given(&parameter.name))
        .map(|parameter| FieldError::missing(format!("/query/{}", parameter.name), &parameter.name))
        .collect()
}

/// The query with the items of each list joined by commas, where the list begins.
fn with_plain_lists(query: &str, parameters: &[Parameter]) -> String {
    let mut pairs: Vec<(String, String)> = Vec::new();
    for (name, value) in form_urlencoded::parse(query.as_bytes()) {
        if !parameters.iter().any(|parameter| is_list(parameter) && parameter.name == name) {
            pairs.push((name.into_owned(), value.into_owned()));
            continue;
        }
        let bare = value.trim().strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        let items = bare.unwrap_or(&value);
        match pairs.iter_mut().find(|(known, _)| *known == name) {
            Some((_, list)) => *list = format!("{list},{items}"),
            None => pairs.push((name.into_owned(), items.to_owned())),
        }
    }
    Serializer::new(String::new()).extend_pairs(pairs).finish()
}

/// Whether the OpenAPI document states that commas separate items.
fn is_list(parameter: &Parameter) -> bool {
    parameter.explode == Some(false)
}

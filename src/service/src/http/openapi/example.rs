//! An example of an operation: a request, and the answer that the solver computes.

use std::fmt::Display;

use serde::Serialize;
use serde_json::{Value, json};

use crate::wire::error::OperationError;
use crate::wire::parse::parse_body;

/// The program of the examples.
pub(crate) const PROGRAM: &str = "PARTNO/COVER\nUNITS/MM\nLOADTL/3,LENGTH,120\nSPINDL/RPM,6000,CLW\nRAPID\n\
    GOTO/0,0,350,0,0,1\nFEDRAT/800,MMPM\nGOTO/0,0,300\nGOTO/80,0,300,0,0.6,0.8\nFINI\n";

/// A request that the tests send, and its answer.
pub(crate) struct Example {
    pub(crate) method: &'static str,
    pub(crate) path: &'static str,
    /// The body of POST, or the values of path and query parameters.
    pub(crate) request: Value,
    /// The file that a POST sends; `request` are its parameters then.
    pub(crate) file: Option<&'static str>,
    /// `None` for answers that are long or not JSON.
    pub(crate) answer: Option<Value>,
}

impl Example {
    /// Writes request and answer into the operation.
    pub(crate) fn write_into(self, document: &mut Value) {
        let Some(operation) = document["paths"][self.path].get_mut(self.method) else { return };
        if self.method == "post" && self.file.is_none() {
            operation["requestBody"]["content"]["application/json"]["example"] = self.request;
        } else {
            if let Some(file) = self.file {
                operation["requestBody"]["content"]["application/octet-stream"]["example"] = json!(file);
            }
            let parameters = operation.get_mut("parameters").and_then(Value::as_array_mut);
            for parameter in parameters.into_iter().flatten() {
                if let Some(value) = parameter["name"].as_str().and_then(|name| self.request.get(name)) {
                    parameter["example"] = value.clone();
                }
            }
        }
        let Some(answer) = self.answer else { return };
        for status in ["200", "201"] {
            if let Some(response) = operation["responses"].get_mut(status) {
                response["content"]["application/json"]["example"] = answer.clone();
            }
        }
    }
}

/// A GET request.
pub(crate) fn get(path: &'static str, request: Value, answer: Option<Value>) -> Example {
    Example { method: "get", path, request, file: None, answer }
}

/// A POST request with JSON.
pub(crate) fn post<T: Serialize>(
    path: &'static str,
    request: Value,
    answer: impl Fn(&[u8]) -> Result<T, OperationError>,
) -> Example {
    let answer = Some(json_of(answer(request.to_string().as_bytes())));
    Example { method: "post", path, request, file: None, answer }
}

/// The answer as JSON, or the error, which the tests report as an outdated example.
pub(crate) fn json_of(answer: Result<impl Serialize, impl Display>) -> Value {
    answer.map_or_else(|error| json!({"error": error.to_string()}), |answer| json!(answer))
}

/// An answer that was written as JSON.
pub(crate) fn value_of(json: Result<Vec<u8>, OperationError>) -> Result<Value, OperationError> {
    parse_body(&json?)
}

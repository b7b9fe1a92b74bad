//! The answer of `verne machine`.

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::values::text_at;

/// The dimensions and limits of a machine, under the names that its file has.
pub(crate) fn machine(definition: &Value) -> Page {
    let page = Page::new(text_at(definition, "/name")).sentence(text_at(definition, "/description"));
    let parts = definition.as_object().into_iter().flatten();
    let page = parts
        .filter(|(_, part)| part.is_object())
        .fold(page, |page, (name, part)| page.heading(name.as_str()).fields(fields("", part)));
    page.sentence("Lengths in mm, angles in degrees. A file for --machine: verne machine NAME > FILE.json")
}

/// The numbers below a value with their names.
fn fields(name: &str, value: &Value) -> Vec<(String, String)> {
    let inside = |inner: &str| if name.is_empty() { inner.to_owned() } else { format!("{name}.{inner}") };
    match value {
        Value::Object(object) => {
            object.iter().flat_map(|(inner, value)| fields(&inside(inner), value)).collect()
        }
        Value::Array(list) if list.iter().any(Value::is_array) => {
            let numbered = list.iter().zip(1..).map(|(value, number)| (inside(&number.to_string()), value));
            numbered.flat_map(|(name, value)| fields(&name, value)).collect()
        }
        Value::Array(list) => {
            let separator = if list.len() == 2 { " to " } else { ", " };
            let numbers: Vec<_> = list.iter().map(number).collect();
            vec![(name.to_owned(), numbers.join(separator))]
        }
        Value::Null => vec![(name.to_owned(), "unlimited".to_owned())],
        other => vec![(name.to_owned(), number(other))],
    }
}

/// `100` of the JSON number 100.0.
fn number(value: &Value) -> String {
    value.as_f64().map_or_else(|| value.to_string(), |number| number.to_string())
}

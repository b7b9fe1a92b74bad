//! The reference of the API, from the OpenAPI document: a chapter of the guide never says what the service does not do.

use std::fmt::Write;
use std::path::Path;

use serde_json::Value;

use crate::guide::read;

/// The document.
pub(crate) struct Reference(Value);

const METHODS: [&str; 3] = ["get", "post", "delete"];

impl Reference {
    pub(crate) fn read(file: &Path) -> Result<Self, String> {
        let document = serde_json::from_str(&read(file)?).map_err(|error| error.to_string())?;
        Ok(Self(document))
    }

    /// The text of a chapter with the lists of operations and types in their places.
    pub(crate) fn written_into(&self, chapter: &str) -> String {
        let mut written = chapter.to_owned();
        let lists = [
            ("<!-- operations -->", Self::operations as fn(&Self) -> String),
            ("<!-- types -->", Self::types),
            ("<!-- machine -->", Self::machine),
        ];
        for (place, list) in lists {
            if written.contains(place) {
                written = written.replace(place, &list(self));
            }
        }
        written
    }

    fn operations(&self) -> String {
        let mut written = String::new();
        for tag in items(&self.0["tags"]) {
            let name = text(&tag["name"]);
            let _ = write!(written, "## {name}\n\n{}\n\n", text(&tag["description"]));
            for (path, methods) in fields(&self.0["paths"]) {
                for method in METHODS {
                    let operation = &methods[method];
                    if items(&operation["tags"]).any(|of| text(of) == name) {
                        self.operation(&mut written, method, path, operation);
                    }
                }
            }
        }
        written
    }

    fn operation(&self, written: &mut String, method: &str, path: &str, operation: &Value) {
        let _ = write!(written, "### {} `{path}`\n\n", method.to_uppercase());
        for part in ["summary", "description"] {
            let _ = write!(written, "{}\n\n", text(&operation[part]));
        }
        let parameters: Vec<_> =
            items(&operation["parameters"]).map(|parameter| self.resolved(parameter)).collect();
        if !parameters.is_empty() {
            *written += "| parameter | in | type | meaning |\n|---|---|---|---|\n";
            for parameter in parameters {
                let required = if parameter["required"] == true { ", required" } else { "" };
                let _ = writeln!(
                    written,
                    "| `{}` | {}{required} | {} | {} |",
                    text(&parameter["name"]),
                    text(&parameter["in"]),
                    kind(&parameter["schema"]),
                    cell(text(&parameter["description"])),
                );
            }
            *written += "\n";
        }
        let body = contents(&self.resolved(&operation["requestBody"])["content"]);
        if !body.is_empty() {
            let _ = write!(written, "Body: {body}\n\n");
        }
        *written += "| status | answer |\n|---|---|\n";
        for (status, answer) in fields(&operation["responses"]) {
            let answer = self.resolved(answer);
            let contents = contents(&answer["content"]);
            let separator = if contents.is_empty() { "" } else { ": " };
            let _ = writeln!(
                written,
                "| {status} | {}{separator}{contents} |",
                cell(text(&answer["description"]))
            );
        }
        *written += "\n";
    }

    fn types(&self) -> String {
        let mut written = String::new();
        for (name, schema) in fields(&self.0["components"]["schemas"]) {
            let _ = write!(written, "## {name}\n\n{}\n\n", text(&schema["description"]));
            let required: Vec<_> = items(&schema["required"]).map(text).collect();
            let properties: Vec<_> = fields(&schema["properties"]).collect();
            if properties.is_empty() {
                let _ = write!(written, "{}\n\n", kind(schema));
                continue;
            }
            written += "| field | type | meaning |\n|---|---|---|\n";
            for (field, property) in properties {
                let mark = if required.contains(&field) { "" } else { ", optional" };
                let meaning = cell(text(&property["description"]));
                let _ = writeln!(written, "| `{field}` | {}{mark} | {meaning} |", kind(property));
            }
            written += "\n";
        }
        written
    }

    fn machine(&self) -> String {
        let mut written = "| field | type | meaning |\n|---|---|---|\n".to_owned();
        nested_fields(&mut written, "", &self.0["components"]["schemas"]["Machine"]);
        written
    }

    /// The object to which a reference leads.
    fn resolved<'a>(&'a self, value: &'a Value) -> &'a Value {
        let pointer = value["$ref"].as_str().and_then(|reference| reference.strip_prefix('#'));
        pointer.and_then(|pointer| self.0.pointer(pointer)).unwrap_or(value)
    }
}

/// A row for each field of an object, and for the fields of objects in it.
fn nested_fields(written: &mut String, above: &str, schema: &Value) {
    for (field, property) in fields(&schema["properties"]) {
        let name = format!("{above}{field}");
        let inner =
            items(&property["oneOf"]).chain([property]).find(|schema| !schema["properties"].is_null());
        let kind = if inner.is_some() { "object".to_owned() } else { kind(property) };
        let description = text(&property["description"]);
        let description = if description.is_empty() {
            text(&inner.unwrap_or(property)["description"])
        } else {
            description
        };
        let _ = writeln!(written, "| `{name}` | {kind} | {} |", cell(description));
        if let Some(inner) = inner {
            nested_fields(written, &format!("{name}."), inner);
        }
    }
}

/// The media types of a body with their schemas.
fn contents(content: &Value) -> String {
    let types: Vec<_> =
        fields(content).map(|(media, content)| format!("`{media}`, {}", kind(&content["schema"]))).collect();
    types.join("; ")
}

/// The type of a schema, as a link if it has a name.
fn kind(schema: &Value) -> String {
    if let Some(reference) = schema["$ref"].as_str() {
        let name = reference.rsplit('/').next().unwrap_or(reference);
        return format!("[{name}](types.md#{})", name.to_lowercase());
    }
    for (join, between) in [("oneOf", " or "), ("anyOf", " or "), ("allOf", " and ")] {
        if !schema[join].is_null() {
            let kinds: Vec<_> = items(&schema[join]).map(kind).collect();
            return kinds.join(between);
        }
    }
    if !schema["enum"].is_null() {
        return items(&schema["enum"])
            .map(|value| format!("`{}`", value.to_string().trim_matches('"')))
            .collect::<Vec<_>>()
            .join(", ");
    }
    let mut kind = match &schema["type"] {
        Value::Array(kinds) => kinds.iter().map(text).collect::<Vec<_>>().join(" or "),
        kind => text(kind).to_owned(),
    };
    if !schema["items"].is_null() {
        kind = format!("{kind} of {}", self::kind(&schema["items"]));
    }
    if !schema["default"].is_null() {
        let _ = write!(kind, ", default `{}`", schema["default"].to_string().trim_matches('"'));
    }
    if kind.is_empty() { "any".to_owned() } else { kind }
}

/// A text in a cell of a table.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

fn items(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn fields(value: &Value) -> impl Iterator<Item = (&str, &Value)> {
    value.as_object().into_iter().flatten().map(|(name, value)| (name.as_str(), value))
}

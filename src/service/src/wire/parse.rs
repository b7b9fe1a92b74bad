//! Parses JSON bodies into requests. An error has the pointer of the wrong field.

use serde::Deserialize;
use serde_json::error::Category;
use serde_path_to_error::{Path, Segment};
use utoipa::ToSchema;

use crate::wire::error::{FieldError, OperationError};
use crate::wire::json_pointer::push_segment;
use crate::wire::missing::missing_fields;
use crate::wire::strict_object::StrictObject;

/// The UTF-8 byte order mark, which programs for Windows write before a text.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// How many bytes of a body that is not JSON the error shows.
const SHOWN: usize = 64;

/// Parses a JSON body that holds an object.
pub(crate) fn parse_body<'de, T: Deserialize<'de> + ToSchema>(body: &'de [u8]) -> Result<T, OperationError> {
    let body = without_byte_order_mark(body);
    // Tracking the path costs time on every field: only a body that failed is read again with it.
    serde_json::from_slice(body).map(|StrictObject(request)| request).map_err(|_| explain_body::<T>(body))
}

/// Parses a JSON body that holds an object; nothing if it does not fit. [`parse_body`] explains why.
pub(crate) fn parse_expected<'de, T: Deserialize<'de>>(body: &'de [u8]) -> Option<T> {
    serde_json::from_slice(without_byte_order_mark(body)).map(|StrictObject(request)| request).ok()
}

fn without_byte_order_mark(body: &[u8]) -> &[u8] {
    body.strip_prefix(BYTE_ORDER_MARK).unwrap_or(body)
}

fn explain_body<'de, T: Deserialize<'de> + ToSchema>(body: &'de [u8]) -> OperationError {
    let mut json = serde_json::Deserializer::from_slice(body);
    let Err(error) = serde_path_to_error::deserialize::<_, StrictObject<T>>(&mut json) else {
        let rest = json.end().err();
        return not_json(body, &rest.map_or("trailing characters".to_owned(), |error| error.to_string()));
    };
    let message = error.inner().to_string();
    if let Some(name) = missing_name(&message) {
        let missing = missing_fields::<T>(body);
        let first = || vec![FieldError::missing(pointer(error.path(), &message), name)];
        return OperationError::Fields(if missing.is_empty() { first() } else { missing });
    }
    let detail = if message.starts_with("number out of range") {
        "must be a number that double precision can hold".to_owned()
    } else if is_not_a_number(body, error.inner()) {
        format!("must be a finite number: JSON has no NaN and no infinities ({message})")
    } else if error.inner().classify() == Category::Data {
        message.clone()
    } else {
        return not_json(body, &message);
    };
    OperationError::Fields(vec![FieldError::new(pointer(error.path(), &message), detail)])
}

fn not_json(body: &[u8], reason: &str) -> OperationError {
    if body.is_empty() {
        return OperationError::Syntax("the body is empty".to_owned());
    }
    let shown = body.get(..SHOWN).unwrap_or(body);
    let escaped = shown.escape_ascii().to_string().replace("\\'", "'");
    let more = if shown.len() < body.len() { "..." } else { "" };
    OperationError::Syntax(format!("{reason}; it begins with \"{escaped}\"{more}"))
}

/// Whether the error is at one of the words that other languages write for numbers that JSON does not have.
fn is_not_a_number(body: &[u8], error: &serde_json::Error) -> bool {
    let Some(line) = body.split(|&byte| byte == b'\n').nth(error.line().saturating_sub(1)) else {
        return false;
    };
    let part_of_word = |byte: &u8| byte.is_ascii_alphabetic() || *byte == b'-';
    let at = error.column().saturating_sub(1).min(line.len());
    let start = line[..at].iter().rposition(|byte| !part_of_word(byte)).map_or(0, |before| before + 1);
    let end = line[at..].iter().position(|byte| !part_of_word(byte)).map_or(line.len(), |after| at + after);
    let word = &line[start..end];
    let words: [&[u8]; 6] = [b"NaN", b"-NaN", b"nan", b"Infinity", b"-Infinity", b"inf"];
    words.contains(&word)
}

/// The JSON Pointer of a path. A missing or repeated field is not on the path; the message names it.
pub(crate) fn pointer(path: &Path, message: &str) -> String {
    let mut pointer = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => push_segment(&mut pointer, &index.to_string()),
            Segment::Map { key } => push_segment(&mut pointer, key),
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    if let Some(name) = missing_name(message).or_else(|| quoted(message, "duplicate field `")) {
        push_segment(&mut pointer, name);
    }
    pointer
}

/// The field that is missing, if that is what the parser says.
fn missing_name(message: &str) -> Option<&str> {
    quoted(message, "missing field `")
}

fn quoted<'a>(message: &'a str, words: &str) -> Option<&'a str> {
    message.strip_prefix(words)?.split('`').next()
}

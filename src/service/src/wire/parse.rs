//! From bytes to typed requests, with the pointer of what does not fit.

use serde::Deserialize;
use serde_json::error::Category;
use serde_path_to_error::{Path, Segment};

use super::object::Object;
use crate::error::{Error, Fault};

/// Parses a JSON body that holds an object.
pub(crate) fn parse_body<'de, T: Deserialize<'de>>(body: &'de [u8]) -> Result<T, Error> {
    // Tracking the path costs time on every field: only a body that failed is read again with it.
    serde_json::from_slice(body).map(|Object(request)| request).map_err(|_| explain_body::<T>(body))
}

/// Parses a JSON body that holds an object, if it is as expected; [`parse_body`] says what else it is.
pub(crate) fn parse_usual<'de, T: Deserialize<'de>>(body: &'de [u8]) -> Option<T> {
    serde_json::from_slice(body).map(|Object(request)| request).ok()
}

/// Parses a query string.
pub(crate) fn parse_query<'de, T: Deserialize<'de>>(query: &'de str) -> Result<T, Error> {
    let pairs = serde_urlencoded::Deserializer::new(form_urlencoded::parse(query.as_bytes()));
    serde_path_to_error::deserialize(pairs).map_err(|error| {
        let message = error.inner().to_string();
        let pointer = format!("/query{}", pointer(error.path(), &message));
        Error::Fields(vec![Fault::new(pointer, message)])
    })
}

fn explain_body<'de, T: Deserialize<'de>>(body: &'de [u8]) -> Error {
    let mut json = serde_json::Deserializer::from_slice(body);
    let Err(error) = serde_path_to_error::deserialize::<_, Object<T>>(&mut json) else {
        let rest = json.end().err();
        return Error::Syntax(rest.map_or("trailing characters".to_owned(), |error| error.to_string()));
    };
    let message = error.inner().to_string();
    let detail = if message.starts_with("number out of range") {
        "must be a number that double precision can hold".to_owned()
    } else if is_not_a_number(body, error.inner()) {
        format!("must be a finite number: JSON has no NaN and no infinities ({message})")
    } else if error.inner().classify() == Category::Data {
        message.clone()
    } else {
        return Error::Syntax(message);
    };
    Error::Fields(vec![Fault::new(pointer(error.path(), &message), detail)])
}

/// Whether the parser stumbled over one of the words that other languages write for numbers that
/// JSON does not have.
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
fn pointer(path: &Path, message: &str) -> String {
    let mut pointer = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => push(&mut pointer, &index.to_string()),
            Segment::Map { key } => push(&mut pointer, key),
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    let named = ["missing field `", "duplicate field `"].iter().find_map(|words| message.strip_prefix(words));
    if let Some(name) = named.and_then(|rest| rest.split('`').next()) {
        push(&mut pointer, name);
    }
    pointer
}

fn push(pointer: &mut String, part: &str) {
    pointer.push('/');
    pointer.push_str(&part.replace('~', "~0").replace('/', "~1"));
}

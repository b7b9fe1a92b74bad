//! Lists of G and M codes in query strings and on the command line.

use std::borrow::Cow;
use std::str::FromStr;

use serde::de::Error;
use serde::{Deserialize, Deserializer};
use utoipa::openapi::schema::{ArrayBuilder, ObjectBuilder, Type};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};
use verne_program::Code;

/// Most codes in one list.
const MOST_CODES: usize = 20;

/// Codes such as `M428`, separated by commas. They may have quotation marks, as in JSON.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct CodeList(pub Vec<Code>);

impl FromStr for CodeList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let code = |item: &str| item.trim().trim_matches('"').parse::<Code>();
        let codes = text.split(',').map(code).collect::<Result<Vec<_>, _>>()?;
        if codes.len() <= MOST_CODES { Ok(Self(codes)) } else { Err(format!("at most {MOST_CODES} codes")) }
    }
}

impl<'de> Deserialize<'de> for CodeList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Cow::<'de, str>::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl PartialSchema for CodeList {
    fn schema() -> RefOr<Schema> {
        let code =
            ObjectBuilder::new().schema_type(Type::String).pattern(Some("^[GM][0-9]{1,5}(\\.[0-9])?$"));
        ArrayBuilder::new().items(code).min_items(Some(1)).max_items(Some(MOST_CODES)).into()
    }
}

impl ToSchema for CodeList {}

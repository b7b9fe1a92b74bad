//! JSON values in query parameters and on the command line.

use std::borrow::Cow;
use std::str::FromStr;

use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};

use crate::wire::parse::pointer;

/// A value that is written as JSON in a text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JsonText<T>(pub T);

impl<T: DeserializeOwned> FromStr for JsonText<T> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut json = serde_json::Deserializer::from_str(text);
        let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
            let message = error.inner().to_string();
            match pointer(error.path(), &message) {
                place if place.is_empty() => message,
                place => format!("{place}: {message}"),
            }
        })?;
        json.end().map_err(|error| error.to_string())?;
        Ok(Self(value))
    }
}

impl<'de, T: DeserializeOwned> Deserialize<'de> for JsonText<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Cow::<'de, str>::deserialize(deserializer)?;
        text.parse().map_err(D::Error::custom)
    }
}

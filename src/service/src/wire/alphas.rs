//! The lines of constant alpha in a slice.

use std::borrow::Cow;
use std::str::FromStr;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use utoipa::openapi::schema::{ObjectBuilder, Type};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

/// Most lines in one slice.
const MAX_LINES: usize = 100;

/// `false`, `true` (every five degrees), or the angles in degrees, separated by commas.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Alphas {
    /// None.
    #[default]
    None,
    /// Every five degrees within the workspace.
    EqualSteps,
    /// List, in degrees.
    List(Vec<f64>),
}

impl FromStr for Alphas {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "false" => return Ok(Self::None),
            "true" => return Ok(Self::EqualSteps),
            _ => {}
        }
        let angle = |item: &str| {
            let angle = item.trim().parse::<f64>().ok().filter(|angle| angle.abs() <= 180.0);
            angle.ok_or_else(|| {
                format!(
                    "{item:?} is not an angle within ±180 degrees; expected true, false or angles separated by commas"
                )
            })
        };
        let angles = text.split(',').map(angle).collect::<Result<Vec<f64>, _>>()?;
        if angles.len() <= MAX_LINES {
            Ok(Self::List(angles))
        } else {
            Err(format!("at most {MAX_LINES} angles"))
        }
    }
}

impl<'de> Deserialize<'de> for Alphas {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Cow::<'de, str>::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl PartialSchema for Alphas {
    fn schema() -> RefOr<Schema> {
        let number = r"-?[0-9]{1,2}(\.[0-9]{1,9})?";
        let pattern = format!("^(true|false|{number}(,{number}){{0,99}})$");
        ObjectBuilder::new().schema_type(Type::String).pattern(Some(pattern)).into()
    }
}

impl ToSchema for Alphas {}

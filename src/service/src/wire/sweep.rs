//! The values of a parameter: one number, a list of numbers, or equal steps.

use std::borrow::Cow;
use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use utoipa::openapi::schema::{AnyOfBuilder, ArrayBuilder, ArrayItems};
use utoipa::openapi::{Ref, RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

/// A number, a list of numbers, or equal steps from one number to another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Sweep {
    /// One number.
    One(f64),
    /// These numbers.
    List(Vec<f64>),
    /// Equal steps.
    Steps(Steps),
}

/// Equal steps: from, from + step, ... up to `to`. The last number may exceed `to` by a billionth of a step.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Steps {
    /// The first number.
    pub from: f64,
    /// The upper bound.
    pub to: f64,
    /// Step, greater than zero.
    #[schema(exclusive_minimum = 0)]
    pub step: f64,
}

impl PartialSchema for Sweep {
    fn schema() -> RefOr<Schema> {
        let list =
            ArrayBuilder::new().items(ArrayItems::RefOrSchema(Box::new(f64::schema()))).min_items(Some(1));
        let schemas = [f64::schema(), list.into(), Ref::from_schema_name("Steps").into()];
        let any = schemas.into_iter().fold(AnyOfBuilder::new(), AnyOfBuilder::item);
        any.description(Some("A number, a list of numbers, or equal steps from one number to another."))
            .into()
    }
}

impl ToSchema for Sweep {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("Span")
    }

    fn schemas(schemas: &mut Vec<(String, RefOr<Schema>)>) {
        schemas.push(("Steps".to_owned(), Steps::schema()));
    }
}

impl Default for Sweep {
    fn default() -> Self {
        Self::One(0.0)
    }
}

impl Sweep {
    /// The numbers, at least one and at most `most`.
    pub(crate) fn numbers(&self, most: usize) -> Result<Vec<f64>, String> {
        match self {
            Self::One(number) => Ok(vec![*number]),
            Self::List(numbers) if (1..=most).contains(&numbers.len()) => Ok(numbers.clone()),
            Self::List(numbers) => Err(format!("must have 1 to {most} numbers, not {}", numbers.len())),
            Self::Steps(steps) => steps.numbers(most),
        }
    }
}

impl Steps {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to `most`")]
    fn numbers(self, most: usize) -> Result<Vec<f64>, String> {
        let Self { from, to, step } = self;
        let steps = ((to - from) / step + 1e-9).floor();
        if !(step > 0.0 && steps >= 0.0) {
            return Err(
                "must run from the lesser number to the greater in steps greater than zero".to_owned()
            );
        }
        #[expect(clippy::cast_precision_loss, reason = "a bound on a count")]
        if steps >= most as f64 {
            return Err(format!("must have at most {most} steps, not {}", steps + 1.0));
        }
        Ok((0..=steps as u32).map(|i| from + f64::from(i) * step).collect())
    }
}

impl<'de> Deserialize<'de> for Sweep {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrMany)
    }
}

/// Decides by the JSON type: an error inside a list or an object then has its pointer.
struct OneOrMany;

impl<'de> Visitor<'de> for OneOrMany {
    type Value = Sweep;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, a list of numbers or {from, to, step}")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Sweep, E> {
        Ok(Sweep::One(number))
    }

    #[expect(clippy::cast_precision_loss, reason = "serde rounds integers to doubles as well")]
    fn visit_u64<E: Error>(self, number: u64) -> Result<Sweep, E> {
        Ok(Sweep::One(number as f64))
    }

    #[expect(clippy::cast_precision_loss, reason = "serde rounds integers to doubles as well")]
    fn visit_i64<E: Error>(self, number: i64) -> Result<Sweep, E> {
        Ok(Sweep::One(number as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Sweep, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = items.next_element()? {
            numbers.push(number);
        }
        Ok(Sweep::List(numbers))
    }

    fn visit_map<A: MapAccess<'de>>(self, fields: A) -> Result<Sweep, A::Error> {
        Steps::deserialize(MapAccessDeserializer::new(fields)).map(Sweep::Steps)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::Sweep;

    fn numbers(json: &str) -> Result<Vec<f64>, String> {
        serde_json::from_str::<Sweep>(json).map_err(|error| error.to_string())?.numbers(30)
    }

    #[test]
    fn sweeps_become_lists_of_numbers() {
        for (json, expected) in [
            ("5", vec![5.0]),
            ("-0.5", vec![-0.5]),
            ("[50, 1e2]", vec![50.0, 100.0]),
            (r#"{"from": -10, "to": 10, "step": 5}"#, vec![-10.0, -5.0, 0.0, 5.0, 10.0]),
            (r#"{"from": 0, "to": 1, "step": 0.3}"#, vec![0.0, 0.3, 0.6, 0.3 * 3.0]),
            (r#"{"from": 7, "to": 7, "step": 1}"#, vec![7.0]),
        ] {
            assert_eq!(numbers(json), Ok(expected), "{json}");
        }
        let tenths = numbers(r#"{"from": 0, "to": 0.7, "step": 0.1}"#).map(|tenths| tenths.len());
        assert_eq!(tenths, Ok(8), "rounding does not lose the last number");
    }

    #[test]
    fn malformed_sweeps_are_refused() {
        for json in [
            "[]",
            r#"{"from": 0, "to": 1, "step": 0}"#,
            r#"{"from": 0, "to": -1, "step": 1}"#,
            r#"{"from": 0, "to": 1, "step": -1}"#,
            r#"{"from": 0, "to": 1, "step": 1e-9}"#,
            r#"{"from": 0, "to": 1e308, "step": 1e-308}"#,
            r#"{"from": 0, "to": 1}"#,
            r#""5""#,
            "null",
        ] {
            assert!(numbers(json).is_err(), "{json}");
        }
    }
}

//! Parameters of a machine: their names, and their values in mm and degrees.

use std::borrow::Cow;
use std::str::FromStr;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use utoipa::openapi::schema::{ArrayBuilder, ObjectBuilder, Type};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};
use verne_solver::parameter::{Parameter, ParameterUnit};

use crate::wire::constraint::Unit;
use crate::wire::degrees::{from_degrees, to_degrees};

/// A parameter, written as its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ParameterName(pub Parameter);

impl FromStr for ParameterName {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Parameter::named(name).map(Self).ok_or_else(|| {
            let known: Vec<_> = Parameter::ALL.iter().map(|parameter| parameter.name()).collect();
            format!("no parameter has the name {name:?}; there are {}", known.join(", "))
        })
    }
}

impl Serialize for ParameterName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name())
    }
}

impl<'de> Deserialize<'de> for ParameterName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Cow::<'de, str>::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl PartialSchema for ParameterName {
    fn schema() -> RefOr<Schema> {
        let names = Parameter::ALL.map(Parameter::name).join("|");
        // Not an enumeration: generators of clients that write its names in capitals cannot tell R1 from r1.
        ObjectBuilder::new()
            .schema_type(Type::String)
            .pattern(Some(format!("^({names})$")))
            .description(Some(
                "Name of a parameter: e1 = D1 - d1 and e2 = D2 - d2; R1, r1, R2, r4, L1, L2, L3; the sliders' zero \
                 offsets o1, o2, o3; the length of the tool; and the table's da, dt, axes and zero offsets.",
            ))
            .into()
    }
}

impl ToSchema for ParameterName {
    fn name() -> Cow<'static, str> {
        "ParameterName".into()
    }
}

/// Parameters separated by commas, in a query or on a command line. They may have quotation marks, as in JSON.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct ParameterList(pub Vec<ParameterName>);

impl FromStr for ParameterList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let name = |item: &str| item.trim().trim_matches('"').parse();
        text.split(',').map(name).collect::<Result<_, _>>().map(Self)
    }
}

impl<'de> Deserialize<'de> for ParameterList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Cow::<'de, str>::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl PartialSchema for ParameterList {
    fn schema() -> RefOr<Schema> {
        ArrayBuilder::new().items(ParameterName::schema()).min_items(Some(1)).into()
    }
}

impl ToSchema for ParameterList {}

/// A number in mm or degrees as the solver has it.
pub(crate) fn of_wire(unit: ParameterUnit, value: f64) -> f64 {
    match unit {
        ParameterUnit::Millimetre => value,
        ParameterUnit::Radian => from_degrees(value),
    }
}

/// A number of the solver in mm or degrees, without -0.
pub(crate) fn to_wire(unit: ParameterUnit, value: f64) -> f64 {
    match unit {
        ParameterUnit::Millimetre => value + 0.0,
        ParameterUnit::Radian => to_degrees(value),
    }
}

/// The unit of the API.
pub(crate) fn unit_of(unit: ParameterUnit) -> Unit {
    match unit {
        ParameterUnit::Millimetre => Unit::Millimetre,
        ParameterUnit::Radian => Unit::Degree,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use verne_solver::parameter::Parameter;

    use super::{ParameterList, ParameterName};

    #[test]
    fn names_are_read_and_unknown_ones_refused_with_those_there_are() {
        let list: ParameterList = "R1, \"tool_length\"".parse().unwrap();
        assert_eq!(list.0, [ParameterName(Parameter::R1), ParameterName(Parameter::ToolLength)]);
        let error = "D1".parse::<ParameterName>().unwrap_err();
        assert!(error.contains("\"D1\"") && error.contains("e1, e2, R1"), "{error}");
    }
}

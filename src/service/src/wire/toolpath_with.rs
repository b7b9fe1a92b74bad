//! Requests about a tool path: the fields of `POST /toolpath`, and some more in the same object.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{MapAccessDeserializer, StringDeserializer};
use serde::de::{DeserializeSeed, Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use utoipa::openapi::schema::Object;
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

use crate::wire::toolpath::ToolpathRequest;

/// Fields beside those of a request for a tool path.
pub(crate) trait MoreFields: Default + ToSchema {
    /// The name of the whole request's schema.
    const REQUEST: &'static str;
    /// The description of the whole request.
    const DESCRIPTION: &'static str;
    /// The names of the fields.
    const NAMES: &'static [&'static str];

    /// Reads the value of one of these fields.
    fn read<'de, A: MapAccess<'de>>(&mut self, name: &'static str, map: &mut A) -> Result<(), A::Error>;
}

/// A request for a tool path with more fields.
#[derive(Clone, Debug)]
pub(crate) struct ToolpathWith<T> {
    /// The tool path.
    pub toolpath: ToolpathRequest,
    /// The other fields.
    pub more: T,
}

impl<'de, T: MoreFields> Deserialize<'de> for ToolpathWith<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Fields(PhantomData))
    }
}

struct Fields<T>(PhantomData<T>);

impl<'de, T: MoreFields> Visitor<'de> for Fields<T> {
    type Value = ToolpathWith<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ToolpathWith<T>, A::Error> {
        let mut more = T::default();
        let others = Others { map, more: &mut more };
        let toolpath = ToolpathRequest::deserialize(MapAccessDeserializer::new(others))?;
        Ok(ToolpathWith { toolpath, more })
    }
}

/// The fields that belong to the request for the tool path.
struct Others<'a, A, T> {
    map: A,
    more: &'a mut T,
}

impl<'de, A: MapAccess<'de>, T: MoreFields> MapAccess<'de> for Others<'_, A, T> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        let mut seed = Some(seed);
        loop {
            match self.map.next_key_seed(Name { seed: &mut seed, names: T::NAMES })? {
                None => return Ok(None),
                Some(Key::Other(key)) => return Ok(Some(key)),
                Some(Key::More(name)) => self.more.read(name, &mut self.map)?,
            }
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}

/// A field's name: one of the other fields, or what the request for the tool path makes of it.
enum Key<V> {
    More(&'static str),
    Other(V),
}

/// Reads a field's name. It is read here, so that an error has the pointer of the field.
struct Name<'a, K> {
    seed: &'a mut Option<K>,
    names: &'static [&'static str],
}

impl<'de, K: DeserializeSeed<'de>> DeserializeSeed<'de> for Name<'_, K> {
    type Value = Key<K::Value>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Key<K::Value>, D::Error> {
        let name = String::deserialize(deserializer)?;
        if let Some(more) = self.names.iter().find(|known| **known == name) {
            return Ok(Key::More(more));
        }
        let Some(seed) = self.seed.take() else { return Err(D::Error::custom("a name is read once")) };
        let name: StringDeserializer<D::Error> = name.into_deserializer();
        seed.deserialize(name).map(Key::Other)
    }
}

impl<T: MoreFields> PartialSchema for ToolpathWith<T> {
    fn schema() -> RefOr<Schema> {
        let [mut all, more] = [object(ToolpathRequest::schema()), object(T::schema())];
        all.properties.extend(more.properties);
        all.required.extend(more.required);
        all.description = Some(T::DESCRIPTION.to_owned());
        Schema::Object(all).into()
    }
}

fn object(schema: RefOr<Schema>) -> Object {
    match schema {
        RefOr::T(Schema::Object(object)) => object,
        _ => Object::default(),
    }
}

impl<T: MoreFields> ToSchema for ToolpathWith<T> {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed(T::REQUEST)
    }

    fn schemas(schemas: &mut Vec<(String, RefOr<Schema>)>) {
        ToolpathRequest::schemas(schemas);
        T::schemas(schemas);
    }
}

/// Reads the value of a field that must not occur twice.
pub(crate) fn read_once<'de, A: MapAccess<'de>, V: Deserialize<'de>>(
    field: &mut Option<V>,
    name: &'static str,
    map: &mut A,
) -> Result<(), A::Error> {
    if field.is_some() {
        return Err(A::Error::duplicate_field(name));
    }
    *field = Some(map.next_value()?);
    Ok(())
}

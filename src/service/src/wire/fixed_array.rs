//! JSON arrays of a fixed length, and comma-separated numbers in queries and on the command line.

use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use arrayvec::ArrayVec;
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use utoipa::openapi::schema::{ArrayBuilder, ArrayItems};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

/// A JSON array of exactly N items. Rust's arrays would not do: serde reports an item too many as a syntax error, and
/// their schema does not state the length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedArray<T, const N: usize>(pub [T; N]);

/// `[min, max]`, or two margins.
pub(crate) type Pair = FixedArray<f64, 2>;
/// One number for each slider, or x, y, z.
pub(crate) type Triple = FixedArray<f64, 3>;
/// One number for each rod: 11, 12, 21, 22, 31, 32.
pub(crate) type PerRod = FixedArray<f64, 6>;
/// Points along x, y, z.
pub(crate) type Counts = FixedArray<u32, 3>;
/// A pair for each slider.
pub(crate) type PairPerSlider = FixedArray<Pair, 3>;
/// Four directions: rod 11, rod 12, the rods of leg II, the rods of leg III.
pub(crate) type Axes = FixedArray<Triple, 4>;

impl<T: Serialize, const N: usize> Serialize for FixedArray<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(&self.0)
    }
}

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for FixedArray<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ArrayVisitor(PhantomData))
    }
}

struct ArrayVisitor<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ArrayVisitor<T, N> {
    type Value = FixedArray<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of {N} items")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let mut array = ArrayVec::<T, N>::new();
        while let Some(item) = items.next_element()? {
            array.try_push(item).map_err(|_| A::Error::invalid_length(N + 1, &self))?;
        }
        array.into_inner().map(FixedArray).map_err(|short| A::Error::invalid_length(short.len(), &self))
    }
}

impl<T: PartialSchema, const N: usize> PartialSchema for FixedArray<T, N> {
    fn schema() -> RefOr<Schema> {
        array_of(T::schema(), N, N)
    }
}

impl<T: ToSchema, const N: usize> ToSchema for FixedArray<T, N> {}

fn array_of(item: RefOr<Schema>, least: usize, most: usize) -> RefOr<Schema> {
    ArrayBuilder::new()
        .items(ArrayItems::RefOrSchema(Box::new(item)))
        .min_items(Some(least))
        .max_items(Some(most))
        .into()
}

/// Three numbers and at most `OPTIONAL` more, separated by commas, in a query or on a command line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NumberList<const OPTIONAL: usize> {
    /// The first three numbers.
    pub first: Triple,
    /// The numbers after them.
    pub optional: Vec<f64>,
}

/// The number of required numbers.
const REQUIRED: usize = 3;

/// Sliders, or a direction.
pub(crate) type TripleList = NumberList<0>;
/// A position, and perhaps alpha.
pub(crate) type PoseList = NumberList<1>;
/// Sliders, and perhaps the table's angles.
pub(crate) type JointList = NumberList<2>;

impl<const OPTIONAL: usize> NumberList<OPTIONAL> {
    /// One of the optional numbers, from 0.
    pub(crate) fn optional(&self, i: usize) -> Option<f64> {
        self.optional.get(i).copied()
    }
}

impl<const OPTIONAL: usize> FromStr for NumberList<OPTIONAL> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split(',')
            .map(|item| item.trim().parse().map_err(|_| format!("{item:?} is not a number")))
            .collect::<Result<Vec<f64>, _>>()?;
        match numbers.split_first_chunk::<REQUIRED>() {
            Some((first, optional)) if optional.len() <= OPTIONAL => {
                Ok(Self { first: FixedArray(*first), optional: optional.to_vec() })
            }
            _ => {
                let most = REQUIRED + OPTIONAL;
                let accepted = if OPTIONAL == 0 { most.to_string() } else { format!("{REQUIRED} to {most}") };
                Err(format!("expected {accepted} numbers separated by commas, found {}", numbers.len()))
            }
        }
    }
}

impl<'de, const OPTIONAL: usize> Deserialize<'de> for NumberList<OPTIONAL> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = std::borrow::Cow::<'de, str>::deserialize(deserializer)?;
        text.parse().map_err(D::Error::custom)
    }
}

impl<const OPTIONAL: usize> PartialSchema for NumberList<OPTIONAL> {
    fn schema() -> RefOr<Schema> {
        array_of(f64::schema(), REQUIRED, REQUIRED + OPTIONAL)
    }
}

impl<const OPTIONAL: usize> ToSchema for NumberList<OPTIONAL> {}

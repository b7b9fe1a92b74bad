//! Groups of numbers of a fixed size in JSON, and comma-separated ones in queries and on the command line.

use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use arrayvec::ArrayVec;
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use utoipa::openapi::schema::{ArrayBuilder, ArrayItems};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

/// A JSON array of exactly N items. The parser's own arrays take one item too many for a syntax
/// error, and the schema's own arrays do not say how many items they hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exactly<T, const N: usize>(pub [T; N]);

/// `[min, max]`, or two margins.
pub(crate) type Pair = Exactly<f64, 2>;
/// One number for each slider, or x, y, z.
pub(crate) type Triple = Exactly<f64, 3>;
/// One number for each rod: 11, 12, 21, 22, 31, 32.
pub(crate) type PerRod = Exactly<f64, 6>;
/// Points along x, y, z.
pub(crate) type Counts = Exactly<u32, 3>;
/// A pair for each slider.
pub(crate) type PairPerSlider = Exactly<Pair, 3>;
/// Four directions: rod 11, rod 12, the rods of leg II, the rods of leg III.
pub(crate) type Axes = Exactly<Triple, 4>;

impl<T: Serialize, const N: usize> Serialize for Exactly<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(&self.0)
    }
}

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Items(PhantomData))
    }
}

struct Items<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Items<T, N> {
    type Value = Exactly<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of {N} items")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Self::Value, A::Error> {
        let mut array = ArrayVec::<T, N>::new();
        while let Some(item) = items.next_element()? {
            array.try_push(item).map_err(|_| A::Error::invalid_length(N + 1, &self))?;
        }
        array.into_inner().map(Exactly).map_err(|short| A::Error::invalid_length(short.len(), &self))
    }
}

impl<T: PartialSchema, const N: usize> PartialSchema for Exactly<T, N> {
    fn schema() -> RefOr<Schema> {
        array_of(T::schema(), N, N)
    }
}

impl<T: ToSchema, const N: usize> ToSchema for Exactly<T, N> {}

fn array_of(item: RefOr<Schema>, least: usize, most: usize) -> RefOr<Schema> {
    ArrayBuilder::new()
        .items(ArrayItems::RefOrSchema(Box::new(item)))
        .min_items(Some(least))
        .max_items(Some(most))
        .into()
}

/// LEAST to MOST numbers separated by commas, as a query or a command line writes them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Listed<const LEAST: usize, const MOST: usize>(pub Vec<f64>);

/// Three numbers: sliders or a direction.
pub(crate) type ListedTriple = Listed<3, 3>;
/// Sliders, perhaps with the table's angles.
pub(crate) type ListedJoints = Listed<3, 5>;
/// A position, perhaps with alpha.
pub(crate) type ListedPose = Listed<3, 4>;

impl<const LEAST: usize, const MOST: usize> Listed<LEAST, MOST> {
    /// The first three numbers.
    pub(crate) fn first_three(&self) -> Triple {
        Exactly(std::array::from_fn(|i| self.get(i).unwrap_or(f64::NAN)))
    }

    /// One of the numbers.
    pub(crate) fn get(&self, i: usize) -> Option<f64> {
        self.0.get(i).copied()
    }
}

impl<const LEAST: usize, const MOST: usize> FromStr for Listed<LEAST, MOST> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split(',')
            .map(|item| item.trim().parse().map_err(|_| format!("{item:?} is not a number")))
            .collect::<Result<Vec<f64>, _>>()?;
        if (LEAST..=MOST).contains(&numbers.len()) {
            return Ok(Self(numbers));
        }
        let wanted = if LEAST == MOST { LEAST.to_string() } else { format!("{LEAST} to {MOST}") };
        Err(format!("expected {wanted} numbers separated by commas, found {}", numbers.len()))
    }
}

impl<'de, const LEAST: usize, const MOST: usize> Deserialize<'de> for Listed<LEAST, MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = std::borrow::Cow::<'de, str>::deserialize(deserializer)?;
        text.parse().map_err(D::Error::custom)
    }
}

impl<const LEAST: usize, const MOST: usize> PartialSchema for Listed<LEAST, MOST> {
    fn schema() -> RefOr<Schema> {
        array_of(f64::schema(), LEAST, MOST)
    }
}

impl<const LEAST: usize, const MOST: usize> ToSchema for Listed<LEAST, MOST> {}

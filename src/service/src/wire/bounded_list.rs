//! JSON arrays that keep only as many items as the largest batch may have.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// Most rows that `--max-rows` may allow. A body is read before that limit applies: this many rows take some 50 MB.
pub(crate) const MOST_ROWS: usize = 1_000_000;

/// A list that keeps its first [`MOST_ROWS`] items and counts the others.
#[derive(Debug)]
pub(crate) struct BoundedList<T> {
    items: Vec<T>,
    /// How many items followed.
    beyond: usize,
}

impl<T> Default for BoundedList<T> {
    fn default() -> Self {
        Self { items: Vec::new(), beyond: 0 }
    }
}

impl<T> BoundedList<T> {
    /// How many items the list had.
    pub(crate) fn len(&self) -> usize {
        self.items.len() + self.beyond
    }

    /// The first items, at most [`MOST_ROWS`].
    pub(crate) fn items(&self) -> &[T] {
        &self.items
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for BoundedList<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

struct ListVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for ListVisitor<T> {
    type Value = BoundedList<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequence")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<BoundedList<T>, A::Error> {
        let mut items = Vec::new();
        while items.len() < MOST_ROWS {
            match sequence.next_element()? {
                Some(item) => items.push(item),
                None => return Ok(BoundedList { items, beyond: 0 }),
            }
        }
        let mut beyond = 0;
        while sequence.next_element::<IgnoredAny>()?.is_some() {
            beyond += 1;
        }
        Ok(BoundedList { items, beyond })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::value::RawValue;

    use super::{BoundedList, MOST_ROWS};
    use crate::wire::batch::Row;

    #[test]
    fn rows_beyond_the_largest_batch_are_only_counted() {
        let body = format!("[[]{}]", ",[]".repeat(MOST_ROWS + 9));
        let rows: BoundedList<Row> = serde_json::from_str(&body).unwrap();
        assert_eq!((rows.len(), rows.items().len()), (MOST_ROWS + 10, MOST_ROWS));
        let rows: BoundedList<&RawValue> = serde_json::from_str(&body).unwrap();
        assert_eq!((rows.len(), rows.items().len()), (MOST_ROWS + 10, MOST_ROWS));
    }
}

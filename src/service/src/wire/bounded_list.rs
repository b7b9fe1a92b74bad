//! Lists that stop growing where no service answers them any more.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// Most rows that `--max-rows` may allow: what is read before it is applied has some 50 MB.
pub(crate) const MOST_ROWS: usize = 1_000_000;

/// A list of which at most [`MOST_ROWS`] items are kept; the others are counted.
#[derive(Debug)]
pub(crate) struct Capped<T> {
    kept: Vec<T>,
    beyond: usize,
}

impl<T> Capped<T> {
    /// How many items the list had.
    pub(crate) fn len(&self) -> usize {
        self.kept.len() + self.beyond
    }

    /// The items from the first on; all of them where there are no more than may be.
    pub(crate) fn kept(&self) -> &[T] {
        &self.kept
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Capped<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Items(PhantomData))
    }
}

struct Items<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Items<T> {
    type Value = Capped<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequence")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Capped<T>, A::Error> {
        let mut kept = Vec::new();
        while kept.len() < MOST_ROWS {
            match items.next_element()? {
                Some(item) => kept.push(item),
                None => return Ok(Capped { kept, beyond: 0 }),
            }
        }
        let mut beyond = 0;
        while items.next_element::<IgnoredAny>()?.is_some() {
            beyond += 1;
        }
        Ok(Capped { kept, beyond })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::value::RawValue;

    use super::{Capped, MOST_ROWS};
    use crate::wire::batch::Row;

    #[test]
    fn rows_beyond_what_any_service_answers_are_only_counted() {
        let body = format!("[[]{}]", ",[]".repeat(MOST_ROWS + 9));
        let rows: Capped<Row> = serde_json::from_str(&body).unwrap();
        assert_eq!((rows.len(), rows.kept().len()), (MOST_ROWS + 10, MOST_ROWS));
        let rows: Capped<&RawValue> = serde_json::from_str(&body).unwrap();
        assert_eq!((rows.len(), rows.kept().len()), (MOST_ROWS + 10, MOST_ROWS));
    }
}

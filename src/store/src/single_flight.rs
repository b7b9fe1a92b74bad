//! One computation for all callers that ask for the same key at the same time.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use crate::key::Key;

/// The computations that run now. Its clones are one.
#[derive(Clone, Default)]
pub(crate) struct SingleFlight(Arc<Mutex<Flights>>);

/// By key and by the type of the answer. A flight leaves the table when it has its answer, or with its last caller.
type Flights = HashMap<(Key, TypeId), Weak<Flight>>;

struct Flight {
    key: (Key, TypeId),
    /// The caller that computes the answer has the lock; the others wait for it.
    answer: tokio::sync::Mutex<Option<Box<dyn Any + Send>>>,
    flights: Weak<Mutex<Flights>>,
}

impl SingleFlight {
    /// The answer of `work`, which the first caller runs while the other callers of the key wait for its answer.
    ///
    /// If the first caller is dropped, the next one runs its own `work`. Callers that come after the answer start anew.
    /// Callers that expect answers of different types do not wait for each other.
    pub(crate) async fn run<T: Clone + Send + 'static>(&self, key: Key, work: impl Future<Output = T>) -> T {
        let flight = self.join((key, TypeId::of::<T>()));
        let mut answer = flight.answer.lock().await;
        if let Some(answer) = answer.as_ref().and_then(|answer| answer.downcast_ref::<T>()) {
            return answer.clone();
        }
        // Boxed, because the future of every waiting caller would have room for it a second time.
        let computed = Box::pin(work).await;
        lock(&self.0).remove(&flight.key);
        *answer = Some(Box::new(computed.clone()));
        computed
    }

    fn join(&self, key: (Key, TypeId)) -> Arc<Flight> {
        let mut flights = lock(&self.0);
        let current = flights.entry(key).or_default();
        current.upgrade().unwrap_or_else(|| {
            let flights = Arc::downgrade(&self.0);
            let new = Arc::new(Flight { key, answer: tokio::sync::Mutex::default(), flights });
            *current = Arc::downgrade(&new);
            new
        })
    }
}

impl Drop for Flight {
    fn drop(&mut self) {
        let Some(flights) = self.flights.upgrade() else { return };
        // A later flight may have the entry by now.
        if let Entry::Occupied(entry) = lock(&flights).entry(self.key)
            && entry.get().strong_count() == 0
        {
            entry.remove();
        }
    }
}

fn lock(flights: &Mutex<Flights>) -> MutexGuard<'_, Flights> {
    flights.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::future::{pending, ready};

    use futures_util::poll;

    use super::*;

    #[tokio::test]
    async fn a_waiting_caller_takes_over_from_a_dropped_one_and_later_callers_start_anew() {
        let (flights, key) = (SingleFlight::default(), Key::from([7; 32]));
        let mut first = Box::pin(flights.run(key, pending::<u8>()));
        assert!(poll!(&mut first).is_pending());
        let mut second = Box::pin(flights.run(key, ready(2_u8)));
        assert!(poll!(&mut second).is_pending(), "it waits for the first");
        let mut third = Box::pin(flights.run(key, ready(3_u8)));
        assert!(poll!(&mut third).is_pending());
        drop(first);
        assert_eq!(second.await, 2);
        assert_eq!(
            flights.run(key, ready(4_u8)).await,
            4,
            "the flight has ended, though the third has not read its answer"
        );
        assert_eq!(third.await, 2);
        assert_eq!(lock(&flights.0).len(), 0);
    }

    #[tokio::test]
    async fn a_flight_whose_callers_are_dropped_leaves_no_entry() {
        let (flights, key) = (SingleFlight::default(), Key::from([7; 32]));
        let mut only = Box::pin(flights.run(key, pending::<u8>()));
        assert!(poll!(&mut only).is_pending());
        assert_eq!(flights.run(key, ready("of another type")).await, "of another type");
        drop(only);
        assert_eq!(lock(&flights.0).len(), 0);
    }
}

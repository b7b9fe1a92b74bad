//! How much is worked on at once, and that what is quick does not wait for what is long.
//!
//! A request has a [`Place`] while it is worked on. Single questions may take all places, everything else three in four
//! of them; so a question is not refused because others are computed. While a request waits for a job it gives its place
//! back. Batches have a share of their own, from the reading of their bodies to the end of their work: those beyond what
//! the worker threads do at once wait for them in order. Where there is no place the answer is 503 at once.

use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::error::Error;

/// Most batches that are read, wait or are computed: with the default limit their bodies have half a gibibyte.
const BATCHES: usize = 32;

/// Most requests that wait for their jobs at once; each is some ten kilobytes, most of them its connection's. One beyond
/// them is answered the address of its job, as one that does not want to wait.
const WAITING: usize = 16_384;

/// Most streams of events at once; about as large as a request that waits.
const STREAMS: usize = 16_384;

/// What a request is to the service.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Load {
    /// Answered on the spot.
    Question,
    /// Anything else.
    Work,
    /// Tells how the service fares: never refused.
    Watch,
}

/// Places, and who has them.
#[derive(Debug)]
pub(crate) struct Admission {
    all: Arc<Semaphore>,
    /// Of them, those that are not kept for questions.
    work: Arc<Semaphore>,
    batches: Arc<Semaphore>,
    waiting: Arc<Semaphore>,
    streams: Arc<Semaphore>,
}

impl Admission {
    /// At most so many requests are worked on.
    pub(crate) fn new(requests: usize) -> Arc<Self> {
        let room = |places: usize| Arc::new(Semaphore::new(places.clamp(1, Semaphore::MAX_PERMITS)));
        Arc::new(Self {
            all: room(requests),
            work: room(requests - requests / 4),
            batches: room(BATCHES.min(requests / 2)),
            waiting: room(WAITING),
            streams: room(STREAMS),
        })
    }

    /// A place for a request; there is one in any case for who only watches.
    pub(crate) fn enter(self: &Arc<Self>, load: Load) -> Result<Arc<Place>, Error> {
        let work = if load == Load::Work { Some(taken(&self.work)?) } else { None };
        let place = if load == Load::Watch { None } else { Some(taken(&self.all)?) };
        Ok(Arc::new(Place { admission: Arc::clone(self), taken: Mutex::new((work, place)) }))
    }

    /// A share of the batches.
    pub(crate) fn batch(&self) -> Result<OwnedSemaphorePermit, Error> {
        taken(&self.batches)
    }

    /// A stream of events.
    pub(crate) fn stream(&self) -> Result<OwnedSemaphorePermit, Error> {
        taken(&self.streams)
    }
}

fn taken(room: &Arc<Semaphore>) -> Result<OwnedSemaphorePermit, Error> {
    Arc::clone(room).try_acquire_owned().map_err(|_| Error::Overloaded)
}

type Permits = (Option<OwnedSemaphorePermit>, Option<OwnedSemaphorePermit>);

/// A request's place. Given back when the last handle is dropped.
#[derive(Debug)]
pub(crate) struct Place {
    admission: Arc<Admission>,
    taken: Mutex<Permits>,
}

impl Place {
    /// Waits without a place and takes one again, before those that come anew. `None`: too many wait already.
    pub(crate) async fn aside<T>(&self, wait: impl Future<Output = T>) -> Option<T> {
        let waiting = taken(&self.admission.waiting).ok()?;
        drop(self.replace((None, None)));
        let outcome = wait.await;
        let work = Arc::clone(&self.admission.work).acquire_owned().await;
        let place = Arc::clone(&self.admission.all).acquire_owned().await;
        self.replace((work.ok(), place.ok()));
        drop(waiting);
        Some(outcome)
    }

    fn replace(&self, permits: Permits) -> Permits {
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut *taken, permits)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;

    use super::{Admission, Load, taken};

    fn free(admission: &Admission) -> (usize, usize) {
        (admission.all.available_permits(), admission.work.available_permits())
    }

    #[tokio::test]
    async fn who_waits_gives_the_place_back_and_takes_one_again() {
        let admission = Admission::new(4);
        let place = admission.enter(Load::Work).unwrap();
        assert_eq!(free(&admission), (3, 2));
        let seen = place.aside(async { free(&admission) }).await;
        assert_eq!((seen, free(&admission)), (Some((4, 3)), (3, 2)));
        drop(place);
        assert_eq!(free(&admission), (4, 3));
    }

    #[tokio::test]
    async fn not_more_than_may_wait() {
        let admission = Admission::new(4);
        let place = admission.enter(Load::Work).unwrap();
        let waiting: Vec<_> = std::iter::from_fn(|| taken(&admission.waiting).ok()).collect();
        assert_eq!(place.aside(async {}).await, None);
        assert_eq!(free(&admission), (3, 2), "the place is kept");
        drop(waiting);
        assert_eq!(place.aside(async {}).await, Some(()));
    }

    #[test]
    fn one_place_is_for_anything() {
        let admission = Admission::new(0);
        drop(admission.enter(Load::Work).unwrap());
        let place = admission.enter(Load::Question).unwrap();
        assert!(admission.enter(Load::Question).is_err() && admission.enter(Load::Watch).is_ok());
        assert!(admission.batch().is_ok() && Arc::strong_count(&place) == 1);
    }
}

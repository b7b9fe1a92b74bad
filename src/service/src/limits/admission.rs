//! How much is worked on at once, and that what is quick does not wait for what is long.
//!
//! A request has a [`Place`] while it is worked on. Single questions may take all places, everything else three in four
//! of them; so a question is not refused because others are computed. While a request waits for a job it gives its place
//! back. Batches have a share of their own, from the end of their bodies until their answers are sent: those beyond what
//! the worker threads do at once wait for them in order. So have meshes in formats that are not made yet, few of which are
//! made at once. Bodies that are still read, and answers on their way, are
//! counted by the memory that they have. Of each of these one client may have half. Where there is no place the answer is
//! 503 at once.

pub(crate) mod usage;

use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};

use axum::body::Body;
use axum::http::Response;

use crate::limits::error::LimitError;
use crate::limits::response_memory::Counted;

use crate::limits::client_quota::{Share, Shares};

/// Most batches that wait, are computed or are sent; bodies have as much memory as so many of the largest: with the
/// default limit half a gibibyte.
const BATCHES: usize = 32;

/// Most files of meshes that are made at once. Meanwhile each is in memory three times: as it is kept, as a mesh and as a
/// file, some hundred megabytes for the largest.
const MESHES: usize = 2;

/// Most requests that wait for their jobs at once; each is some sixty kilobytes, most of them its connection's. One beyond
/// them is answered the address of its job, as one that does not want to wait.
const WAITING: usize = 16_384;

/// Most streams of events at once; about as large as a request that waits.
const STREAMS: usize = 16_384;

/// Most pages of memory that answers have while they are sent: 2 GiB, a thousand large meshes that are read slowly.
const OUTGOING: usize = 128 * 1024;

/// Bytes of a page, by which memory is counted.
const PAGE: u64 = 16 * 1024;

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

/// Places, and who has them. A client is given where it is bounded.
#[derive(Debug)]
pub(crate) struct Admission {
    all: Arc<Shares>,
    /// Of them, those that are not kept for questions.
    work: Arc<Shares>,
    bodies: Arc<Shares>,
    batches: Arc<Shares>,
    /// Files of meshes that wait to be made, or are.
    meshes: Arc<Shares>,
    /// Those of them that are.
    turns: Arc<Shares>,
    waiting: Arc<Shares>,
    streams: Arc<Shares>,
    outgoing: Arc<Shares>,
}

impl Admission {
    /// At most so many requests are worked on, with bodies of at most so many bytes.
    pub(crate) fn new(requests: usize, body_bytes: usize) -> Arc<Self> {
        let batches = BATCHES.min(requests / 2);
        // One client may have half: one body at least.
        let bodies = batches.max(2).saturating_mul(pages(body_bytes as u64));
        Arc::new(Self {
            all: Shares::new(requests),
            work: Shares::new(requests - requests / 4),
            bodies: Shares::new(bodies),
            batches: Shares::new(batches),
            meshes: Shares::new(batches),
            turns: Shares::new(MESHES),
            waiting: Shares::new(WAITING),
            streams: Shares::new(STREAMS),
            outgoing: Shares::new(OUTGOING),
        })
    }

    /// A place for a request; there is one in any case for who only watches.
    pub(crate) fn enter(
        self: &Arc<Self>,
        load: Load,
        client: Option<&str>,
    ) -> Result<Arc<Place>, LimitError> {
        let work = if load == Load::Work { Some(self.work.take(client)?) } else { None };
        let place = if load == Load::Watch { None } else { Some(self.all.take(client)?) };
        let client = client.map(str::to_owned);
        Ok(Arc::new(Place { admission: Arc::clone(self), client, taken: Mutex::new((work, place)) }))
    }

    /// The memory of a body of which nothing is read yet.
    pub(crate) fn body(&self, client: Option<&str>) -> Result<Memory, LimitError> {
        self.bodies.take(client).map(Memory)
    }

    /// A share of the batches.
    pub(crate) fn batch(&self, client: Option<&str>) -> Result<Share, LimitError> {
        self.batches.take(client)
    }

    /// A mesh's turn to be made into a file; waits for it, in order.
    pub(crate) async fn mesh(&self, client: Option<&str>) -> Result<Turn, LimitError> {
        let share = self.meshes.take(client)?;
        let turn = self.turns.wait(None).await.ok_or(LimitError::Overloaded)?;
        Ok(Turn { _turn: turn, _share: share })
    }

    /// A stream of events.
    pub(crate) fn stream(&self, client: Option<&str>) -> Result<Share, LimitError> {
        self.streams.take(client)
    }

    /// Counts the memory of an answer until it is sent.
    pub(crate) fn send(
        &self,
        answer: Response<Body>,
        client: Option<&str>,
    ) -> Result<Response<Body>, LimitError> {
        match crate::limits::response_memory::bytes_of(&answer) {
            Some(0) | None => Ok(answer),
            Some(bytes) => {
                let share = self.outgoing.take_many(client, pages(bytes))?;
                Ok(answer.map(|body| Body::new(Counted::new(body, share))))
            }
        }
    }
}

/// A mesh's turn, until it is dropped.
#[derive(Debug)]
pub(crate) struct Turn {
    _turn: Share,
    _share: Share,
}

fn pages(bytes: u64) -> usize {
    usize::try_from(bytes.div_ceil(PAGE)).unwrap_or(usize::MAX).max(1)
}

/// The memory that a body has.
#[derive(Debug)]
pub(crate) struct Memory(Share);

impl Memory {
    /// The body has grown to so many bytes.
    pub(crate) fn hold(&mut self, bytes: usize) -> Result<(), LimitError> {
        match pages(bytes as u64).checked_sub(self.0.count()) {
            None | Some(0) => Ok(()),
            Some(more) => self.0.grow(more),
        }
    }
}

/// A request's place. Given back when the last handle is dropped.
#[derive(Debug)]
pub(crate) struct Place {
    admission: Arc<Admission>,
    client: Option<String>,
    taken: Mutex<(Option<Share>, Option<Share>)>,
}

impl Place {
    /// Waits without a place and takes one again, before those that come anew. `None`: too many wait already.
    pub(crate) async fn aside<T>(&self, wait: impl Future<Output = T>) -> Option<T> {
        let client = self.client.as_deref();
        let waiting = self.admission.waiting.take(client).ok()?;
        drop(self.replace((None, None)));
        let outcome = wait.await;
        let work = self.admission.work.wait(client).await;
        let place = self.admission.all.wait(client).await;
        self.replace((work, place));
        drop(waiting);
        Some(outcome)
    }

    fn replace(&self, shares: (Option<Share>, Option<Share>)) -> (Option<Share>, Option<Share>) {
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut *taken, shares)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;

    use futures_util::FutureExt;

    use super::{Admission, Load};
    use crate::limits::error::LimitError;

    fn free(admission: &Admission) -> (usize, usize) {
        (admission.all.left(), admission.work.left())
    }

    #[tokio::test]
    async fn who_waits_gives_the_place_back_and_takes_one_again() {
        let admission = Admission::new(4, 1);
        let place = admission.enter(Load::Work, None).unwrap();
        assert_eq!(free(&admission), (3, 2));
        let seen = place.aside(async { free(&admission) }).await;
        assert_eq!((seen, free(&admission)), (Some((4, 3)), (3, 2)));
        drop(place);
        assert_eq!(free(&admission), (4, 3));
    }

    #[tokio::test]
    async fn not_more_than_may_wait() {
        let admission = Admission::new(4, 1);
        let place = admission.enter(Load::Work, None).unwrap();
        let waiting: Vec<_> = std::iter::from_fn(|| admission.waiting.take(None).ok()).collect();
        assert_eq!(place.aside(async {}).await, None);
        assert_eq!(free(&admission), (3, 2), "the place is kept");
        drop(waiting);
        assert_eq!(place.aside(async {}).await, Some(()));
    }

    #[test]
    fn one_place_is_for_anything() {
        let admission = Admission::new(0, 1);
        drop(admission.enter(Load::Work, None).unwrap());
        let place = admission.enter(Load::Question, None).unwrap();
        assert!(admission.enter(Load::Question, None).is_err() && admission.enter(Load::Watch, None).is_ok());
        assert!(admission.batch(None).is_ok() && Arc::strong_count(&place) == 1);
    }

    #[test]
    fn a_body_has_what_has_come_of_it_and_no_client_takes_all() {
        let admission = Admission::new(8, 1_000_000);
        let mut body = admission.body(Some("a")).unwrap();
        for bytes in [0, 1, 500_000, 1_000_000] {
            body.hold(bytes).unwrap();
        }
        let mut second = admission.body(Some("a")).unwrap();
        second.hold(1_000_000).unwrap();
        assert!(admission.body(Some("a")).is_err());
        let mut other = admission.body(Some("b")).unwrap();
        other.hold(1_000_000).unwrap();
        drop(second);
        assert!(admission.body(Some("a")).is_ok());
    }

    #[tokio::test]
    async fn few_meshes_are_made_at_once_and_the_others_wait_in_order() {
        let admission = Admission::new(64, 1);
        let mut turns = Vec::new();
        for _ in 0..super::MESHES {
            turns.push(admission.mesh(Some("a")).await.unwrap());
        }
        let mut waiting: Vec<_> =
            (0..super::BATCHES / 2 - super::MESHES).map(|_| Box::pin(admission.mesh(Some("a")))).collect();
        for turn in &mut waiting {
            assert!(turn.as_mut().now_or_never().is_none());
        }
        assert_eq!(admission.mesh(Some("a")).await.unwrap_err(), LimitError::Overloaded);
        assert!(admission.mesh(Some("b")).now_or_never().is_none(), "others have the other half");
        drop(turns.pop());
        assert!(waiting[1].as_mut().now_or_never().is_none());
        assert!(waiting[0].as_mut().now_or_never().is_some());
    }

    #[test]
    fn no_client_has_all_streams() {
        let admission = Admission::new(8, 1);
        let streams: Vec<_> = std::iter::from_fn(|| admission.stream(Some("a")).ok()).collect();
        assert_eq!(streams.len(), super::STREAMS / 2);
        assert!(admission.stream(Some("b")).is_ok());
    }
}

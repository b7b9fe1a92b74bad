//! Limits the requests, bodies, batches and responses at once. Beyond a limit the response is 503 immediately.
//!
//! - A request has a [`RequestPermit`] while it is handled. Fast requests may take all permits, other requests three
//!   quarters of them, so that long computations do not block fast requests. A request returns its permit while it
//!   waits for a job.
//! - A batch has a permit of its own from the end of its body until its response is sent. The worker threads compute
//!   batches in order.
//! - A batch that is answered while its rows arrive, a table, has a permit of another kind: it may last for any time.
//!   There are fewer of these, so that some memory of bodies is left for other batches. The worker threads compute its
//!   chunks in turn with all other work.
//! - The encoding of a mesh as a file has a permit. Few encodings run at once; the others wait in order.
//! - Bodies that are read and responses that are sent are counted by their memory.
//!
//! One client may use half of each limit.

use std::sync::{Arc, Mutex, PoisonError};

use axum::body::Body;
use axum::http::Response;

use crate::limits::client_quota::{Quota, QuotaPermit};
use crate::limits::error::LimitError;
use crate::limits::response_memory::{CountedBody, memory_of};

/// Most batches that wait, are computed or are sent. All bodies together may use the memory of this many of the largest
/// bodies: half a gibibyte with the default limit.
const BATCHES: usize = 32;

/// A table takes the memory of this many of the largest bodies: the bytes that are read ahead, a message of Arrow that
/// is incomplete, and one that is answered.
const TABLE_BODIES: usize = 3;

/// Most meshes that are encoded at once. Each is in memory three times: packed, as a mesh and as a file. This is some
/// hundred megabytes for the largest.
const MESHES: usize = 2;

/// Memory that one program may take while it is received: the most of one client. A larger one counts as this.
const PROGRAM_BYTES: usize = 512 * 1024 * 1024;

/// Most requests that wait for their jobs at once. Each takes some sixty kilobytes, mostly for its connection. A
/// request beyond the limit does not wait: its response is 202.
const WAITING: usize = 16_384;

/// Most streams of events at once. Each takes about as much memory as a request that waits.
const STREAMS: usize = 16_384;

/// Most pages of memory of responses that are sent: 2 GiB, enough for a thousand clients that read large meshes slowly.
const RESPONSE_PAGES: usize = 128 * 1024;

/// Bytes of a page, the unit in which memory is counted.
pub(super) const PAGE_BYTES: u64 = 16 * 1024;

/// How a request is admitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RequestClass {
    /// It takes far less than a millisecond and may use every permit.
    Fast,
    /// It may use three quarters of the permits.
    Other,
    /// It reports the state of the service and needs no permit.
    Monitoring,
}

/// The limits and their use. Methods take the name of a client with a quota.
#[derive(Debug)]
pub(crate) struct Admission {
    pub(super) requests: Arc<Quota>,
    /// The part of the requests that is open to other than fast requests.
    pub(super) slow_requests: Arc<Quota>,
    pub(super) bodies: Arc<Quota>,
    /// Batches whose bodies are complete, until their responses are sent.
    pub batches: Arc<Quota>,
    /// Batches that are answered while their rows arrive, until their answers are sent.
    pub(super) row_streams: Arc<Quota>,
    /// Encodings of meshes that wait or run.
    pub(super) meshes: Arc<Quota>,
    /// Encodings of meshes that run.
    running_meshes: Arc<Quota>,
    /// Memory of programs that are received.
    pub(super) programs: Arc<Quota>,
    pub(super) waiting: Arc<Quota>,
    /// Streams of events.
    pub streams: Arc<Quota>,
    pub(super) responses: Arc<Quota>,
}

impl Admission {
    /// Limits for this number of requests at once, with bodies of at most this many bytes.
    pub(crate) fn new(requests: usize, body_bytes: usize) -> Arc<Self> {
        let batches = BATCHES.min(requests / 2);
        // One client may use half: at least one body.
        let bodies = batches.max(2).saturating_mul(pages(body_bytes as u64));
        Arc::new(Self {
            requests: Quota::new(requests),
            slow_requests: Quota::new(requests - requests / 4),
            bodies: Quota::new(bodies),
            batches: Quota::new(batches),
            row_streams: Quota::new(batches / 4),
            meshes: Quota::new(batches),
            running_meshes: Quota::new(MESHES),
            programs: Quota::new(2 * pages(PROGRAM_BYTES as u64)),
            waiting: Quota::new(WAITING),
            streams: Quota::new(STREAMS),
            responses: Quota::new(RESPONSE_PAGES),
        })
    }

    /// A permit for a request. Monitoring always gets one.
    pub(crate) fn admit(
        self: &Arc<Self>,
        class: RequestClass,
        client: Option<&str>,
    ) -> Result<Arc<RequestPermit>, LimitError> {
        let mut taken = Vec::new();
        if class == RequestClass::Other {
            taken.push(self.slow_requests.take(client)?);
        }
        if class != RequestClass::Monitoring {
            taken.push(self.requests.take(client)?);
        }
        let client = client.map(str::to_owned);
        Ok(Arc::new(RequestPermit { admission: Arc::clone(self), client, taken: Mutex::new(taken) }))
    }

    /// The memory of a body, before any of it is read.
    pub(crate) fn body(&self, client: Option<&str>) -> Result<BodyMemory, LimitError> {
        self.bodies.take(client).map(BodyMemory)
    }

    /// A permit for a table with its memory, before any of it is read. A body has at most this many bytes.
    pub(crate) fn table(
        &self,
        client: Option<&str>,
        body_bytes: usize,
    ) -> Result<[QuotaPermit; 2], LimitError> {
        let stream = self.row_streams.take(client)?;
        let memory = TABLE_BODIES.saturating_mul(pages(body_bytes as u64));
        Ok([self.bodies.take_many(client, memory)?, stream])
    }

    /// The memory of a program that is received, before any of it is read.
    pub(crate) fn program(&self, client: Option<&str>) -> Result<ProgramMemory, LimitError> {
        self.programs.take(client).map(|permit| ProgramMemory(BodyMemory(permit)))
    }

    /// A permit to encode a mesh. Waits for it, in order.
    pub(crate) async fn mesh(&self, client: Option<&str>) -> Result<[QuotaPermit; 2], LimitError> {
        let queued = self.meshes.take(client)?;
        let running = self.running_meshes.wait(None).await.ok_or(LimitError::Overloaded)?;
        Ok([running, queued])
    }

    /// Counts the memory of a response until it is sent.
    pub(crate) fn count_memory(
        &self,
        response: Response<Body>,
        client: Option<&str>,
    ) -> Result<Response<Body>, LimitError> {
        match memory_of(&response) {
            Some(0) | None => Ok(response),
            Some(bytes) => {
                let memory = self.responses.take_many(client, pages(bytes))?;
                Ok(response.map(|body| Body::new(CountedBody::new(body, memory))))
            }
        }
    }
}

fn pages(bytes: u64) -> usize {
    usize::try_from(bytes.div_ceil(PAGE_BYTES)).unwrap_or(usize::MAX).max(1)
}

/// The counted memory of a body.
#[derive(Debug)]
pub(crate) struct BodyMemory(QuotaPermit);

impl BodyMemory {
    /// Counts the memory of a body that grows to this many bytes.
    pub(crate) fn grow_to(&mut self, bytes: usize) -> Result<(), LimitError> {
        match pages(bytes as u64).checked_sub(self.0.count()) {
            None | Some(0) => Ok(()),
            Some(more) => self.0.grow(more),
        }
    }
}

/// The counted memory of a program.
#[derive(Debug)]
pub(crate) struct ProgramMemory(BodyMemory);

impl ProgramMemory {
    /// Counts the memory of a program that grows to this many bytes.
    pub(crate) fn grow_to(&mut self, bytes: usize) -> Result<(), LimitError> {
        self.0.grow_to(bytes.min(PROGRAM_BYTES))
    }
}

/// A permit for a request, until its last handle is dropped.
#[derive(Debug)]
pub(crate) struct RequestPermit {
    admission: Arc<Admission>,
    client: Option<String>,
    taken: Mutex<Vec<QuotaPermit>>,
}

impl RequestPermit {
    /// Returns the permit during a wait, and takes it again before new requests can. `None` if too many requests wait.
    pub(crate) async fn return_during<T>(&self, wait: impl Future<Output = T>) -> Option<T> {
        let client = self.client.as_deref();
        let waiting = self.admission.waiting.take(client).ok()?;
        drop(self.replace(Vec::new()));
        let outcome = wait.await;
        let slow = self.admission.slow_requests.wait(client).await;
        let request = self.admission.requests.wait(client).await;
        self.replace([slow, request].into_iter().flatten().collect());
        drop(waiting);
        Some(outcome)
    }

    fn replace(&self, permits: Vec<QuotaPermit>) -> Vec<QuotaPermit> {
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut *taken, permits)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;

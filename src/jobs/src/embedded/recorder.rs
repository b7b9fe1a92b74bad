//! The thread that owns the database: makes the changes of many callers durable at one go.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use parking_lot::Mutex;
use tokio::sync::oneshot;

use super::records::{Records, Write};
use crate::Unavailable;

/// Most changes in one transaction.
const BATCH: usize = 512;

/// How soon changes that failed are tried again when nothing else is to be written.
const RETRY: Duration = Duration::from_secs(1);

/// How often old jobs are looked for when nothing is written.
const IDLE: Duration = Duration::from_mins(1);

/// Told on the recorder's thread when a change is durable, or is known not to be.
pub(super) type Reply = Box<dyn FnOnce(Result<(), Unavailable>) + Send>;

/// Dropped when the database is closed.
type Closed = oneshot::Sender<()>;

enum Request {
    Write(Box<Write>, Reply),
    Read(Box<dyn FnOnce(&Records) + Send>),
    Close(Closed),
}

/// Changes that could not be made durable.
#[derive(Clone, Debug)]
struct Refused {
    fault: Unavailable,
    /// Bytes of the largest of them.
    bytes: usize,
}

/// What could not be written, until as much could.
type LastRefused = Arc<Mutex<Option<Refused>>>;

/// Requests are served in the order in which they were made. Their number is bounded by those who make them: jobs, by the
/// bound of the queue, and readers, by a semaphore.
pub(super) struct Recorder {
    requests: Sender<Request>,
    last: LastRefused,
}

impl Recorder {
    pub(super) fn start(records: Records) -> std::io::Result<Self> {
        let (requests, receiver) = mpsc::channel();
        let last = LastRefused::default();
        let server = Server { records, failed: Vec::new(), last: Arc::clone(&last) };
        thread::Builder::new().name("jobs-recorder".to_owned()).spawn(move || server.serve(&receiver))?;
        Ok(Self { requests, last })
    }

    /// A reply that is dropped and not called: the database was closed before.
    pub(super) fn write(&self, write: Write, reply: Reply) {
        drop(self.requests.send(Request::Write(Box::new(write), reply)));
    }

    pub(super) async fn read<T: Send + 'static>(
        &self,
        read: impl FnOnce(&Records) -> Result<T, Unavailable> + Send + 'static,
    ) -> Result<T, Unavailable> {
        let (sender, receiver) = oneshot::channel();
        // Whoever has gone does not want the answer.
        let request = Request::Read(Box::new(move |records| drop(sender.send(read(records)))));
        self.requests.send(request).map_err(|_| closed())?;
        receiver.await.unwrap_or_else(|_| Err(closed()))
    }

    /// Whether a change was refused, and none as large was made since.
    pub(super) fn is_failing(&self) -> bool {
        self.last.lock().is_some()
    }

    /// For [`Recorder::read`], where a change was refused: whether as much could be written now.
    pub(super) fn probe(&self) -> impl FnOnce(&Records) -> Result<(), Unavailable> + Send + 'static {
        let last = Arc::clone(&self.last);
        move |records| {
            // What was written meanwhile may have told.
            let Some(refused) = last.lock().clone() else { return Ok(()) };
            records.probe(refused.bytes).map_err(|_| refused.fault)?;
            *last.lock() = None;
            Ok(())
        }
    }

    /// Makes what was asked before durable, and closes the database.
    pub(super) async fn close(&self) {
        let (sender, receiver) = oneshot::channel();
        if self.requests.send(Request::Close(sender)).is_ok() {
            drop(receiver.await);
        }
    }
}

fn closed() -> Unavailable {
    Unavailable("closed".to_owned())
}

struct Server {
    records: Records,
    /// Ends of jobs that could not be recorded; tried again until they can.
    failed: Vec<(Box<Write>, Reply)>,
    last: LastRefused,
}

impl Server {
    fn serve(mut self, requests: &Receiver<Request>) {
        loop {
            let wait = if self.failed.is_empty() { IDLE } else { RETRY };
            match requests.recv_timeout(wait) {
                Ok(first) => {
                    let batch = std::iter::once(first).chain(requests.try_iter()).take(BATCH);
                    if let Some(closed) = self.serve_batch(batch.collect()) {
                        // The lock is given up before it is told.
                        drop(self);
                        drop(closed);
                        return;
                    }
                }
                Err(RecvTimeoutError::Timeout) => self.idle(),
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    fn serve_batch(&mut self, requests: Vec<Request>) -> Option<Closed> {
        let mut writes = std::mem::take(&mut self.failed);
        let (mut reads, mut closed) = (Vec::new(), None);
        for request in requests {
            match request {
                Request::Write(write, reply) => writes.push((write, reply)),
                Request::Read(read) => reads.push(read),
                Request::Close(sender) => closed = Some(sender),
            }
        }
        self.write(writes);
        for read in reads {
            read(&self.records);
        }
        closed
    }

    fn write(&mut self, writes: Vec<(Box<Write>, Reply)>) {
        if writes.is_empty() {
            return;
        }
        let results = self.records.write(&writes.iter().map(|(write, _)| write.as_ref()).collect::<Vec<_>>());
        let mut last = self.last.lock();
        *last = after(last.take(), &writes, &results);
        drop(last);
        for ((write, reply), result) in writes.into_iter().zip(results) {
            match (write.as_ref(), result) {
                (Write::Finish { .. }, Err(fault)) => {
                    if self.failed.is_empty() {
                        tracing::warn!(%fault, "ends of jobs are not recorded yet");
                    }
                    self.failed.push((write, reply));
                }
                (_, result) => reply(result),
            }
        }
    }

    fn idle(&mut self) {
        let failed = std::mem::take(&mut self.failed);
        self.write(failed);
        if let Err(fault) = self.records.forget() {
            tracing::warn!(%fault, "old jobs are not forgotten yet");
        }
    }
}

/// What is known after another writing. One that was smaller than what was refused proves nothing.
fn after(
    before: Option<Refused>,
    writes: &[(Box<Write>, Reply)],
    results: &[Result<(), Unavailable>],
) -> Option<Refused> {
    let bytes = writes.iter().map(|(write, _)| write.bytes()).max().unwrap_or_default();
    match results.iter().find_map(|result| result.clone().err()) {
        Some(fault) => {
            let larger = before.map_or(bytes, |before| before.bytes.max(bytes));
            Some(Refused { fault, bytes: larger })
        }
        None => before.filter(|before| before.bytes > bytes),
    }
}

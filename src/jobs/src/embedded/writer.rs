//! The thread that owns the database. It makes the changes of many callers durable in one transaction.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use parking_lot::Mutex;
use tokio::sync::oneshot;

use super::records::Records;
use super::records::record::Write;
use crate::error::UnavailableError;

/// Most changes in one transaction.
const BATCH: usize = 512;

/// Time after which failed changes are tried again if there are no others.
const RETRY: Duration = Duration::from_secs(1);

/// Time after which old jobs are deleted if there are no changes.
const IDLE: Duration = Duration::from_mins(1);

/// Called on the writer's thread with the result of a change.
type Reply = Box<dyn FnOnce(Result<(), UnavailableError>) + Send>;

/// Dropped when the database is closed.
type Closed = oneshot::Sender<()>;

enum Request {
    Write(Box<Write>, Reply),
    Read(Box<dyn FnOnce(&Records) + Send>),
    Close(Closed),
}

/// A change that could not be made durable.
#[derive(Clone, Debug)]
struct FailedWrite {
    error: UnavailableError,
    /// Bytes of the largest change that has failed.
    bytes: usize,
}

/// The last failed change, until one as large has succeeded.
type LastFailure = Arc<Mutex<Option<FailedWrite>>>;

/// Requests are served in their order. Their number is bounded by the callers: the bound of the queue limits changes, a
/// semaphore limits reads.
pub(super) struct Writer {
    requests: Sender<Request>,
    last_failure: LastFailure,
}

impl Writer {
    pub(super) fn start(records: Records) -> std::io::Result<Self> {
        let (requests, receiver) = mpsc::channel();
        let last_failure = LastFailure::default();
        let server = Server { records, unrecorded: Vec::new(), last_failure: Arc::clone(&last_failure) };
        thread::Builder::new().name("jobs-writer".to_owned()).spawn(move || server.serve(&receiver))?;
        Ok(Self { requests, last_failure })
    }

    pub(super) fn write(&self, write: Write) {
        self.write_then(write, drop);
    }

    /// Calls `reply` with the result. Drops it without a call if the database was closed before.
    pub(super) fn write_then(
        &self,
        write: Write,
        reply: impl FnOnce(Result<(), UnavailableError>) + Send + 'static,
    ) {
        drop(self.requests.send(Request::Write(Box::new(write), Box::new(reply))));
    }

    pub(super) async fn read<T: Send + 'static>(
        &self,
        read: impl FnOnce(&Records) -> Result<T, UnavailableError> + Send + 'static,
    ) -> Result<T, UnavailableError> {
        let (sender, receiver) = oneshot::channel();
        // If the caller has gone, nobody needs the answer.
        let request = Request::Read(Box::new(move |records| drop(sender.send(read(records)))));
        self.requests.send(request).map_err(|_| UnavailableError::closed())?;
        receiver.await.unwrap_or_else(|_| Err(UnavailableError::closed()))
    }

    /// Whether a change has failed, and none as large has succeeded since.
    pub(super) fn is_failing(&self) -> bool {
        self.last_failure.lock().is_some()
    }

    /// Tries to write as many bytes as the change that has failed.
    pub(super) async fn probe(&self) -> Result<(), UnavailableError> {
        let last_failure = Arc::clone(&self.last_failure);
        let probe = move |records: &Records| {
            // A change may have succeeded meanwhile.
            let Some(failed) = last_failure.lock().clone() else { return Ok(()) };
            records.probe(failed.bytes).map_err(|_| failed.error)?;
            *last_failure.lock() = None;
            Ok(())
        };
        self.read(probe).await
    }

    /// Serves the earlier requests and closes the database.
    pub(super) async fn close(&self) {
        let (sender, receiver) = oneshot::channel();
        if self.requests.send(Request::Close(sender)).is_ok() {
            drop(receiver.await);
        }
    }
}

struct Server {
    records: Records,
    /// Ends of jobs that could not be recorded yet.
    unrecorded: Vec<(Box<Write>, Reply)>,
    last_failure: LastFailure,
}

impl Server {
    fn serve(mut self, requests: &Receiver<Request>) {
        loop {
            let wait = if self.unrecorded.is_empty() { IDLE } else { RETRY };
            match requests.recv_timeout(wait) {
                Ok(first) => {
                    let batch = std::iter::once(first).chain(requests.try_iter()).take(BATCH);
                    if let Some(closed) = self.serve_batch(batch.collect()) {
                        // Releases the lock on the directory before the caller continues.
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
        let mut writes = std::mem::take(&mut self.unrecorded);
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
        let bytes = writes.iter().map(|(write, _)| write.bytes()).max().unwrap_or_default();
        self.note_result(bytes, results.iter().find_map(|result| result.clone().err()));
        for ((write, reply), result) in writes.into_iter().zip(results) {
            match (write.as_ref(), result) {
                (Write::Finish { .. }, Err(error)) => {
                    if self.unrecorded.is_empty() {
                        tracing::warn!(%error, "ends of jobs are not recorded yet");
                    }
                    self.unrecorded.push((write, reply));
                }
                (_, result) => reply(result),
            }
        }
    }

    /// Remembers a failure, or forgets an earlier one. The success of a smaller change than the failed one proves
    /// nothing.
    fn note_result(&self, bytes: usize, error: Option<UnavailableError>) {
        let mut last = self.last_failure.lock();
        let before = last.take();
        *last = match error {
            Some(error) => {
                let largest = before.map_or(bytes, |before| before.bytes.max(bytes));
                Some(FailedWrite { error, bytes: largest })
            }
            None => before.filter(|before| before.bytes > bytes),
        };
    }

    fn idle(&mut self) {
        let unrecorded = std::mem::take(&mut self.unrecorded);
        self.write(unrecorded);
        if let Err(error) = self.records.forget() {
            tracing::warn!(%error, "old jobs are not deleted yet");
        }
    }
}

//! The body of a request that is read ahead, in bounded memory, while its first bytes are used.
//!
//! Many clients send the whole body before they read anything. Such a client and a service that waits until its answer
//! is read would wait for each other; up to the limit of memory the service therefore reads on.

use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::body::{Body, Bytes};
use futures_util::FutureExt;
use http_body_util::BodyExt;
use tokio::sync::{OwnedSemaphorePermit, Semaphore, mpsc};
use tokio::time::timeout;

use crate::http::client::Client;
use crate::http::error::{AccessError, HttpError, RequestError};
use crate::limits::error::LimitError;

/// The unit in which memory is counted, bytes.
const UNIT: usize = 1024;

/// How long the client may send nothing.
const LONGEST_PAUSE: Duration = Duration::from_mins(1);

/// Least bytes that the client sends in this time, on average: some 200 rows.
const LEAST_BYTES: u32 = 16 * 1024;

/// The time for which the service still waits for a client. Bytes add to it, so that a client that sends single bytes
/// does not occupy a place for ever.
#[derive(Debug)]
struct Patience(Duration);

impl Patience {
    fn waited(&mut self, time: Duration) {
        self.0 = self.0.saturating_sub(time);
    }

    fn received(&mut self, bytes: usize) {
        let bytes = u32::try_from(bytes).unwrap_or(u32::MAX).min(LEAST_BYTES);
        self.0 = LONGEST_PAUSE.min(self.0 + LONGEST_PAUSE * bytes / LEAST_BYTES);
    }
}

/// Bytes of the body, with their part of the memory.
type Held = (Bytes, OwnedSemaphorePermit);

/// The bytes of the body, in order.
pub(crate) struct ReadAhead(mpsc::UnboundedReceiver<Result<Held, HttpError>>);

impl ReadAhead {
    /// Begins to read, with memory for this many bytes.
    pub(crate) fn new(body: Body, client: Client, bytes: usize) -> Self {
        let (sender, receiver) = mpsc::unbounded_channel();
        drop(tokio::spawn(async move {
            let outcome = tokio::select! {
                outcome = read(body, bytes, &sender) => outcome,
                () = client.revoked() => Err(AccessError::Unauthorized.into()),
                // Nobody needs the rest.
                () = sender.closed() => Ok(()),
            };
            if let Err(error) = outcome {
                drop(sender.send(Err(error)));
            }
        }));
        Self(receiver)
    }

    /// Waits for the next bytes; `None` at the end.
    pub(crate) async fn next(&mut self) -> Option<Result<Bytes, HttpError>> {
        self.0.recv().await.map(|held| held.map(|(bytes, _)| bytes))
    }

    /// The next bytes if they have arrived.
    pub(crate) fn next_arrived(&mut self) -> Option<Result<Bytes, HttpError>> {
        self.next().now_or_never().flatten()
    }
}

async fn read(
    mut body: Body,
    bytes: usize,
    sender: &mpsc::UnboundedSender<Result<Held, HttpError>>,
) -> Result<(), HttpError> {
    let units = (bytes / UNIT).clamp(1, Semaphore::MAX_PERMITS.min(u32::MAX as usize));
    let memory = Arc::new(Semaphore::new(units));
    let mut patience = Patience(LONGEST_PAUSE);
    loop {
        let began = Instant::now();
        let frame = timeout(patience.0, body.frame()).await.map_err(|_| slow())?;
        patience.waited(began.elapsed());
        let Some(frame) = frame else { break };
        let frame = frame.map_err(|error| RequestError::UnreadableBody(error.to_string()))?;
        let Ok(data) = frame.into_data() else { continue };
        patience.received(data.len());
        let wanted = u32::try_from(data.len().div_ceil(UNIT).clamp(1, units)).unwrap_or(u32::MAX);
        let permit = Arc::clone(&memory).acquire_many_owned(wanted).await;
        let permit = permit.map_err(|_| LimitError::Overloaded)?;
        if sender.send(Ok((data, permit))).is_err() {
            break;
        }
    }
    Ok(())
}

fn slow() -> RequestError {
    let (bytes, seconds) = (LEAST_BYTES, LONGEST_PAUSE.as_secs());
    RequestError::UnreadableBody(format!("it arrives too slowly: fewer than {bytes} bytes in {seconds} s"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use axum::body::{Body, Bytes};
    use futures_util::{StreamExt, stream};

    use super::{LEAST_BYTES, LONGEST_PAUSE, Patience, ReadAhead, UNIT};
    use crate::http::client::Client;
    use crate::wire::role::Role;

    fn client() -> Client {
        let name = "a".to_owned();
        Client { name, role: Role::Read, has_quota: false, is_cross_origin: false, bucket: None, key: None }
    }

    #[tokio::test]
    async fn an_endless_body_is_read_as_far_as_there_is_memory() {
        let produced = Arc::new(AtomicUsize::new(0));
        let counter = Arc::clone(&produced);
        let endless = stream::repeat_with(move || {
            counter.fetch_add(1, Ordering::Relaxed);
            Ok::<_, std::io::Error>(Bytes::from_static(&[0; UNIT]))
        });
        let mut body = ReadAhead::new(Body::from_stream(endless.boxed()), client(), 8 * UNIT);
        for taken in 1..100 {
            assert_eq!(body.next().await.unwrap().unwrap().len(), UNIT);
            tokio::task::yield_now().await;
            // One frame more waits for memory.
            assert!(produced.load(Ordering::Relaxed) <= taken + 9);
        }
    }

    #[test]
    fn single_bytes_do_not_keep_a_place() {
        let mut patience = Patience(LONGEST_PAUSE);
        for _ in 0..100 {
            patience.waited(LONGEST_PAUSE / 50);
            patience.received(1);
        }
        assert!(patience.0 < LONGEST_PAUSE / 1000, "{patience:?}");
    }

    #[test]
    fn a_steady_client_is_waited_for() {
        let mut patience = Patience(LONGEST_PAUSE);
        for _ in 0..100 {
            patience.waited(LONGEST_PAUSE / 2);
            patience.received(LEAST_BYTES as usize);
            assert_eq!(patience.0, LONGEST_PAUSE);
        }
        patience.received(usize::MAX);
        patience.waited(LONGEST_PAUSE);
        assert!(patience.0.is_zero());
    }

    #[tokio::test]
    async fn a_body_ends() {
        let mut body = ReadAhead::new(Body::from("abc"), client(), UNIT);
        assert_eq!(body.next().await.unwrap().unwrap(), "abc");
        assert!(body.next().await.is_none() && body.next_arrived().is_none());
    }
}

//! The back end of many processes: a broker, NATS JetStream 2.10 or later, stores the records and the queues.
//!
//! A process with a [connection](JetStream::connect) submits, watches and cancels jobs; one that also has a [`Worker`]
//! runs them. All processes are equal otherwise, and none stores anything that must last.
//!
//! # Data at the broker
//!
//! - A bucket (`NAME-jobs`) contains each job's record under its id. Records are written by compare-and-set: of equal
//!   submissions in any processes, one starts the job and the others join it.
//! - A stream (`NAME-queue`) contains a message for each job that is queued or running. It has a queue for small jobs,
//!   one for subtasks and one for large jobs. The record is written first: a message may come late or twice, and then
//!   has no effect.
//! - Progress and heartbeats are messages that are not stored.
//!
//! Every name contains the version of the layout. Processes with another layout do not share jobs with these. So
//! programs can be replaced one after the other, and each job is run by the programs that can read it.
//!
//! # Guarantees
//!
//! - An accepted job is not lost while the broker stores what it acknowledges (`sync_interval: always` on one machine).
//!   If its worker is lost, the message comes back after [`ack_wait`](Config::ack_wait). If the submitting process is
//!   lost before it queues the job, [any process](Config::requeue_after) queues it.
//! - One worker at a time runs a job, as long as the others receive its keep-alive messages. A worker that comes back
//!   after that finds that its attempt was replaced, and stops. A message is acknowledged after the result is stored
//!   and recorded.
//! - A job that has lost its worker [too often](Config::max_attempts) fails; the broker sends a note.
//! - A job's record names the processes with claims on it. A process [without heartbeats](Config::lease) has no claims
//!   any more, so its jobs are cancelled as if it had dropped them, unless they were detached.
//! - The claims on subtasks belong to their parent, whichever worker runs it. They end with it.
//!
//! # Differences to [`Embedded`](crate::Embedded)
//!
//! - Order: a queue is first come, first served. But a worker moves a job to the end of its queue if another client has
//!   a job in that queue and fewer jobs running, up to 64 times before it starts one. Costs do not count. A worker's
//!   main slots take from all queues; its express slot takes small jobs, which overtake others thereby. A worker whose
//!   main slots run jobs of one client only looks ten times a second for another client's job, and runs it in its guest
//!   slot. Subtasks do not wait behind large jobs that were queued before their parent started. A parent's merge is the
//!   next job of its worker.
//! - A process knows the changes of others some milliseconds later. So submissions at the same time may exceed the
//!   bounds of the queue, and a subtask may start just after its parent has failed.
//! - If a worker is lost while a parent waits for its subtasks, this counts as an attempt of the parent.
//! - Deadlines and the order of lists depend on the clocks of the machines.

mod backend;
mod claim_recorder;
mod claims;
mod client;
mod config;
mod connection;
mod dead_letter;
mod denials;
mod heartbeat;
mod nats;
mod progress_message;
mod queue_class;
mod reaper;
mod record;
mod replica;
mod subscriptions;
mod worker;

pub use backend::JetStream;
pub use config::{Config, ConnectError, Setting, WorkerConfig};
pub use worker::{Occupancy, Worker};

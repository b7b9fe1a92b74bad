//! Jobs: long computations that outlive their requests. What is computed is the caller's [`Work`]; here are its
//! queue, its threads and its records.
//!
//! # A job's life
//!
//! A [`Submission`] names its job by the hash of what it makes. Equal submissions are one job, computed once, however many
//! [claim](Claim) it. It is queued, runs, and ends [succeeded](State::Succeeded), [failed](State::Failed) or
//! [cancelled](State::Cancelled); when the last claim is dropped of a job that nobody [kept](Claim::keep), it is
//! cancelled. Submitted again after its end it lives anew. A job whose process dies is run again by the next,
//! unless it was running at so many deaths that it is likely their cause ([`Failure::TooManyAttempts`]).
//!
//! # Jobs of parts
//!
//! A job may have [parts](Work::parts): jobs of their own, shared with whoever asks for the same. When its turn comes they
//! are submitted, no more than some hundreds at a time, and it waits for them without a thread,
//! [running](State::Running), with the mean of their progress by cost; when all have succeeded it is the next to run,
//! and merges. A part that fails fails it with the same failure, a part that is cancelled by name cancels it; when it
//! ends, parts that nobody else wants are cancelled. Parts take places in the queue and wait for them, and are not
//! [listed](Backend::list) unless somebody submits them by themselves.
//!
//! # Back ends
//!
//! [`Embedded`] keeps and runs jobs in one process; [`JetStream`] shares them among many. What follows is the embedded one's;
//! [where the other differs](jetstream) is said there.
//!
//! # Which job is next
//!
//! Self-clocked fair queueing (Golestani 1994): a job's tag is the greater of the virtual time and its client's last tag in
//! the queue, plus its cost. The least tag is next; the virtual time is the greatest tag taken, but passes none
//! that still waits. A job's parts are tagged as if they had been submitted in its place one after the other. So a job of
//! cost c waits for what runs and, of each other client, for no more than c and one job beyond it, however much they
//! have queued. A job that several clients ask for stands where the best placed of them would have
//! put it, and is charged to that one. A job that has waited longer than a set time
//! ([`overdue`](embedded::Config::overdue)) goes before all that have not, the oldest first; so none waits for ever.
//!
//! # Which threads it has
//!
//! The main lane runs any job, with all the threads. While it is taken, the express lane runs the next small job
//! ([`small`](embedded::Config::small)) beside it, with one thread. While one client's jobs have the whole main lane, the
//! guest lane runs the next job of another client beside it; if a seat of the main lane becomes free then, it is for a
//! client that does not have the guest lane. So the jobs of one client never have all seats while others wait. Meanwhile
//! as many threads of the main lane rest, so the number of busy cores stays as set.
//!
//! A job that holds the express lane for five times as long as it was estimated at, and for a second, is stopped and queued
//! again with the cost that it has shown.
//!
//! Parts of what is not small itself are for the main lane: a large job cut into small ones would have the lane that small
//! jobs pass it on. On Linux all of them give way to the process's other threads. A thread rests at a look at
//! [`Watch::cancelled`], and at most as long as it has worked since it last rested: jobs beside it without end leave it half
//! of its time.

mod backend;
mod claim;
mod clients;
pub mod embedded;
mod feed;
mod id;
pub mod jetstream;
mod job;
mod moment;
mod threads;
mod work;

pub use backend::{Backend, Counts, Cursor, Filter, NotACursor, Page, Seats, SubmitError, Unavailable};
pub use claim::Claim;
pub use clients::Clients;
pub use embedded::Embedded;
pub use feed::Watcher;
pub use id::{JobId, NotAJobId};
pub use jetstream::JetStream;
pub use job::{Failure, Job, MAX_COST, State, Submission};
pub use work::{Stop, Watch, Work};

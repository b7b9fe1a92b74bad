//! A queue for long computations that outlive their requests. The caller implements [`Work`], which computes; this
//! crate queues jobs, runs them on its threads and records their states.
//!
//! # Life of a job
//!
//! A [`Submission`] names its job by the hash of the result. Equal submissions are one job, which is computed once,
//! however many [claims](Claim) exist. The job is queued, runs, and ends as [succeeded](State::Succeeded),
//! [failed](State::Failed) or [cancelled](State::Cancelled). If the last claim is dropped and no claim was
//! [detached](Claim::detach), the job is cancelled. A submission after the end starts a new *generation* of the job.
//!
//! If the process dies, the next process runs its jobs again. A job that was running at too many deaths is likely their
//! cause; it fails with [`Failure::TooManyAttempts`].
//!
//! # Subtasks
//!
//! A job may have [subtasks](Work::subtasks). Subtasks are jobs, and other jobs may have the same ones. The parent
//! submits its subtasks when it leaves the queue, a few hundred at a time. It then waits without a thread, its state is
//! [running](State::Running), and its progress is the mean of its subtasks' progress, weighted by cost. When all
//! subtasks have succeeded, the parent goes to the front of the queue and merges their results.
//!
//! If a subtask fails, its parent fails with the same failure. If somebody cancels a subtask by its id, its parent is
//! cancelled. When the parent ends, subtasks without other claims are cancelled. Subtasks take room in the queue and
//! wait for it. They are not [listed](Backend::list) unless a client has submitted them.
//!
//! # Back ends
//!
//! [`Embedded`] stores and runs jobs in one process; [`JetStream`] shares jobs among many processes. The rest of this
//! page describes the embedded back end; [`jetstream`] states the differences.
//!
//! # Order
//!
//! The queue is a self-clocked fair queue (Golestani 1994). A job's tag is its cost plus the greater of the virtual
//! time and the last tag of its client in the queue. The job with the least tag is next. The virtual time is the
//! greatest tag that has left the queue, but not more than the least tag that waits. A parent's subtasks have the tags
//! that they would have if they had been submitted one after the other in its place. So a job of cost c waits for the
//! running jobs and, of each other client, for a cost of at most c and one job more, whatever that client has queued.
//!
//! A job that several clients submit has the least of the tags that their submissions would have, and counts for the
//! client with that tag. A job that has waited longer than [`overdue_after`](embedded::Config::overdue_after) goes
//! before all jobs that have not, the oldest first. So no job waits for ever.
//!
//! # Slots and threads
//!
//! A slot runs one job at a time. The *main* slots run any job and share all threads. If they are all busy, the
//! *express* slot runs the next small job ([`small_cost`](embedded::Config::small_cost)) on one thread. If they are all
//! busy with jobs of one client, the *guest* slot runs the next job of another client. If a main slot becomes free
//! while the guest slot is busy, the next job there is one of a client without the guest slot. So one client's jobs
//! never have all slots while others wait. While the express or the guest slot is busy, as many threads of the main
//! slots pause, so the number of busy cores stays the same.
//!
//! A job that occupies the express slot for five times its estimated time, and for at least a second, is stopped. It is
//! queued again with the cost that it has shown, and as one that is not small: so this happens to a job once at most.
//!
//! Subtasks of a large job run in the main slots only. Otherwise a large job that is cut into small ones would fill the
//! slot in which small jobs pass it. A thread pauses in [`RunControl::cancelled`], and at most as long as it has worked
//! since its last pause. So a job has at least half of its time, whatever runs beside it. On Linux the threads of jobs
//! have a lower priority than the other threads of the process.

mod backend;
mod claim;
mod clients;
mod counts;
pub mod embedded;
mod error;
mod execution;
pub mod jetstream;
mod job;
mod job_id;
mod job_watch;
mod page;
mod retention;
mod subtasks;
mod timestamp;
mod work;

pub use backend::Backend;
pub use claim::Claim;
pub use clients::Clients;
pub use counts::{Counts, Slots};
pub use embedded::Embedded;
pub use error::{SubmitError, UnavailableError};
pub use jetstream::JetStream;
pub use job::{Failure, Job, MAX_COST, State, Submission};
pub use job_id::{JobId, ParseJobIdError};
pub use job_watch::Watcher;
pub use page::{Cursor, Filter, Page, ParseCursorError};
pub use retention::Retention;
pub use work::{RunControl, Work, WorkError};

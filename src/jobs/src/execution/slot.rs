//! Slots and their threads.

use std::io;
use std::sync::{Arc, Once};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Which jobs a slot runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SlotKind {
    /// Any job.
    Main,
    /// Small jobs.
    Express,
    /// Jobs of other clients while one client's jobs fill the main slots.
    Guest,
}

/// Runs one job at a time, with a thread pool of its own. In a pool for two jobs a thread that waits for a piece of one
/// job could start the other on top of it; then the first could not end before the second.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    pub(crate) kind: SlotKind,
    pub(crate) pool: Arc<ThreadPool>,
}

/// Distributes `threads` among `main` main slots, at least one to each, and adds the express and the guest slot.
/// `niceness` is added to the niceness of the threads.
pub(crate) fn slots(threads: usize, main: usize, niceness: i32) -> Result<Vec<Slot>, ThreadPoolBuildError> {
    let threads = threads.max(1);
    let main = main.clamp(1, threads);
    let share = |number| threads / main + usize::from(number < threads % main);
    let main =
        (0..main).map(|number| slot(SlotKind::Main, share(number), format!("jobs-{number}"), niceness));
    let others = [
        slot(SlotKind::Express, 1, "jobs-express".to_owned(), niceness),
        slot(SlotKind::Guest, share(0), "jobs-guest".to_owned(), niceness),
    ];
    main.chain(others).collect()
}

fn slot(kind: SlotKind, threads: usize, name: String, niceness: i32) -> Result<Slot, ThreadPoolBuildError> {
    let warned = Once::new();
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(move |thread| format!("{name}-{thread}"))
        .start_handler(move |_| {
            if let Err(error) = lower_priority(niceness) {
                warned.call_once(|| tracing::warn!(%error, "cannot lower the priority of job threads"));
            }
        })
        // A task that the work spawned outside of its own run; by default rayon aborts the process.
        .panic_handler(|_| tracing::error!("a task that a job had spawned panicked"))
        .build()?;
    Ok(Slot { kind, pool: Arc::new(pool) })
}

/// On Linux each thread has a niceness of its own. Elsewhere the process has one, which does not change.
#[cfg(target_os = "linux")]
fn lower_priority(niceness: i32) -> io::Result<()> {
    Ok(rustix::process::nice(niceness).map(drop)?)
}

#[cfg(not(target_os = "linux"))]
fn lower_priority(_: i32) -> io::Result<()> {
    Ok(())
}

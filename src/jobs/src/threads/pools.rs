//! The threads that compute.

use std::io;
use std::sync::{Arc, Once};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Which jobs a lane takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lane {
    /// Any.
    Main,
    /// Small ones.
    Express,
    /// Those of another client than the one that has the whole main lane.
    Guest,
}

/// Where one job at a time runs, with a pool of its own: in a pool for two jobs a thread that waits for a piece of the
/// one could begin the other on top of it, and the first would end with the second.
#[derive(Clone, Debug)]
pub(crate) struct Seat {
    pub(crate) lane: Lane,
    pub(crate) pool: Arc<ThreadPool>,
}

/// Deals `threads` out among `slots` of the main lane, at least one to each, and adds the express lane and the guest
/// lane. The threads are nicer by `courtesy` than others of the process.
pub(crate) fn seats(threads: usize, slots: usize, courtesy: i32) -> Result<Vec<Seat>, ThreadPoolBuildError> {
    let threads = threads.max(1);
    let slots = slots.clamp(1, threads);
    let share = |slot| threads / slots + usize::from(slot < threads % slots);
    let main = (0..slots).map(|slot| seat(Lane::Main, share(slot), format!("jobs-{slot}"), courtesy));
    let beside = [
        seat(Lane::Express, 1, "jobs-express".to_owned(), courtesy),
        seat(Lane::Guest, share(0), "jobs-guest".to_owned(), courtesy),
    ];
    main.chain(beside).collect()
}

fn seat(lane: Lane, threads: usize, name: String, courtesy: i32) -> Result<Seat, ThreadPoolBuildError> {
    let told = Once::new();
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(move |thread| format!("{name}-{thread}"))
        .start_handler(move |_| {
            if let Err(fault) = give_way(courtesy) {
                told.call_once(|| tracing::warn!(%fault, "threads for jobs have the priority of all others"));
            }
        })
        // What the work spawns apart from its own run; rayon would end the process.
        .panic_handler(|_| tracing::error!("a task that a job had spawned panicked"))
        .build()?;
    Ok(Seat { lane, pool: Arc::new(pool) })
}

/// On Linux each thread has a niceness of its own; elsewhere the process has one, and keeps it.
#[cfg(target_os = "linux")]
fn give_way(courtesy: i32) -> io::Result<()> {
    Ok(rustix::process::nice(courtesy).map(drop)?)
}

#[cfg(not(target_os = "linux"))]
fn give_way(_: i32) -> io::Result<()> {
    Ok(())
}

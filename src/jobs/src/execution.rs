//! Slots, their threads, and runs of jobs on them.

pub(crate) mod preemption;
pub(crate) mod run;
pub(crate) mod slot;
pub(crate) mod stop;

//! The threads that compute, and one run on them.

pub(crate) mod pools;
pub(crate) mod run;
pub(crate) mod turn;

//! The contract's JSON: requests, answers, and the units between them and the solver.

pub(crate) mod alphas;
pub(crate) mod answer;
pub(crate) mod batch;
pub(crate) mod capped;
pub(crate) mod catalogue;
pub(crate) mod contains;
pub(crate) mod degrees;
pub(crate) mod dexterity;
pub(crate) mod family;
pub(crate) mod format;
pub(crate) mod job;
pub(crate) mod json;
pub(crate) mod limit;
pub(crate) mod machine;
pub(crate) mod machine_ref;
pub(crate) mod margins;
pub(crate) mod numbers;
pub(crate) mod object;
pub(crate) mod parse;
pub(crate) mod query;
pub(crate) mod request;
pub(crate) mod slice;
pub(crate) mod span;
pub(crate) mod workspace;
pub(crate) mod workspace_query;
pub(crate) mod workspace_summary;

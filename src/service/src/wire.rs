//! The contract's JSON: requests, answers, and the units between them and the solver.

pub mod answer;
pub mod batch;
pub mod catalogue;
pub mod degrees;
pub mod limit;
pub mod machine;
pub mod machine_ref;
pub mod margins;
pub mod numbers;
pub mod parse;
pub mod query;
pub mod request;

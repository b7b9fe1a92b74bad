//! The JSON of requests, answers and errors, and the conversion between its degrees and the solver's radians.
//!
//! Imports no other folder of the service.

pub(crate) mod alphas;
pub(crate) mod answer;
pub(crate) mod batch;
pub(crate) mod bounded_list;
pub(crate) mod canonical_toolpath;
pub(crate) mod constraint;
pub(crate) mod contains;
pub(crate) mod degrees;
pub(crate) mod dexterity;
pub(crate) mod error;
pub(crate) mod family;
pub(crate) mod field_errors;
pub(crate) mod fixed_array;
pub(crate) mod format;
pub(crate) mod health;
pub(crate) mod json;
pub(crate) mod json_pointer;
pub(crate) mod json_text;
pub(crate) mod limit;
pub(crate) mod machine;
pub(crate) mod machine_list;
pub(crate) mod machine_ref;
pub(crate) mod margins;
pub(crate) mod missing;
pub(crate) mod parse;
pub(crate) mod program;
pub(crate) mod program_points;
pub(crate) mod program_query;
pub(crate) mod query;
pub(crate) mod query_string;
pub(crate) mod request;
pub(crate) mod result_id;
pub(crate) mod role;
pub(crate) mod slice;
pub(crate) mod strict_object;
pub(crate) mod sweep;
pub(crate) mod tool;
pub(crate) mod toolpath;
pub(crate) mod toolpath_query;
pub(crate) mod toolpath_report;
pub(crate) mod workspace;
pub(crate) mod workspace_query;
pub(crate) mod workspace_summary;

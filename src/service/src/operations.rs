//! From a checked question to its answer, for handlers, the command line and jobs. Knows no HTTP.
//!
//! May import `telemetry`, `limits` and `wire`.

pub(crate) mod batch_rows;
pub(crate) mod compute_pool;
pub(crate) mod contains;
pub(crate) mod dexterity;
pub(crate) mod dexterity_question;
pub(crate) mod dexterity_subtasks;
pub(crate) mod drawing;
pub(crate) mod family;
pub(crate) mod family_question;
pub(crate) mod forward;
pub(crate) mod forward_batch;
pub(crate) mod inverse;
pub(crate) mod inverse_batch;
pub(crate) mod job_executor;
pub(crate) mod machine_hash;
pub(crate) mod mesh_files;
pub(crate) mod nearest;
pub(crate) mod orientation;
pub(crate) mod question;
pub(crate) mod registry;
pub(crate) mod results;
pub(crate) mod slice;
pub(crate) mod solutions;
pub(crate) mod subprogress;
pub(crate) mod subtask;
pub(crate) mod table_angles;
pub(crate) mod workspace;
pub(crate) mod workspace_colours;
pub(crate) mod workspace_question;

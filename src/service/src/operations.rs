//! From a checked question to its answer, for handlers, the command line and jobs. Knows no HTTP.
//!
//! May import `telemetry`, `limits` and `wire`.
//!
//! - Kinematics: [`forward`], [`inverse`] and their batches. The solver computes the margins; [`solutions`] puts them
//!   into answers.
//! - [`atlas`] is the plane map of their solutions.
//! - Calibration: [`calibration_request`] and [`calibration_table`] read measurements, [`calibration`] answers.
//! - Error budgets: [`error_budget`] of poses, [`error_map`] over a workspace.
//! - Workspaces: [`workspace_question`], [`family_question`] and [`dexterity_question`] check requests; [`workspace`]
//!   and [`dexterity_map`] compute answers; [`mesh_files`], [`slice`] and [`drawing`] write files.
//! - Programs: a client's file is read while it arrives and kept in the result store ([`programs`]).
//! - Tool paths: [`toolpath_question`] checks requests; [`program_motions`] are what the planner reads; [`toolpath`]
//!   plans, [`toolpath_rows`] and [`toolpath_report`] are what it leaves. [`placement`] finds the best set-up,
//!   [`origins`] the region of origins.
//! - Jobs: a [`question`] is submitted as text ([`question_text`]); [`job_executor`] answers it, large ones in
//!   [`subtask`]s, and stores the [`results`].
//!
//! A new constraint of the solver needs a name and a unit in [`crate::wire::constraint`] and a colour in
//! [`workspace_colours`].

pub(crate) mod answer_columns;
pub(crate) mod atlas;
pub(crate) mod batch_rows;
pub(crate) mod blocking_results;
pub(crate) mod calibration;
pub(crate) mod calibration_options;
pub(crate) mod calibration_request;
pub(crate) mod calibration_table;
pub(crate) mod column_rows;
pub(crate) mod compute_pool;
pub(crate) mod contains;
pub(crate) mod contains_columns;
pub(crate) mod continuation;
pub(crate) mod continuous_rows;
pub(crate) mod dexterity_job;
pub(crate) mod dexterity_map;
pub(crate) mod dexterity_question;
pub(crate) mod dexterity_subtasks;
pub(crate) mod dexterity_table;
pub(crate) mod document_job;
pub(crate) mod drawing;
pub(crate) mod dwell_marks;
pub(crate) mod error_budget;
pub(crate) mod error_budget_columns;
pub(crate) mod error_budget_rows;
pub(crate) mod error_map;
pub(crate) mod error_map_colours;
pub(crate) mod error_map_job;
pub(crate) mod error_map_question;
pub(crate) mod error_map_subtasks;
pub(crate) mod error_map_table;
pub(crate) mod family_question;
pub(crate) mod family_table;
pub(crate) mod forward;
pub(crate) mod forward_batch;
pub(crate) mod forward_columns;
pub(crate) mod inverse;
pub(crate) mod inverse_batch;
pub(crate) mod inverse_columns;
pub(crate) mod inverse_rows;
pub(crate) mod jacobian_columns;
pub(crate) mod jacobians;
pub(crate) mod job_executor;
pub(crate) mod joint_program;
pub(crate) mod machine_hash;
pub(crate) mod machine_registry;
pub(crate) mod map_table;
pub(crate) mod mesh_files;
pub(crate) mod nearest;
pub(crate) mod observers;
pub(crate) mod origins;
pub(crate) mod origins_job;
pub(crate) mod origins_question;
pub(crate) mod outcome_columns;
pub(crate) mod part_row;
pub(crate) mod placement;
pub(crate) mod placement_question;
pub(crate) mod program_motions;
pub(crate) mod program_pace;
pub(crate) mod programs;
pub(crate) mod question;
pub(crate) mod question_cache;
pub(crate) mod question_text;
pub(crate) mod requested_orientation;
pub(crate) mod results;
pub(crate) mod row_stream;
pub(crate) mod row_tally;
pub(crate) mod slice;
pub(crate) mod solutions;
pub(crate) mod solver_errors;
pub(crate) mod stored_reader;
pub(crate) mod subtask;
pub(crate) mod table_angles;
pub(crate) mod toolpath;
pub(crate) mod toolpath_cost;
pub(crate) mod toolpath_glb;
pub(crate) mod toolpath_job;
pub(crate) mod toolpath_question;
pub(crate) mod toolpath_report;
pub(crate) mod toolpath_request;
pub(crate) mod toolpath_row_text;
pub(crate) mod toolpath_rows;
pub(crate) mod window;
pub(crate) mod window_question;
pub(crate) mod workspace;
pub(crate) mod workspace_colours;
pub(crate) mod workspace_question;

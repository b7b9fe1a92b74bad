//! Answers as tables and words for a terminal. `page` and `table` lay them out; the others read the JSON that the HTTP
//! service answers.

pub(crate) mod atlases;
pub(crate) mod calibration;
pub(crate) mod error_budgets;
pub(crate) mod jobs;
pub(crate) mod machines;
pub(crate) mod page;
pub(crate) mod solutions;
pub(crate) mod table;
pub(crate) mod values;
pub(crate) mod windows;
pub(crate) mod workspaces;

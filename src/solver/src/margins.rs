//! Signed margins of a posture against every constraint: positive inside, zero on the limit.

pub(crate) mod cone;
pub(crate) mod interference;
pub(crate) mod lesser_margins;
pub(crate) mod margin_batch;
mod margin_block;
mod margin_rows;
pub(crate) mod normalization;
mod posture_columns;
mod posture_margins;
mod worst;
mod worst_rows;

pub use margin_block::MarginBlock;
pub use margin_rows::{margin_rows, worst_margin_rows};
pub use posture_columns::PostureColumns;
pub use posture_margins::Margins;

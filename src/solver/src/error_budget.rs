//! Error budgets: how far the tool's end and axis may be off, for given tolerances of a machine's parameters.
//!
#![doc = include_str!("error_budget/error_budget.md")]

mod budget;
mod farthest_vertex;
mod tolerances;

pub use budget::{Displacement, ErrorBudget, ErrorFigure};
pub use tolerances::{ToleranceError, Tolerances};

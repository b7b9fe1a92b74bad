//! Kinematics of the VERNE machine's architecture: a parallel module with three unlike legs on
//! vertical sliders, and a tilting table.
//!
//! The equation numbers are those of D. Kanaan, P. Wenger, D. Chablat, *Workspace and Kinematic Analysis of the VERNE
//! machine*, AIM 2007 ([arXiv:0707.3507](https://arxiv.org/abs/0707.3507)). Lengths are millimetres, angles radians.
//! z points **down** in the base frame, and up from the table in the part frame. All functions are pure. None panics
//! and none returns a NaN. The solver checks every posture by Eqs (3)-(6) before it returns it. The workspace is
//! derived in [`workspace`]. [`certificate`] proves solutions.
//!
#![doc = include_str!("kinematics.md")]
//!
//! # Examples
//!
//! Each module's functions have examples. Three programs show more: `cargo run -p verne-solver --example forward`,
//! `inverse` and `workspace`.

// The tests inside the crate share code with those outside.
#[cfg(test)]
extern crate self as verne_solver;

#[cfg(test)]
#[path = "../tests/support/random.rs"]
mod random;

pub mod atlas;
pub mod axis;
pub mod calibration;
pub mod certificate;
mod clearance;
mod error;
pub mod error_budget;
mod fast_math;
mod forward;
mod interval;
mod inverse;
pub mod jacobian;
mod jet;
mod limit;
mod loop_closure;
pub mod machine;
mod margins;
mod mechanism;
mod parallel_matrix;
pub mod parameter;
mod pose;
mod posture;
mod posture_rows;
mod registers;
mod request_range;
mod residual;
mod rods;
mod table;
mod tool_motion;
pub mod toolpath;
mod trig_polynomial;
mod turns;
pub mod workspace;

pub use clearance::Clearance;
pub use error::KinematicsError;
pub use forward::{forward, forward_working, forward_working_rows};
pub use inverse::{
    part, part_every_working, part_working, part_working_rows, platform, platform_working,
    platform_working_rows, tool, tool_every_working, tool_working, tool_working_rows,
};
pub use limit::{Constraint, Element, Margin};
pub use machine::{Machine, MachineData, MachineError};
pub use margins::{MarginBlock, Margins, PostureColumns, margin_rows, worst_margin_rows};
pub use pose::{PartPose, PlatformPose, Point, TableAngles};
pub use posture::{MAX_POSTURES, Mode, Posture, Postures, Side};
pub use registers::{BLOCK_ROWS, Registers};
pub use request_range::{MAX_INPUT, MAX_LENGTH_RATIO};
pub use table::{SplitAngle, Winding, part_pose, rotary_windings, table_angles, table_windings, tool_point};

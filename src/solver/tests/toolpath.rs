//! Plans of tool paths against independent checks.
//!
//! - `lines`: numbers of rows and deviations of single motions.
//! - `choices`: preimages and windings of whole programs.
//! - `drives`: velocities that are refused, and what drives change in a plan.
//! - `pole`: paths along, through and to the pole.
//! - `machines`: programs on machines unlike the reference machine, arcs, and rapids.
//! - `starts`: programs that begin where the machine stands.
//! - `tool_changes`: motions that begin with another tool in the same joints.
//! - `held`: programs whose phi2 is kept at the pole.
//! - `unlimited`: programs on a machine whose table turns without a limit.
//! - `limits`: what happens at limits: retracting, and changes that heal.
//! - `least_margins`: least margins between rows.
//! - `timing`: times of rows.
//! - `single_slider`: times of motions that are known in closed form.
//! - `origins`: the region of origins against plans at random origins.
//! - `origins_surface`: the surface of the region against the region.
//! - `parametric`: programs with one free parameter of their set-up.
//! - `placement`: set-ups with the greatest reserve.
//! - `random_programs`: programs on machines unlike the built-in one.
//! - `window`: windows of a parameter against bisection on the verdict.
//! - `support`: programs, and the check of rows by the forward problem.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    reason = "tests"
)]

#[path = "toolpath/choices.rs"]
mod choices;
#[path = "toolpath/drives.rs"]
mod drives;
#[path = "toolpath/held.rs"]
mod held;
#[path = "toolpath/least_margins.rs"]
mod least_margins;
#[path = "toolpath/limits.rs"]
mod limits;
#[path = "toolpath/lines.rs"]
mod lines;
#[path = "toolpath/machines.rs"]
mod machines;
#[path = "toolpath/origins.rs"]
mod origins;
#[path = "toolpath/origins_surface.rs"]
mod origins_surface;
#[path = "toolpath/parametric.rs"]
mod parametric;
#[path = "toolpath/placement.rs"]
mod placement;
#[path = "toolpath/pole.rs"]
mod pole;
#[path = "support/random.rs"]
mod random;
#[path = "toolpath/random_programs.rs"]
mod random_programs;
#[path = "toolpath/single_slider.rs"]
mod single_slider;
#[path = "toolpath/starts.rs"]
mod starts;
#[path = "toolpath/support.rs"]
mod support;
#[path = "toolpath/timing.rs"]
mod timing;
#[path = "toolpath/tool_changes.rs"]
mod tool_changes;
#[path = "toolpath/unlimited.rs"]
mod unlimited;
#[path = "toolpath/window.rs"]
mod window;

//! The solver against the reference sets, the oracle and the laws of the machine.

mod axis;
mod conditioning;
mod counts;
mod degenerate_angles;
mod fuzz;
mod interference;
mod leg_limits;
mod level_leg;
mod machine_faults;
mod margins;
mod parallel_singularity;
mod proportional_machine;
mod proportions;
mod reference_sets;
mod refusals;
mod round_trip;
mod several_working;
mod symmetric_sliders;
mod symmetry_plane;
mod translation;
mod velocities;
mod windings;
mod working;
mod worst_margin;

//! The solver against the reference sets, the oracle and laws of the machine.

mod arbitrary_numbers;
mod axis;
mod common_lift;
mod conditioning;
mod degenerate_angles;
mod interference;
mod invalid_machines;
mod leg_limits;
mod level_leg;
mod margins;
mod parallel_singularity;
mod proportional_machine;
mod proportions;
mod reference_sets;
mod round_trip;
mod several_working_postures;
mod solution_counts;
mod symmetric_sliders;
mod symmetry_plane;
mod unreachable;
mod velocities;
mod windings;
mod working_mode;
mod worst_margin;

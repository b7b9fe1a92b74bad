//! Paths along, through and to the pole.

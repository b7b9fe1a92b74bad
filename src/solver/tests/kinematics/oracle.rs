//! All solutions by brute force: the unsquared equations (3)-(6) scanned along alpha for both
//! signs of leg I's root, bisected, and polished on the lengths of the rods. Slow, simple, and
//! ignorant of how the solver works: of a machine it reads the plain data only.

mod agreement;
mod angle_roots;
mod comparison;
pub(crate) mod constructed_postures;
mod forward;
mod inverse;
mod legs;
mod oracle_tests;
mod polish;
mod solution;

pub(crate) use agreement::{distance, listed};
pub(crate) use comparison::Comparison;
pub(crate) use forward::forward;
pub(crate) use inverse::{Path, inverse};
pub(crate) use legs::Legs;
pub(crate) use solution::{Answer, Found, wrapped};

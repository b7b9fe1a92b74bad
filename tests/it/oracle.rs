//! All solutions by brute force: the unsquared equations (3)-(6) scanned along alpha for both
//! signs of leg I's root, bisected, and polished on the lengths of the rods. Slow, simple, and
//! ignorant of how the solver works: of a machine it reads the plain data only.

mod agreement;
pub(crate) mod built;
mod circle;
mod comparison;
mod forward;
mod found;
mod inverse;
mod legs;
mod polish;
mod truth;

pub(crate) use agreement::{distance, listed};
pub(crate) use comparison::Comparison;
pub(crate) use forward::forward;
pub(crate) use found::{Answer, Found, wrapped};
pub(crate) use inverse::{Path, inverse};
pub(crate) use legs::Legs;

//! The loop closure as two equations in (a, w), regular where its eliminated polynomial is not.
//!
//! Both directions of the kinematics lead to the platform angle a and one length-like unknown w (w1 itself for the
//! inverse problem, λ = w1/u for the forward problem), with one equation linear in w and one quadratic. Eliminating w
//! gives a trigonometric polynomial whose factors are the two *branches* w₊(a) and w₋(a). If both branches have a root
//! at (nearly) the same angle (the symmetry plane; S = 2 rho1 - rho2 - rho3 ≈ 0), the polynomial has a (nearly) double
//! root that double precision cannot resolve, but (a, w) has two well separated, simple solutions. Only where one
//! branch itself touches zero do two solutions merge: a singularity.

mod branch;
mod branch_intervals;
mod double_root;
mod equations;
mod newton;
mod newton_rows;
mod search;

pub(crate) use equations::{CONVERGED_STEP, Equations, LoopClosure, Root, Roots};
pub(crate) use newton::{determinant, from_level_platform, polish};
pub(crate) use newton_rows::RootRows;
pub(crate) use search::find_roots;

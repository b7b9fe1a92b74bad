//! Real roots of trigonometric polynomials of degree ≤ 4, on the circle.
//!
//! # Method, and why
//!
//! Value and slope on a fixed grid give a cubic Hermite interpolant on each arc. Its four
//! Bernstein control points, widened by the interpolation error h⁴/384 · max |F⁗| (which the
//! Fourier coefficients bound), decide:
//!
//! 1. all of one sign: no root on the arc;
//! 2. the slope's control points of one sign: at most one root, by the signs at the ends;
//! 3. the curvature of one sign: the arc's only extremum is found and its sign decides between
//!    no root, two, and a near double root that the polynomial's own rounding cannot decide;
//! 4. otherwise the arc is halved. The error falls sixteenfold each time.
//!
//! Every decision is certified, so the method neither loses nor invents a root. It takes a few hundred
//! multiplications, without companion matrices, tan(θ/2) or special angles. A companion matrix in tan(θ/2) costs 10
//! to 30 times as much, loses θ = π and splits double roots by the square root of the rounding; the benches compare
//! both. Sturm sequences on such coefficients lose the close pairs that matter here.
//!
//! A near double root is not decided on the polynomial. The polynomial is a product over the branches of the loop
//! closure and squares a root that is simple on each; [`crate::loop_closure`] decides it on the branches.

mod grid;
mod isolation;
mod polynomial;

pub(crate) use isolation::{ArcRoots, RootArc, isolate_roots};
pub(crate) use polynomial::{TrigPolynomial, linear};

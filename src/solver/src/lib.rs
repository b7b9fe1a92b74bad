//! Kinematics of the VERNE machine's architecture: a parallel module with three unlike legs on
//! vertical sliders, and a tilting table.
//!
//! The equation numbers are those of D. Kanaan, P. Wenger, D. Chablat, *Workspace and Kinematic Analysis of the VERNE
//! machine*, AIM 2007 ([arXiv:0707.3507](https://arxiv.org/abs/0707.3507)). Lengths are millimetres, angles radians.
//! z points **down** in the base frame, and up from the table in the part frame. All functions are pure. None panics
//! and none returns a NaN. The solver checks every posture by Eqs (3)-(6) before it returns it. The workspace is
//! derived in [`workspace`].
//!
//! # Notation
//!
//! The platform is at P = (x, y, z), rotated by a about x (1). Slider i is at z = rho_i. With
//!
//! ```text
//! X1 = x + e1,  e1 = D1 - d1        u = R1 cos a - r1,  v = R1 sin a      (leg I)
//! X2 = x + e2,  e2 = D2 - d2        p = R2 cos a - r4,  q = R2 sin a      (legs II, III)
//! ```
//!
//! the rods are, from slider to platform, (X1, y ± u, w1 ± v) for rods 11 and 12, (X2, y - p, z - q - rho2) for leg
//! II and (X2, y + p, z + q - rho3) for leg III, with w1 = z - rho1. Eqs (3)-(6) say that their lengths are L1, L1,
//! L2, L3. They contain only differences of z and rho: a common shift changes nothing.
//!
//! Half the difference and the mean of (3) and (4) are
//!
//! ```text
//! y u + w1 v = 0            X1² + y² + u² + v² + w1² = L1²                (A)
//! ```
//!
//! where u² + v² = C - k cos a with C = R1² + r1² and k = 2 R1 r1. These two equations in (a, w1) describe leg I
//! completely. Legs II and III then follow by one square root each.
//!
//! # Inverse: P given
//!
//! Eliminating w1 from (A) is Eq (15), a cubic in c = cos a,
//!
//! ```text
//! g(c) = R1² (1 - c²) (E + k c) - (C - k c) y²,        E = L1² - X1² - C.
//! ```
//!
//! At c = ±1 g is not positive, and far to the left it is positive. So one root lies at c ≤ -1, and none or two lie
//! in [-1, 1]. Each of the two gives an angle and its mirror image: (a, w1) and (-a, -w1) satisfy (A) together. So
//! there are at most four angles and sixteen postures. The sign of sin a is that of -s1 y u for the sign s1 of w1.
//! Solving for t = 1 ∓ c, from which sin a = √(t (2 - t)), keeps the relative precision where y and sin a vanish
//! together. That is the symmetry plane, where the cubic has roots at c = ±1 whose w1 has both signs.
//!
//! # Inverse: the tool given in the base or the part frame
//!
//! The tool's axis determines theta2 = -phi2 (9) and theta1 = a - phi1 (14), and P moves on a circle as a changes: y
//! and z are of the first degree in cos a and sin a, by (27) for a tool in the base frame and by (26) for one in the
//! part frame. (15) becomes of the third degree on the circle, so of the sixth in tan(a/2), and it can have six real
//! roots: **the whole machine has up to twenty-four inverse solutions**, not sixteen. Several of them can be in the
//! working mode if the table is far from the platform ([`part_every_working`]).
//!
//! # Forward
//!
//! The first of (A) says that (y, w1) = λ (-v, u) for some λ, because u and v do not vanish together (R1 ≠ r1). The
//! difference of (5) and (6) is then linear in λ. The mean of (5) and (6) less that of (3) and (4) is linear in x.
//! With S = 2 rho1 - rho2 - rho3 and K = L2² - L3²,
//!
//! ```text
//! λ D = N            X1² + (λ² + 1) (C - k cos a) = L1²
//! D = 4 sin a (R2 r1 - R1 r4) + 2 (rho3 - rho2) u
//! N = K - (rho3 - rho2 - 2 q) S
//! X1 = (λ u S + T) / (2 (e1 - e2))
//! T = p² + q² + k cos a - C + L1² - (L2² + L3²)/2 + ((rho1 - rho2)² + (rho1 - rho3)²)/2
//!     + (rho2 - rho3) q + (e1 - e2)²
//! ```
//!
//! where D, N, T are of the first degree on the circle. Substituting λ = N/D in the second equation gives F(a) = 0 of
//! degree four, with nine coefficients and at most eight roots; at most six have been observed. Because of the
//! division by e1 - e2 a machine needs e1 ≠ e2. Near e1 = e2, and near R1 = r1, where u and v vanish together at a =
//! 0, roots of F are closer together than double precision resolves. [`Machine::new`] refuses such machines.
//!
//! If D and N vanish together, λ is free, the second equation gives two values for it, and F has a double root
//! although both solutions are regular. This happens on the symmetry plane (rho2 = rho3 with L2 = L3, at a = 0 and π)
//! and also if S = 0 with L2 = L3, at every zero of D: for instance with the sliders at 500, 400, 600. Near such
//! sliders the two roots of F are closer together than the precision of its coefficients.
//!
//! # Roots on the circle, and branches
//!
//! Both directions thus lead to two equations in (a, w), one linear and one quadratic in w (w = w1 or λ), and to a
//! trigonometric polynomial F(a). Up to a positive factor F is the product of the linear equation's values on the two
//! *branches* w₊(a) and w₋(a) of the quadratic one.
//!
//! The roots of F are isolated with certificates on arcs of the circle. The Bernstein control points of a cubic
//! Hermite interpolant, widened by the interpolation error that the Fourier coefficients bound, decide whether an arc
//! has no root, has one root, or must be halved. Newton's method in (a, w) then refines a root. There the two roots
//! of a double root of F lie on different branches, and each is simple. If F comes closer to zero on an arc than
//! its rounding, the branches decide: there is a root on each, or two on one, or two that have merged. Merged roots are
//! a parallel singularity, which [`Posture::merged`] reports. The branches are followed to where they meet: where leg I
//! is nearly level, a small island on which they exist can lie entirely within the polynomial's rounding.
//!
//! The benches show why this method was chosen: a companion matrix takes about ten times as long and splits double
//! roots by the square root of the rounding; tan(a/2) cannot represent a = π; Sturm sequences lose exactly the close
//! pairs that matter.
//!
//! # Working mode
//!
//! The machine itself uses only one mode: on all six rods the slider end is above the platform end, and the rods of
//! leg I do not cross (R1 cos a > r1). A platform position has at most one such posture. Newton's method finds it
//! from the level platform on the branch w > 0. If Newton's method does not converge, the search for all roots finds
//! it. That search reuses a posture that is already known, so a posture is the same to the last bit whichever
//! function returns it.
//!
//! # Many rows
//!
//! [`part_working_rows`], [`tool_working_rows`], [`platform_working_rows`], [`forward_working_rows`], [`margin_rows`]
//! and [`worst_margin_rows`] answer many requests at once, with the vector registers that the processor has
//! ([`Registers`]). The answers are those of one request to the last bit, on every processor.
//!
//! # Singularities
//!
//! Differentiating (3)-(6) gives, for a rod B - A = b, the row (b, ± R cos a · bz ∓ R sin a · by) against (x, y, z,
//! a) and -bz against its slider. Divided by the rod length, and by R1 in the last column, it is dimensionless. Its
//! determinant det_P vanishes where two assembly modes merge. bz/L vanishes where two inverse solutions merge. See
//! [`jacobian`].
//!
//! # Examples
//!
//! Each module's functions have examples. Three programs show more: `cargo run -p verne-solver --example forward`,
//! `inverse` and `workspace`.

// The tests inside the crate share code with those outside.
#[cfg(test)]
extern crate self as verne_solver;

pub mod axis;
mod clearance;
mod error;
mod fast_math;
mod forward;
mod inverse;
pub mod jacobian;
mod limit;
mod loop_closure;
pub mod machine;
mod margins;
mod mechanism;
mod parallel_matrix;
mod pose;
mod posture;
mod posture_rows;
mod registers;
mod request_range;
mod residual;
mod rods;
mod table;
pub mod toolpath;
mod trig_polynomial;
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

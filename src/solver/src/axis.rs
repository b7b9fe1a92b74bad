//! The tool axis in the part frame, and the two tool orientations that have it.

use std::f64::consts::{PI, TAU};

/// Half-angle of the cone around the table's own axis in which an axis counts as the table's own, rad. Axes in tool
/// paths carry noise of about 1e-7 rad, and six decimals round by up to 7e-7. The azimuth of such an inclination has
/// no meaning.
pub const POLE: f64 = 1e-6;
/// Half-width of the strip around an azimuth of half a turn in which the sign of the azimuth is rounding, rad. There,
/// and around zero for the other preimage, the sign does not decide about a whole turn.
const SEAM: f64 = 1e-9;

/// Computes the unit vector from the tool's tip to its holder in the part frame.
///
/// # Units
///
/// phi1 and phi2 are radians; the vector has no unit.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (8), (9), (14).
///
/// # Examples
///
/// ```
/// use verne_solver::axis::tool_axis;
///
/// assert_eq!(tool_axis(0.0, 0.0), [0.0, 0.0, 1.0], "a tool perpendicular to the table");
/// ```
pub fn tool_axis(phi1: f64, phi2: f64) -> [f64; 3] {
    let ((s1, c1), (s2, c2)) = (phi1.sin_cos(), phi2.sin_cos());
    [s1 * s2, -s1 * c2, c1]
}

/// The orientations (phi1, phi2) that have a given tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Preimages {
    /// Both orientations: `[phi1, phi2]` with phi1 in (0, π), and (-phi1, phi2 ± π).
    /// phi2 of each is in (-π, π], but for rounding.
    Two([[f64; 2]; 2]),
    /// The axis is within [`POLE`] of the table's own: phi1 is 0 or π, and every phi2 gives the axis.
    Free {
        /// 0 or π.
        phi1: f64,
    },
}

/// The axis scaled to a greatest magnitude of 1, without negative zeros; `None` if it is zero or not finite.
pub(crate) fn direction(axis: [f64; 3]) -> Option<[f64; 3]> {
    let largest = axis.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let valid = largest > 0.0 && axis.iter().all(|c| c.is_finite());
    valid.then(|| axis.map(|c| c / largest + 0.0))
}

/// Solves (i, j, k) = (sin phi1 sin phi2, -sin phi1 cos phi2, cos phi1) for phi1 and phi2.
///
/// The axis may have any length but zero. The answer is `None` if the axis is zero or not finite.
///
/// # Units
///
/// The axis may have any unit; phi1 and phi2 are radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (8), (9), (14).
///
/// # Examples
///
/// ```
/// use verne_solver::axis::{Preimages, preimages, tool_axis};
///
/// let Some(Preimages::Two([[phi1, phi2], other])) = preimages([0.3, -0.4, 1.2]) else { panic!() };
/// let [i, j, k] = tool_axis(phi1, phi2);
/// let [l, m, n] = tool_axis(other[0], other[1]);
/// assert!((i - l).hypot(j - m).hypot(k - n) < 1e-12, "both have the same axis");
/// assert_eq!(preimages([0.0, 0.0, 2.0]), Some(Preimages::Free { phi1: 0.0 }));
/// assert_eq!(preimages([0.0; 3]), None);
/// ```
pub fn preimages(axis: [f64; 3]) -> Option<Preimages> {
    let [i, j, k] = direction(axis)?;
    let inclined = i.hypot(j);
    if inclined <= POLE * k.abs() {
        return Some(Preimages::Free { phi1: if k > 0.0 { 0.0 } else { PI } });
    }
    let phi1 = inclined.atan2(k);
    let azimuth = i.atan2(0.0 - j);
    let phi2 = if azimuth <= SEAM - PI { azimuth + TAU } else { azimuth };
    let other = if phi2 > SEAM { phi2 - PI } else { phi2 + PI };
    Some(Preimages::Two([[phi1, phi2], [-phi1, other]]))
}

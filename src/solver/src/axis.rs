//! The tool axis in the part frame, and the two tool orientations that have it.

use std::f64::consts::PI;

/// Below this length of (i, j) relative to (i, j, k) the azimuth phi2 is free: it is the rounding
/// of an axis given with 16 digits.
const FREE: f64 = 1e-15;

/// The unit vector from tip to holder in the table frame.
pub fn tool_axis(phi1: f64, phi2: f64) -> [f64; 3] {
    let ((s1, c1), (s2, c2)) = (phi1.sin_cos(), phi2.sin_cos());
    [s1 * s2, -s1 * c2, c1]
}

/// The orientations (phi1, phi2) that have a given tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Preimages {
    /// Both orientations: `[phi1, phi2]` with phi1 in (0, π), and its twin (-phi1, phi2 + π).
    Two([[f64; 2]; 2]),
    /// The axis is the table's own: phi1 is 0 or π, and every phi2 serves.
    Free {
        /// 0 or π.
        phi1: f64,
    },
}

/// Solves (i, j, k) = (sin phi1 sin phi2, -sin phi1 cos phi2, cos phi1). The axis may have any
/// length but zero; `None` if it is zero or not finite.
pub fn preimages(axis: [f64; 3]) -> Option<Preimages> {
    let largest = axis.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 || !axis.iter().all(|c| c.is_finite()) {
        return None;
    }
    let [i, j, k] = axis.map(|c| c / largest);
    let inclined = i.hypot(j);
    if inclined <= FREE {
        return Some(Preimages::Free { phi1: if k > 0.0 { 0.0 } else { PI } });
    }
    let phi1 = inclined.atan2(k);
    let phi2 = i.atan2(-j);
    let twin = if phi2 > 0.0 { phi2 - PI } else { phi2 + PI };
    Some(Preimages::Two([[phi1, phi2], [-phi1, twin]]))
}

//! Radians and degrees: the wire speaks degrees, everything behind it radians.

/// Degrees to radians.
pub(crate) fn from_degrees(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// Radians to degrees, never -0.
pub(crate) fn to_degrees(radians: f64) -> f64 {
    radians.to_degrees() + 0.0
}

/// The degrees that somebody wrote: rounded to 1e-9 where that gives these very radians back, so
/// that a machine shown and sent again is the same machine.
pub(crate) fn to_short_degrees(radians: f64) -> f64 {
    let degrees = to_degrees(radians);
    let short = (degrees * 1e9).round() / 1e9;
    if from_degrees(short) == radians { short } else { degrees }
}

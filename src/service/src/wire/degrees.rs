//! Radians and degrees: the wire speaks degrees, everything behind it radians.

/// Degrees to radians.
pub(crate) fn from_degrees(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// Radians to degrees, never -0: the degrees that somebody wrote, rounded to 1e-9, where those give
/// these very radians back. What was asked with 30 is answered with 30, and a machine shown and
/// sent again is the same machine.
pub(crate) fn to_degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let short = (degrees * 1e9).round() / 1e9;
    let exact = if from_degrees(short) == radians { short } else { degrees };
    exact + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_degrees_come_back_as_written() {
        for degrees in [30.0, -30.0, 42.0, 0.1, -89.123_456_789, 180.0, 360.0] {
            assert_eq!(to_degrees(from_degrees(degrees)).to_bits(), f64::to_bits(degrees), "{degrees}");
        }
        assert_eq!(to_degrees(-0.0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn other_angles_keep_their_digits() {
        let radians = 0.123_456_789_012_345_68;
        assert!((from_degrees(to_degrees(radians)) - radians).abs() <= f64::EPSILON * radians);
    }
}

//! Conversions between the degrees of requests and answers and the radians of the code.

/// Degrees to radians.
pub(crate) fn from_degrees(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// Whole turns in an angle in degrees. The rest is at most half a turn, and exact.
pub(crate) fn whole_turns(degrees: f64) -> f64 {
    (degrees / 360.0).round_ties_even()
}

/// The same direction within half a turn of zero, in radians.
pub(crate) fn from_degrees_of_turn(degrees: f64) -> f64 {
    from_degrees(degrees - 360.0 * whole_turns(degrees))
}

/// How many neighbouring doubles [`to_degrees`] tries on each side: π/180 stretches the spacing by less than this.
const NEIGHBOURS: usize = 4;

/// Radians to degrees, never -0.
///
/// Returns degrees rounded to 1e-9 if [`from_degrees`] maps them to exactly these radians, otherwise the nearest
/// degrees that it does. So an answer repeats the 30 of a request as 30, and a machine that the service has shown is
/// the same machine when a client sends it.
pub(crate) fn to_degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let short = (degrees * 1e9).round() / 1e9;
    let above = std::iter::successors(Some(degrees), |above| Some(above.next_up())).take(NEIGHBOURS);
    let below = std::iter::successors(Some(degrees), |below| Some(below.next_down())).take(NEIGHBOURS);
    let exact = std::iter::once(short).chain(above).chain(below).find(|near| from_degrees(*near) == radians);
    exact.unwrap_or(degrees) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_survive_the_way_to_radians_and_back() {
        for degrees in [30.0, -30.0, 42.0, 0.1, -89.123_456_789, 180.0, 360.0] {
            assert_eq!(to_degrees(from_degrees(degrees)).to_bits(), f64::to_bits(degrees), "{degrees}");
        }
        assert_eq!(to_degrees(-0.0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn degrees_of_radians_give_the_same_radians() {
        for i in 1..20_000 {
            let written = f64::from(i) * 0.017_234_567_890_123_4;
            let radians = from_degrees(written);
            assert_eq!(from_degrees(to_degrees(radians)).to_bits(), radians.to_bits(), "{written}");
        }
    }

    #[test]
    fn angles_that_no_degrees_give_keep_their_digits() {
        let radians = 0.123_456_789_012_345_68;
        assert!((from_degrees(to_degrees(radians)) - radians).abs() <= f64::EPSILON * radians);
    }
}

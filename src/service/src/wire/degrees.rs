//! Conversions between the degrees of requests and answers and the radians of the code.

/// Degrees to radians.
pub(crate) fn from_degrees(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// A constant that, added to a number below 2^51, leaves the nearest integer in the last bits. Rounding by the standard
/// library is a call of a function.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// 2^51.
const MOST_ROUNDED: f64 = 2_251_799_813_685_248.0;

/// The nearest integer; of two the even one.
fn nearest_integer(number: f64) -> f64 {
    if number.abs() < MOST_ROUNDED {
        ((number + ROUND) - ROUND).copysign(number)
    } else {
        number.round_ties_even()
    }
}

/// Whole turns in an angle in degrees. The rest is at most half a turn, and exact.
pub(crate) fn whole_turns(degrees: f64) -> f64 {
    nearest_integer(degrees / 360.0)
}

/// The same direction within half a turn of zero, in radians.
pub(crate) fn from_degrees_of_turn(degrees: f64) -> f64 {
    from_degrees(degrees - 360.0 * whole_turns(degrees))
}

/// How many neighbouring doubles [`to_degrees`] tries: π/180 stretches the spacing by less than this.
const NEIGHBOURS: usize = 3;

/// Radians to degrees, never -0.
///
/// Returns degrees rounded to 1e-9 if [`from_degrees`] maps them to exactly these radians, otherwise the nearest
/// degrees that it does. So an answer repeats the 30 of a request as 30, and a machine that the service has shown is
/// the same machine when a client sends it.
pub(crate) fn to_degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let scaled = degrees * 1e9;
    let rounded = nearest_integer(scaled);
    // Other roundings change the radians. The division takes more time than all that follows.
    if (scaled - rounded).abs() <= 8.0 * f64::EPSILON * scaled.abs() {
        let short = rounded / 1e9;
        if from_degrees(short) == radians {
            return short + 0.0;
        }
    }
    nearest_with_radians(degrees, radians).unwrap_or(degrees) + 0.0
}

/// The number next to `degrees` that [`from_degrees`] maps to exactly these radians, if there is one.
fn nearest_with_radians(degrees: f64, radians: f64) -> Option<f64> {
    let is_less = from_degrees(degrees) < radians;
    let mut near = degrees;
    for _ in 0..=NEIGHBOURS {
        let mapped = from_degrees(near);
        if mapped == radians {
            return Some(near);
        }
        // The map is monotonic: no number beyond has these radians.
        if (mapped < radians) != is_less {
            return None;
        }
        near = if is_less { near.next_up() } else { near.next_down() };
    }
    None
}

/// Doubles by which a bound is moved outwards after a conversion. The conversion multiplies by a rounded factor and
/// rounds once: together by less than two doubles.
const OUTWARDS: usize = 3;

/// Bounds in degrees of an angle with these bounds in radians; `degrees`, which stand for such an angle, are inside.
pub(crate) fn enclosing_degrees([low, high]: [f64; 2], degrees: f64) -> [f64; 2] {
    [below(low.to_degrees()).min(degrees), above(high.to_degrees()).max(degrees)]
}

/// Bounds in radians, within half a turn of zero, of the direction of an angle in degrees. Zero is exact.
pub(crate) fn radians_around(degrees: f64) -> [f64; 2] {
    let rest = degrees - 360.0 * whole_turns(degrees);
    let radians = from_degrees(rest);
    if rest == 0.0 { [0.0; 2] } else { [below(radians), above(radians)] }
}

fn below(number: f64) -> f64 {
    (0..OUTWARDS).fold(number, |bound, _| bound.next_down())
}

fn above(number: f64) -> f64 {
    (0..OUTWARDS).fold(number, |bound, _| bound.next_up())
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
    fn an_integer_is_the_nearest_one() {
        for number in [0.0, -0.0, 0.5, -0.5, 1.5, 2.5, -2.5, 0.3, -0.3, 1e15 + 0.5, 1e300, f64::INFINITY] {
            assert_eq!(nearest_integer(number).to_bits(), number.round_ties_even().to_bits(), "{number}");
        }
    }

    #[test]
    fn the_first_of_all_neighbours_is_found() {
        let by_search = |radians: f64| {
            let degrees = radians.to_degrees();
            let short = (degrees * 1e9).round() / 1e9;
            let above = std::iter::successors(Some(degrees), |near| Some(near.next_up())).take(5);
            let below = std::iter::successors(Some(degrees), |near| Some(near.next_down())).take(5);
            let mut all = std::iter::once(short).chain(above).chain(below);
            all.find(|near| from_degrees(*near) == radians).unwrap_or(degrees) + 0.0
        };
        for i in 0..100_000 {
            let spread = (f64::from(i) * 0.618_033_988_749_895).fract() - 0.5;
            let radians = spread * 10.0_f64.powi(i % 20 - 16);
            assert_eq!(to_degrees(radians).to_bits(), by_search(radians).to_bits(), "{radians}");
        }
    }

    #[test]
    fn angles_that_no_degrees_give_keep_their_digits() {
        let radians = 0.123_456_789_012_345_68;
        assert!((from_degrees(to_degrees(radians)) - radians).abs() <= f64::EPSILON * radians);
    }

    /// Products of doubles, with their rounding errors, tell whether degrees times π/180 is within bounds.
    #[test]
    fn bounds_contain_the_angle() {
        // π/180 and what its double lacks.
        let (unit, rest) = (std::f64::consts::PI / 180.0, 2.948_652_270_870_168_6e-19);
        for i in -20_000..20_000 {
            let degrees = f64::from(i) * 0.009;
            let [low, high] = radians_around(degrees);
            let product = degrees * unit;
            let error = degrees.mul_add(unit, -product) + degrees * rest;
            let above_low = (product - low) + error;
            let below_high = (high - product) - error;
            assert!(above_low >= 0.0 && below_high >= 0.0 && high - low <= 3e-15, "{degrees}");
            let back = enclosing_degrees([low, high], degrees);
            assert!(back[0] <= degrees && degrees <= back[1] && back[1] - back[0] < 4e-13, "{degrees}");
        }
        assert_eq!(radians_around(-720.0), [0.0; 2]);
    }
}

//! Elementary functions for the inner loops, without calls and almost without branches, so that a processor computes
//! several at once. The standard library's circular functions take two to three times as long because they round the
//! last half unit correctly. No length here needs that.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, FRAC_PI_2, PI, TAU};

/// Angle up to which its quarter turns are split off exactly.
pub(crate) const MAX_ANGLE: f64 = 1e5;
/// A quarter of a turn: its first 33 bits, and the rest.
const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
/// A constant that, added to a number below 2^51, leaves the nearest integer in the last bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// (sin x - x) / x³ and (cos x - 1 + x²/2) / x⁴ in x² up to an eighth of a turn, lowest power
/// first: the minimax polynomials of Sun's fdlibm.
const SINE: [[f64; 2]; 3] = [
    [-0.166_666_666_666_666_32, 0.008_333_333_333_322_49],
    [-1.984_126_982_985_795e-4, 2.755_731_370_707_006_8e-6],
    [-2.505_076_025_340_686_3e-8, 1.589_690_995_211_55e-10],
];
const COSINE: [[f64; 2]; 3] = [
    [0.041_666_666_666_666_6, -0.001_388_888_888_887_411],
    [2.480_158_728_947_673e-5, -2.755_731_435_139_066_3e-7],
    [2.087_572_321_298_175e-9, -1.135_964_755_778_819_5e-11],
];
/// Numerator and denominator of (asin x - x) / x³ in x², lowest power first: a rational
/// interpolant in the Chebyshev nodes of [0, 1/2], which is off by less than 1e-16.
const NUMERATOR: [[f64; 2]; 4] = [
    [0.166_666_666_666_666_66, -0.435_110_601_214_792_17],
    [0.406_848_772_213_551_15, -0.160_439_552_735_553_44],
    [0.022_905_211_595_485_822, -0.000_329_876_430_382_643_7],
    [-0.000_012_529_026_122_623_987, 0.0],
];
const DENOMINATOR: [[f64; 2]; 3] = [
    [1.0, -3.060_663_607_288_762_7],
    [3.550_534_113_705_006, -1.922_848_725_183_625_3],
    [0.475_377_788_679_428_65, -0.041_357_952_119_956_125],
];

/// The polynomial's value, coefficients in pairs from the lowest power: two short chains of
/// dependent operations in place of a long one.
#[inline(always)]
fn polynomial<const N: usize>(pairs: &[[f64; 2]; N], x: f64) -> f64 {
    let square = x * x;
    let pair = |i: usize| pairs[i][0] + pairs[i][1] * x;
    (0..N - 1).rev().fold(pair(N - 1), |sum, i| sum * square + pair(i))
}

/// sin and cos of an angle, to about a unit in the last place.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() < MAX_ANGLE { sin_cos_of_turn(angle) } else { angle.sin_cos() }
}

/// [`sin_cos`] of an angle that is known to be within some turns.
#[inline(always)]
pub(crate) fn sin_cos_of_turn(angle: f64) -> (f64, f64) {
    let shifted = angle * FRAC_2_PI + ROUND;
    let (quarters, count) = (shifted - ROUND, shifted.to_bits());
    let x = (angle - quarters * QUARTER[0]) - quarters * QUARTER[1];
    let square = x * x;
    let sine = x + x * (square * polynomial(&SINE, square));
    let cosine = 1.0 - (0.5 * square - square * square * polynomial(&COSINE, square));
    let (s, c) = if count & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    // The sine is negative in the third and fourth quarter, the cosine in the second and third.
    let signed = |value: f64, count: u64| f64::from_bits(value.to_bits() ^ ((count & 2) << 62));
    (signed(s, count), signed(c, count.wrapping_add(1)))
}

/// Whether the nearest integer is odd; the number's magnitude is below 2^51.
#[inline]
pub(crate) fn is_odd(number: f64) -> bool {
    (number + ROUND).to_bits() & 1 == 1
}

/// asin x for x² <= 1/2, to two units in the last place; `square` is x².
#[inline(always)]
pub(crate) fn asin(x: f64, square: f64) -> f64 {
    x + x * (square * polynomial(&NUMERATOR, square) / polynomial(&DENOMINATOR, square))
}

/// The angle of a direction, in (-π, π], from its sine or its cosine, whichever is the steeper
/// function there.
#[inline(always)]
pub(crate) fn angle_of(c: f64, s: f64) -> f64 {
    let steep = if c.abs() > FRAC_1_SQRT_2 { s } else { c };
    let arc = asin(steep, steep * steep);
    let angle = if c > FRAC_1_SQRT_2 {
        arc
    } else if c < -FRAC_1_SQRT_2 {
        (PI - arc.abs()).copysign(s)
    } else {
        (FRAC_PI_2 - arc).copysign(s)
    };
    if angle <= -PI { PI } else { angle }
}

/// An angle that is at most a turn outside (-π, π], shifted into it.
#[inline(always)]
pub(crate) fn wrapped(angle: f64) -> f64 {
    if angle > PI {
        angle - TAU
    } else if angle <= -PI {
        angle + TAU
    } else {
        angle
    }
}

/// The greater of two numbers: a single instruction, unlike `f64::max`, which looks for NaNs.
#[inline(always)]
pub(crate) fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The lesser of two numbers.
#[inline(always)]
pub(crate) fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The angle of a vector that need not have unit length, in (-π, π]; zero for a vector of no length.
#[inline(always)]
pub(crate) fn angle_of_vector(x: f64, y: f64) -> f64 {
    let length = (x * x + y * y).sqrt();
    if length > 0.0 { angle_of(x / length, y / length) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_equal_the_standard_library() {
        for i in -100_000..=100_000 {
            let angle = f64::from(i) * 1.234e-3;
            let ((s, c), (sin, cos)) = (sin_cos(angle), angle.sin_cos());
            assert!((s - sin).abs() <= 2.3e-16 && (c - cos).abs() <= 2.3e-16, "{angle}");
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert!((sin_cos(PI).0 - PI.sin()).abs() < 1e-25);
    }

    #[test]
    fn the_quotient_equals_the_arc_sine() {
        for i in -700..=700 {
            let x = f64::from(i) * 1.01e-3;
            assert!((asin(x, x * x) - x.asin()).abs() <= 4e-16 * x.abs(), "{x}");
        }
    }

    #[test]
    fn every_direction_returns_its_angle() {
        for i in -3141..=3141 {
            let angle = f64::from(i) * 1e-3;
            assert!((angle_of(angle.cos(), angle.sin()) - angle).abs() <= 1e-15, "{angle}");
        }
        assert_eq!(angle_of(-1.0, 0.0), PI);
        assert_eq!(angle_of(-1.0, -0.0), PI);
    }
}

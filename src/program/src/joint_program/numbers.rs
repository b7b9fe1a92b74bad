//! Numbers in words: always with a decimal point, since controllers count in increments without one.

/// The largest whole number of last decimals: all smaller ones are exact.
const LARGEST: f64 = 9e15;

/// A number as a whole number of its last decimals; so equal texts are equal numbers, and there is no negative zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fixed {
    units: i64,
    decimals: u8,
}

impl Fixed {
    pub(super) const ZERO: Self = Self { units: 0, decimals: 0 };

    /// The nearest number with so many decimals; `None` if it has too many digits.
    #[allow(clippy::cast_possible_truncation, reason = "below 2^53")]
    pub(super) fn nearest(value: f64, decimals: u8) -> Option<Self> {
        let units = (value * 10_f64.powi(i32::from(decimals))).round();
        (units.abs() <= LARGEST).then_some(Self { units: units as i64, decimals })
    }

    /// Appends the number, without zeros at its end; the first decimal remains.
    pub(super) fn append_to(self, text: &mut String) {
        let scale = 10_u64.pow(u32::from(self.decimals));
        let magnitude = self.units.unsigned_abs();
        if self.units < 0 {
            text.push('-');
        }
        text.push_str(&(magnitude / scale).to_string());
        let fraction = format!("{:01$}", magnitude % scale, usize::from(self.decimals));
        let digits = fraction.trim_end_matches('0');
        text.push('.');
        text.push_str(if digits.is_empty() { "0" } else { digits });
    }
}

/// A positive number with six significant digits, and at most nine decimals.
pub(super) fn significant(value: f64) -> String {
    let value = value.max(1e-9);
    let decimals = (0..9).find(|decimals| value * 10_f64.powi(*decimals) >= 99_999.5).unwrap_or(9);
    let text = format!("{value:.0$}", usize::try_from(decimals.max(1)).unwrap_or(1));
    let digits = text.trim_end_matches('0');
    if digits.ends_with('.') { format!("{digits}0") } else { digits.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::{Fixed, significant};

    fn text(value: f64, decimals: u8) -> String {
        let mut text = String::new();
        if let Some(fixed) = Fixed::nearest(value, decimals) {
            fixed.append_to(&mut text);
        }
        text
    }

    #[test]
    fn numbers_have_a_point_and_no_superfluous_zeros() {
        assert_eq!(text(600.0, 4), "600.0");
        assert_eq!(text(-0.05, 4), "-0.05");
        assert_eq!(text(1234.56789, 4), "1234.5679");
        assert_eq!(text(-12.5, 0), "-13.0");
        assert_eq!(text(1e12, 4), "");
        assert_eq!(text(f64::NAN, 4), "");
    }

    #[test]
    fn there_is_no_negative_zero() {
        assert_eq!(text(-0.000_049, 4), "0.0");
        assert_eq!(text(-0.0, 0), "0.0");
    }

    #[test]
    fn feeds_have_six_significant_digits() {
        assert_eq!(significant(60.0), "60.0");
        assert_eq!(significant(1.0 / 3.0), "0.333333");
        assert_eq!(significant(12_345.678), "12345.7");
        assert_eq!(significant(0.000_123_456_7), "0.000123457");
        assert_eq!(significant(0.0), "0.000000001");
    }
}

//! Whole numbers and codes as programs write them.

/// The largest number of a code.
const LARGEST_CODE: u32 = 99_999;

/// A whole number: `3`, or `3.` and `3.0` as some systems write it.
pub(crate) fn whole(text: &str) -> Option<u32> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    whole.parse().ok().filter(|_| fraction.bytes().all(|byte| byte == b'0'))
}

/// Ten times the number of a code, which has at most one digit other than zero after the point.
pub(crate) fn tenths(text: &str) -> Option<u32> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if whole.is_empty() || !digits(whole) || !digits(fraction) {
        return None;
    }
    let (first, rest) = fraction.split_at_checked(1).unwrap_or(("0", ""));
    let whole: u32 = whole.parse().ok().filter(|whole| *whole <= LARGEST_CODE)?;
    let tenth: u32 = first.parse().ok().filter(|_| rest.bytes().all(|byte| byte == b'0'))?;
    Some(whole * 10 + tenth)
}

#[cfg(test)]
mod tests {
    use super::{tenths, whole};

    #[test]
    fn codes_have_at_most_one_decimal() {
        for (text, expected) in [
            ("1", Some(10)),
            ("01", Some(10)),
            ("43.4", Some(434)),
            ("1.", Some(10)),
            ("54.10", Some(541)),
            ("0", Some(0)),
        ] {
            assert_eq!(tenths(text), expected, "{text}");
        }
        for text in ["", ".", ".5", "1.05", "100000", "5000000000", "1.x", "x", "-1", "1.\u{e9}"] {
            assert_eq!(tenths(text), None, "{text}");
        }
    }

    #[test]
    fn whole_numbers_may_have_a_point() {
        assert_eq!([whole("3"), whole("03."), whole("3.00")], [Some(3); 3]);
        assert_eq!([whole("3.1"), whole(""), whole("4294967296"), whole("-1")], [None; 4]);
    }
}

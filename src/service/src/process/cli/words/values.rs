//! Values of an answer as texts.

use serde_json::Value;

/// The text at a JSON Pointer; empty if there is none.
pub(crate) fn text_at<'a>(value: &'a Value, pointer: &str) -> &'a str {
    value.pointer(pointer).and_then(Value::as_str).unwrap_or_default()
}

/// The number at a JSON Pointer.
pub(crate) fn number_at(value: &Value, pointer: &str) -> Option<f64> {
    value.pointer(pointer).and_then(Value::as_f64)
}

/// How many elements the list at a JSON Pointer has.
pub(crate) fn count_at(value: &Value, pointer: &str) -> usize {
    value.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len)
}

/// A length or an angle, to a thousandth of mm or of a degree.
pub(crate) fn decimal(number: f64) -> String {
    // Without a negative zero.
    let text = format!("{number:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}

/// A number with four significant digits.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "of a logarithm, and not negative"
)]
pub(crate) fn significant(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    let digits = (3 - number.abs().log10().floor() as i32).max(0) as usize;
    format!("{number:.digits$}")
}

/// `1 solution`, `2 solutions`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The conditions that an answer does not cover.
pub(crate) fn not_checked(answer: &Value) -> String {
    let conditions = answer["not_checked"].as_array().into_iter().flatten().filter_map(Value::as_str);
    conditions.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::{counted, decimal, significant};

    #[test]
    fn numbers_are_rounded_and_nouns_counted() {
        assert_eq!([decimal(-1e-9), decimal(1.23456), decimal(-250.0)], ["0.000", "1.235", "-250.000"]);
        assert_eq!(
            [0.0, 0.012_345, -1234.56, 1e-5].map(significant),
            ["0", "0.01235", "-1235", "0.00001000"]
        );
        assert_eq!([counted(1, "job"), counted(0, "job")], ["1 job", "0 jobs"]);
    }
}

//! JSON texts that are almost valid: known fields, unusual values, duplicate fields, deep nesting.

use std::fmt::Write;

use serde_json::Value;

use crate::draw::Draw;

/// Fields of all operations, and some unknown ones.
const FIELDS: [&str; 38] = [
    "machine",
    "joints",
    "rho",
    "theta1",
    "theta2",
    "tool_length",
    "solutions",
    "near",
    "frame",
    "pose",
    "x",
    "y",
    "z",
    "alpha",
    "phi1",
    "phi2",
    "axis",
    "poses",
    "points",
    "kind",
    "tolerance",
    "from",
    "to",
    "step",
    "cell",
    "geometry",
    "table",
    "limits",
    "stroke",
    "slider_axes",
    "name",
    "description",
    "L1",
    "R1",
    "r1",
    "tilt",
    "",
    "ü~/",
];

/// A text of values.
pub(crate) fn text(draw: &mut Draw<'_>) -> String {
    let mut text = String::new();
    object(draw, &mut text, 0);
    text
}

fn object(draw: &mut Draw<'_>, text: &mut String, depth: usize) {
    text.push('{');
    for i in 0..draw.below(8) {
        let comma = if i == 0 { "" } else { "," };
        write!(text, "{comma}{}:", Value::from(draw.pick(&FIELDS))).unwrap();
        value(draw, text, depth + 1);
    }
    text.push('}');
}

/// Any value.
pub(crate) fn value(draw: &mut Draw<'_>, text: &mut String, depth: usize) {
    match if depth > 6 || draw.is_empty() { 0 } else { draw.below(10) } {
        0..4 => text.push_str(&draw.numeral(1000.0)),
        4 => write!(text, "{}", Value::from(draw.text())).unwrap(),
        5 | 6 => {
            text.push('[');
            for i in 0..draw.below(7) {
                text.push_str(if i == 0 { "" } else { "," });
                value(draw, text, depth + 1);
            }
            text.push(']');
        }
        7 | 8 => object(draw, text, depth),
        _ => {
            let deep = draw.below(200);
            let odd =
                draw.pick(&["null", "true", "[[[[", "{\"\":", "\"\\ud800\"", "1e999999999999", "- 1", "// "]);
            text.push_str(&odd.repeat(if draw.one_in(4) { deep } else { 1 }));
        }
    }
}

/// A valid value, of which some parts are replaced, omitted or duplicated.
pub(crate) fn spoilt(draw: &mut Draw<'_>, good: &Value) -> String {
    let mut text = String::new();
    let one_in = draw.pick(&[4, 8, 16, 64, 255]);
    spoil(draw, good, one_in, &mut text);
    text
}

fn spoil(draw: &mut Draw<'_>, good: &Value, one_in: usize, text: &mut String) {
    if draw.one_in(one_in) {
        return value(draw, text, 0);
    }
    match good {
        Value::Object(fields) => {
            text.push('{');
            let mut first = true;
            for (name, good) in fields {
                let times = if draw.one_in(one_in) { draw.below(3) } else { 1 };
                for _ in 0..times {
                    write!(text, "{}{}:", if first { "" } else { "," }, Value::from(name.as_str())).unwrap();
                    spoil(draw, good, one_in, text);
                    first = false;
                }
            }
            text.push('}');
        }
        Value::Array(items) => {
            let count = if draw.one_in(one_in) { draw.below(items.len() + 2) } else { items.len() };
            text.push('[');
            for i in 0..count {
                text.push_str(if i == 0 { "" } else { "," });
                spoil(draw, items.get(i).unwrap_or(&Value::Null), one_in, text);
            }
            text.push(']');
        }
        Value::Number(_) if draw.one_in(one_in.min(8)) => text.push_str(&draw.numeral(1000.0)),
        other => write!(text, "{other}").unwrap(),
    }
}

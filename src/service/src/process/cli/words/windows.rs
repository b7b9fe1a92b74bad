//! The answer of `verne toolpath-window`.

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::values::{decimal, not_checked, number_at, text_at};

/// The intervals of a parameter, or the value that comes nearest to one. The ends keep all their digits: a rounded one
/// could be outside.
pub(crate) fn window(answer: &Value) -> Page {
    let [machine, parameter] =
        ["/machine/name", "/request/parameter"].map(|pointer| text_at(answer, pointer));
    let unit = text_at(answer, "/unit");
    let page = Page::new(format!("{machine}: window of {parameter}"));
    let number = |value: &Value| value.as_f64().unwrap_or_default();
    let page = answer["intervals"].as_array().into_iter().flatten().fold(page, |page, interval| {
        let range = format!("{} to {} {unit}", number(&interval["from"]), number(&interval["to"]));
        let ends = [0, 1].map(|i| end(&interval["ends"][i]));
        let [below, above] = ends;
        page.fields([("interval", range), ("ends below", below), ("ends above", above)])
    });
    let nearest = number_at(answer, "/nearest/value").map(|value| {
        let limit = end(&answer["nearest"]["margin"]);
        [("no interval", format!("nearest is {value} {unit}")), ("there", limit)]
    });
    let resolution = number_at(answer, "/resolution").unwrap_or_default();
    page.fields(nearest.into_iter().flatten())
        .fields([
            ("may be missed", format!("intervals and gaps below {} {unit}", decimal(resolution))),
            ("not checked", not_checked(answer)),
        ])
        .sentence("All fields: --json.")
}

fn end(end: &Value) -> String {
    if end["kind"] == "bound" {
        return "the range that was asked for".to_owned();
    }
    let [constraint, element] = ["/constraint", "/element"].map(|pointer| text_at(end, pointer));
    format!("{constraint} of {element} in line {}", end["line"])
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::window;
    use crate::process::cli::terminal::Terminal;

    #[test]
    fn a_window_says_what_ends_it() {
        let limit = json!({"kind": "limit", "constraint": "stroke", "element": "slider2.min", "line": 7});
        let answer = json!({"machine": {"name": "verne"}, "request": {"parameter": "tool_length"}, "unit": "mm",
            "intervals": [{"from": 0, "to": 345.5, "ends": [{"kind": "bound"}, limit]}],
            "resolution": 0.25, "not_checked": ["table"]});
        let text = window(&answer).text(Terminal { width: 80, colours: false });
        assert!(text.contains("0 to 345.5 mm"), "{text}");
        assert!(text.contains("stroke of slider2.min in line 7"), "{text}");
        let none = json!({"machine": {"name": "verne"}, "intervals": [], "unit": "deg",
            "nearest": {"value": 12, "margin": {"constraint": "tilt", "element": "theta1.max", "line": 3}}});
        let text = window(&none).text(Terminal { width: 80, colours: false });
        assert!(
            text.contains("nearest is 12 deg") && text.contains("tilt of theta1.max in line 3"),
            "{text}"
        );
    }
}

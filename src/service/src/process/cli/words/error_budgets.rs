//! The answers of `verne error-budget` and `verne error-map`.

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::table::Table;
use crate::process::cli::words::values::{decimal, not_checked, number_at, significant, text_at};

/// The error budget of one pose.
pub(crate) fn pose(answer: &Value) -> Page {
    let page = Page::new(format!("{}: error budget", text_at(answer, "/machine/name")));
    let page = page.fields([("status", status(answer)), ("not checked", not_checked(answer))]);
    let budget = &answer["budgets"][0];
    if budget.is_null() {
        return page.sentence("There is no budget. All fields: --json.");
    }
    let figures = |figure: &str, unit: &str| {
        let number = |name: &str| length(number_at(budget, &format!("/{figure}/{name}")), unit);
        [("rms", number("rms")), ("worst", number("worst")), ("worst, exact", number("worst_exact"))]
    };
    let parameters = answer["parameters"].as_array().map(Vec::as_slice).unwrap_or_default();
    let with_unit =
        |parameter: &Value| length(number_at(parameter, "/tolerance"), text_at(parameter, "/unit"));
    let contributions = |figure: &str| {
        let all = budget[figure]["contributions"].as_array().into_iter().flatten();
        all.map(|number| significant(number.as_f64().unwrap_or_default())).collect::<Vec<_>>()
    };
    page.heading("tool end")
        .fields(figures("tip", "mm"))
        .heading("tool axis")
        .fields(figures("axis", "deg"))
        .heading("contributions")
        .table(
            Table::default()
                .texts("parameter", parameters.iter().map(|parameter| text_at(parameter, "/name")))
                .texts("tolerance", parameters.iter().map(with_unit))
                .texts("tool end, mm", contributions("tip"))
                .texts("axis, deg", contributions("axis")),
        )
        .sentence("The worst parameters and all fields: --json.")
}

/// The summary of an error map.
pub(crate) fn map(answer: &Value) -> Page {
    let heading = format!(
        "{}: errors over a workspace of {} positions in the {} frame",
        text_at(answer, "/machine/name"),
        text_at(answer, "/request/workspace/kind"),
        text_at(answer, "/frame")
    );
    let errors = [("tip_rms", "mm"), ("tip_worst", "mm"), ("axis_rms", "deg"), ("axis_worst", "deg")];
    let range = |(name, unit): (&'static str, &str)| {
        let number = |field: &str| number_at(answer, &format!("/errors/{name}/{field}"));
        let at = [0, 1, 2].map(|axis| decimal(number(&format!("at/{axis}")).unwrap_or_default())).join(", ");
        let text = match (number("least"), number("largest")) {
            (Some(least), Some(largest)) => {
                format!("{} to {} {unit}, the largest at {at}", significant(least), significant(largest))
            }
            _ => "none".to_owned(),
        };
        (name, text)
    };
    let count = |pointer: &str| number_at(answer, pointer).unwrap_or_default();
    let fields = [
        ("points", format!("{} inside the workspace", count("/inside"))),
        ("mesh", format!("{} triangles, {} vertices", count("/triangles"), count("/vertices"))),
        ("not checked", not_checked(answer)),
        ("id", text_at(answer, "/id").to_owned()),
    ];
    Page::new(heading)
        .fields(errors.map(range))
        .fields(fields)
        .sentence("A mesh: -o FILE. The points: --cells FILE. All fields: --json.")
}

/// The status of the only row, with the limit that it is nearest to, or the error of the row.
fn status(answer: &Value) -> String {
    let text = |name: &str| answer[name][0].as_str().unwrap_or_default();
    match answer.pointer("/errors/0/detail").and_then(Value::as_str) {
        Some(detail) => format!("{}: {detail}", text("status")),
        None => format!("{}, {} {}", text("status"), text("constraint"), text("element")),
    }
}

fn length(number: Option<f64>, unit: &str) -> String {
    number.map(|number| format!("{} {unit}", significant(number))).unwrap_or_default()
}

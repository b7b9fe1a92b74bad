//! The answer of `verne calibrate`.

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::table::Table;
use crate::process::cli::words::values::{counted, number_at, text_at};

/// Outliers that are listed.
const OUTLIERS: usize = 10;

/// The parameters, what is not identifiable, outliers, and the poses to measure next.
pub(crate) fn calibration(answer: &Value) -> Page {
    let start = text_at(answer, "/start/name");
    let measurements = list(answer, "residuals").len();
    let heading = if answer["rms"].is_null() {
        format!("{start}: what the poses would identify")
    } else {
        format!("{start}: calibrated with {}", counted(measurements, "measurement"))
    };
    let rank = format!("{} of {}", answer["rank"], answer["unknowns"]);
    let micrometres = |pointer| number_at(answer, pointer).map(|mm| format!("{:.2} µm", 1000.0 * mm));
    let figures = [
        ("identified", Some(rank)),
        ("residuals (rms)", micrometres("/rms")),
        ("accuracy (sigma)", micrometres("/sigma")),
    ];
    let figures = figures.into_iter().filter_map(|(name, value)| Some((name, value?)));
    let page = Page::new(heading).fields(figures).table(parameters(answer));
    let page = list(answer, "unidentifiable").iter().fold(page, |page, combination| {
        page.sentence(format!("Not identifiable: {}.", combination_in_words(combination)))
    });
    let page = outliers(page, answer);
    let page = next(page, answer);
    let page = offsets(page, answer);
    page.sentence("Equal rods within each leg are assumed. All fields: --json.")
}

fn list<'a>(answer: &'a Value, name: &str) -> &'a [Value] {
    answer[name].as_array().map_or(&[], Vec::as_slice)
}

/// Five decimals, or four significant digits for small numbers.
fn fine(value: &Value) -> String {
    value.as_f64().map_or_else(String::new, |number| format!("{number:.5}"))
}

fn parameters(answer: &Value) -> Table {
    let parameters = list(answer, "parameters");
    let column = |name: &'static str| parameters.iter().map(move |parameter| fine(&parameter[name]));
    let remark = |parameter: &Value| {
        if parameter["at_bound"] == true {
            "at its bound"
        } else if parameter["identifiable"] == false {
            "not identifiable"
        } else {
            ""
        }
    };
    Table::default()
        .texts("parameter", parameters.iter().map(|parameter| text_at(parameter, "/name")))
        .texts("start", column("start"))
        .texts("value", column("value"))
        .texts("sigma", column("sigma"))
        .texts("unit", parameters.iter().map(|parameter| text_at(parameter, "/unit")))
        .texts("", parameters.iter().map(remark))
}

fn combination_in_words(combination: &Value) -> String {
    let entries = combination.as_object().into_iter().flatten();
    let term = |(name, amount): (&String, &Value)| {
        let amount = amount.as_f64().unwrap_or_default();
        if (amount - 1.0).abs() < 1e-6 { name.clone() } else { format!("{amount:.4} {name}") }
    };
    entries.map(term).collect::<Vec<_>>().join(", ") + " together"
}

fn outliers(page: Page, answer: &Value) -> Page {
    let found = list(answer, "outliers");
    if found.is_empty() {
        return page;
    }
    let shown = &found[..found.len().min(OUTLIERS)];
    let number = |name: &'static str| shown.iter().map(move |outlier| outlier[name].as_f64());
    let table = Table::default()
        .texts("measurement", shown.iter().map(|outlier| outlier["measurement"].to_string()))
        .numbers("residual, mm", number("residual"))
        .numbers("times its sigma", number("ratio"));
    let page = page.heading(counted(found.len(), "outlier")).table(table);
    if answer["outliers"].as_array().is_some_and(|all| all.len() > OUTLIERS) {
        return page.sentence("The others: --json.");
    }
    page
}

fn next(page: Page, answer: &Value) -> Page {
    let poses = list(answer, "next");
    if poses.is_empty() {
        return page;
    }
    let names = ["rho1", "rho2", "rho3", "theta1", "theta2"];
    let table = names.iter().enumerate().fold(Table::default(), |table, (i, name)| {
        table.numbers(name, poses.iter().map(move |pose| pose[i].as_f64()))
    });
    page.heading("Measure next").table(table)
}

fn offsets(page: Page, answer: &Value) -> Page {
    let offsets = list(answer, "slider_offsets");
    if answer["rms"].is_null() || offsets.iter().all(|offset| offset == 0.0) {
        return page;
    }
    let offsets: Vec<_> = offsets.iter().map(fine).collect();
    page.sentence(format!(
        "The machine's sliders stand at what the control indicates plus {} mm: add that to rho in requests, or shift \
         the zeros of the control.",
        offsets.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::calibration;
    use crate::process::cli::terminal::Terminal;

    #[test]
    fn the_summary_names_what_matters() {
        let parameter = |name: &str, sigma| {
            json!({"name": name, "unit": "mm", "start": 1050.0, "value": 1050.25,
            "sigma": sigma, "identifiable": name != "e1", "at_bound": name == "R1"})
        };
        let answer = json!({"start": {"name": "verne"}, "rank": 11, "unknowns": 13, "rms": 0.00195, "sigma": 0.002,
            "parameters": [parameter("L1", json!(0.0123)), parameter("e1", json!(null)), parameter("R1", json!(null))],
            "unidentifiable": [{"e1": 1.0, "e2": 1.0, "frame.x": -1.0}], "residuals": [[0.1], [0.2]],
            "outliers": [{"measurement": 7, "residual": 0.5, "ratio": 31.2}], "next": [[1.0, 2.0, 3.0]],
            "slider_offsets": [0.1, 0.0, -0.2]});
        let text = calibration(&answer).text(Terminal { width: 100, colours: false });
        for part in [
            "calibrated with 2 measurements",
            "11 of 13",
            "1.95 µm",
            "0.01230",
            "not identifiable",
            "at its bound",
            "e1, e2, -1.0000 frame.x together",
            "1 outlier",
            "Measure next",
            "0.10000, 0.00000, -0.20000",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}

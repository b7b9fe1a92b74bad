//! The answer of `verne atlas`.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::table::Table;
use crate::process::cli::words::values::{count_at, counted, number_at, text_at};

/// The regions of one number of solutions together.
#[derive(Default)]
struct Share {
    regions: usize,
    /// mm².
    area: f64,
    area_error: f64,
}

/// An atlas: the areas of the regions by their number of solutions.
pub(crate) fn atlas(answer: &Value) -> Page {
    let number = |pointer: &str| number_at(answer, pointer).unwrap_or_default();
    let name = |axis: usize| text_at(answer, &format!("/coordinates/{axis}"));
    let range =
        |side: &str| format!("{} to {} mm", number(&format!("{side}/0")), number(&format!("{side}/1")));
    let counted_solutions = match text_at(answer, "/space") {
        "joints" => "forward solutions",
        _ => "inverse solutions",
    };
    let shares = shares(answer);
    let table = Table::default()
        .texts("solutions", shares.keys().map(u64::to_string))
        .texts("regions", shares.values().map(|share| share.regions.to_string()))
        .numbers("area, mm²", shares.values().map(|share| Some(share.area)))
        .numbers("±", shares.values().map(|share| Some(share.area_error)));
    let mut fields = vec![
        (name(0).to_owned(), range("/window/u")),
        (name(1).to_owned(), range("/window/v")),
        ("tolerance".to_owned(), format!("{} mm", number("/tolerance"))),
        ("curves".to_owned(), counted(count_at(answer, "/curves"), "curve")),
        ("points".to_owned(), counted(count_at(answer, "/points"), "special point")),
    ];
    fields.push(("working mode".to_owned(), format!("{:.3} mm²", number("/working/area"))));
    fields.push(("checked".to_owned(), counted(count_of(answer, "checked_points"), "point")));
    Page::new(format!("{}: {counted_solutions}", text_at(answer, "/machine/name")))
        .table(table)
        .fields(fields)
        .sentence("A drawing: -o FILE.svg or FILE.dxf. Curves and regions: --json.")
}

fn shares(answer: &Value) -> BTreeMap<u64, Share> {
    let mut shares: BTreeMap<u64, Share> = BTreeMap::new();
    for region in answer["regions"].as_array().into_iter().flatten() {
        let share = shares.entry(region["solutions"].as_u64().unwrap_or_default()).or_default();
        share.regions += 1;
        share.area += number_at(region, "/area").unwrap_or_default();
        share.area_error += number_at(region, "/area_error").unwrap_or_default();
    }
    shares
}

fn count_of(answer: &Value, name: &str) -> usize {
    answer[name].as_u64().and_then(|count| usize::try_from(count).ok()).unwrap_or_default()
}

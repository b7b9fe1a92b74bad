//! The answers of `verne workspace` and `verne dexterity`.

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::values::{count_at, counted, decimal, not_checked, number_at, text_at};

/// The summary of a workspace, or one of its slices.
pub(crate) fn workspace(answer: &Value) -> Page {
    if answer.get("polygons").is_some() {
        return slice(answer);
    }
    let heading = format!(
        "{}: workspace of {} positions in the {} frame",
        text_at(answer, "/machine/name"),
        text_at(answer, "/kind"),
        text_at(answer, "/frame")
    );
    let mut fields =
        vec![("volume", with_error(answer, "volume", "mm³")), ("area", with_error(answer, "area", "mm²"))];
    fields.extend(bounds(&answer["bounds"]));
    fields.push(("mesh", mesh(answer)));
    fields.push(("explanation", text_at(answer, "/explanation").to_owned()));
    fields.extend(common(answer));
    Page::new(heading).fields(fields).sentence("A mesh: -o FILE. All fields: --json.")
}

/// The summary of a dexterity map.
pub(crate) fn dexterity(answer: &Value) -> Page {
    let mut page = Page::new(format!("{}: dexterity map", text_at(answer, "/machine/name")));
    for set in ["reachable", "dexterous"] {
        let answer = &answer[set];
        let mut fields = vec![("volume", with_error(answer, "volume", "mm³"))];
        fields.extend(bounds(&answer["bounds"]));
        fields.push(("mesh", mesh(answer)));
        page = page.heading(set).fields(fields);
    }
    let grid = [0, 1, 2].map(|axis| number_at(answer, &format!("/grid/counts/{axis}")).unwrap_or_default());
    let [x, y, z] = grid.map(|count| count.to_string());
    let reached = number_at(answer, "/reached").unwrap_or_default();
    let mut fields = vec![("points", format!("{x} x {y} x {z}, of which {reached} can be reached"))];
    fields.extend(common(answer));
    page.heading("grid")
        .fields(fields)
        .sentence("A mesh: -o FILE. The points: --cells FILE. All fields: --json.")
}

fn slice(answer: &Value) -> Page {
    let z = number_at(answer, "/z").unwrap_or_default();
    let polygons = answer["polygons"].as_array().map(Vec::as_slice).unwrap_or_default();
    let holes = polygons.iter().map(|polygon| count_at(polygon, "/holes")).sum();
    let (holes, lines) = (counted(holes, "hole"), counted(count_at(answer, "/contours"), "line"));
    let mut fields = vec![
        ("area", format!("{} mm²", decimal(number_at(answer, "/area").unwrap_or_default()))),
        ("outline", format!("{} with {holes}", counted(polygons.len(), "polygon"))),
        ("alpha", format!("{lines} of constant alpha")),
    ];
    fields.extend(common(answer));
    Page::new(format!("Slice at z = {z} mm in the {} frame", text_at(answer, "/frame")))
        .fields(fields)
        .sentence("A drawing: -o FILE.svg or FILE.dxf. The corners: --json.")
}

/// A number with its error; without a number, that there is none.
fn with_error(answer: &Value, name: &str, unit: &str) -> String {
    let number = |name: &str| answer[name].as_f64();
    match (number(name), number(&format!("{name}_error"))) {
        (Some(value), Some(error)) => format!("{} ± {} {unit}", decimal(value), decimal(error)),
        _ => "none".to_owned(),
    }
}

fn bounds(bounds: &Value) -> impl Iterator<Item = (&'static str, String)> {
    let range = |axis: usize| Some([bounds["min"][axis].as_f64()?, bounds["max"][axis].as_f64()?]);
    let texts = [0, 1, 2].map(|axis| {
        range(axis)
            .map(|range| format!("{} to {} mm", decimal(range[0]), decimal(range[1])))
            .unwrap_or_default()
    });
    ["x", "y", "z"].into_iter().zip(texts)
}

fn mesh(answer: &Value) -> String {
    let count = |pointer| number_at(answer, pointer).unwrap_or_default();
    format!("{} triangles, {} vertices", count("/triangles"), count("/vertices"))
}

fn common(answer: &Value) -> [(&'static str, String); 2] {
    [("not checked", not_checked(answer)), ("id", text_at(answer, "/id").to_owned())]
}

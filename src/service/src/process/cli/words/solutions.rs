//! The answers of `verne ik` and `verne fk`.

use serde_json::Value;

use crate::process::cli::limit_words::{NamedLimit, rounded};
use crate::process::cli::words::page::Page;
use crate::process::cli::words::table::Table;
use crate::process::cli::words::values::{counted, not_checked, number_at, text_at};

/// The columns of solutions of the inverse problem, and where they are in a solution.
const JOINTS: [(&str, &str); 5] = [
    ("rho1", "/joints/rho/0"),
    ("rho2", "/joints/rho/1"),
    ("rho3", "/joints/rho/2"),
    ("theta1", "/joints/theta1"),
    ("theta2", "/joints/theta2"),
];

/// The columns of solutions of the forward problem: the platform in the base frame, and the tool in the part frame.
const POSES: [(&str, &str); 9] = [
    ("x", "/platform/x"),
    ("y", "/platform/y"),
    ("z", "/platform/z"),
    ("alpha", "/platform/alpha"),
    ("part x", "/part/x"),
    ("part y", "/part/y"),
    ("part z", "/part/z"),
    ("phi1", "/part/phi1"),
    ("phi2", "/part/phi2"),
];

/// The solutions of the inverse problem.
pub(crate) fn inverse(answer: &Value) -> Page {
    page(answer, &JOINTS)
}

/// The solutions of the forward problem.
pub(crate) fn forward(answer: &Value) -> Page {
    page(answer, &POSES)
}

fn page(answer: &Value, columns: &[(&str, &str)]) -> Page {
    let machine = text_at(answer, "/machine/name");
    let solutions = answer["solutions"].as_array().map(Vec::as_slice).unwrap_or_default();
    let not_checked = format!("Not checked: {}.", not_checked(answer));
    if solutions.is_empty() {
        let page = Page::new(format!("{machine}: no solution")).sentence(reason(answer));
        return with_completeness(page, answer).sentence(not_checked);
    }
    let numbers = (1..=solutions.len()).map(|number| number.to_string());
    let table = Table::default().texts("#", numbers);
    let table = columns.iter().fold(table, |table, (name, pointer)| {
        table.numbers(name, solutions.iter().map(|solution| number_at(solution, pointer)))
    });
    let worst = |solution: &Value| limit(&solution["margins"]["worst"]);
    let table =
        table.texts("state", solutions.iter().map(state)).texts("worst limit", solutions.iter().map(worst));
    let is_certified = !answer["completeness"].is_null();
    let table = if is_certified { table.texts("proof", solutions.iter().map(proof)) } else { table };
    let page = Page::new(format!("{machine}: {}", counted(solutions.len(), "solution"))).table(table);
    let page = with_completeness(page, answer);
    let free = answer["free"].as_array().is_some_and(|free| !free.is_empty());
    let page = if free { page.sentence("The pose does not determine phi2.") } else { page };
    page.sentence(format!("Lengths in mm, angles in degrees. {not_checked} All fields: --json."))
}

/// A solution that is not in the working mode breaks limits, too.
fn state(solution: &Value) -> &'static str {
    match (solution["working"] == true, solution["feasible"] == true) {
        (_, true) => "feasible",
        (true, false) => "infeasible",
        (false, false) => "not working",
    }
}

/// Whether a solution is proved, and to how many millimetres.
fn proof(solution: &Value) -> String {
    let certificate = &solution["certificate"];
    if certificate["proved"] != true {
        return text_at(certificate, "/reason").replace('_', " ");
    }
    let found = &certificate["box"];
    let lengths =
        ["/x", "/y", "/z", "/rho/0", "/rho/1", "/rho/2"].into_iter().filter_map(|at| found.pointer(at));
    let widths = lengths.filter_map(|bounds| Some(bounds[1].as_f64()? - bounds[0].as_f64()?));
    format!("within {:.0e} mm", widths.fold(0.0, f64::max))
}

/// Whether there are no other solutions.
fn with_completeness(page: Page, answer: &Value) -> Page {
    let completeness = &answer["completeness"];
    if completeness.is_null() {
        return page;
    }
    let because = match text_at(completeness, "/reason") {
        "" => return page.sentence("It is proved that there are no other solutions."),
        "unproved_solution" => "a solution is not proved",
        "undecided_mode" => "rounding decides whether a solution is in the working mode",
        "self_motion" => "the solutions form a curve",
        "free_phi2" => "phi2 is free, and each has its own",
        _ => "rounding decides, as where two solutions nearly merge",
    };
    page.sentence(format!("It is not proved that there are no other solutions: {because}."))
}

/// A limit with its margin.
fn limit(limit: &Value) -> String {
    let Some(value) = limit["value"].as_f64() else { return String::new() };
    let unit = Some(text_at(limit, "/unit")).filter(|unit| *unit != "1").unwrap_or_default();
    format!("{} {} {unit}", text_at(limit, "/element"), rounded(value)).trim_end().to_owned()
}

/// Why there is no solution.
fn reason(answer: &Value) -> String {
    let because = match text_at(answer, "/reason") {
        "infeasible" => "Every working solution breaks a limit",
        "self_motion" => "The platform can move while all sliders are locked",
        _ => "The equations have no solution",
    };
    let limit = &answer["constraint"];
    match limit["value"].as_f64() {
        Some(margin) => {
            let text = |name: &str| text_at(limit, name).to_owned();
            let named = NamedLimit {
                constraint: text("/constraint"),
                element: text("/element"),
                margin,
                unit: text("/unit"),
            };
            format!("{because}: {}.", named.in_words())
        }
        None => format!("{because}."),
    }
}

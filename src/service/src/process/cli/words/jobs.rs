//! The answers of `verne jobs`.

use serde_json::Value;

use crate::process::cli::words::page::Page;
use crate::process::cli::words::table::Table;
use crate::process::cli::words::values::{counted, number_at, text_at};

/// A list of jobs.
pub(crate) fn list(answer: &Value) -> Page {
    let jobs = answer["jobs"].as_array().map(Vec::as_slice).unwrap_or_default();
    let page = Page::new(counted(jobs.len(), "job"));
    let page = if jobs.is_empty() { page } else { page.table(table(jobs)) };
    match text_at(answer, "/next") {
        "" => page,
        next => page.sentence(format!("Older jobs: --after {next}")),
    }
}

/// One job.
pub(crate) fn one(job: &Value) -> Page {
    Page::new("job").table(table(std::slice::from_ref(job)))
}

fn table(jobs: &[Value]) -> Table {
    let text = |pointer: &'static str| jobs.iter().map(move |job| text_at(job, pointer).to_owned());
    let progress = |job: &Value| format!("{:3.0} %", 100.0 * number_at(job, "/progress").unwrap_or_default());
    Table::default()
        .texts("state", text("/state"))
        .texts("done", jobs.iter().map(progress))
        .texts("kind", text("/kind"))
        .texts("machine", text("/machine/name"))
        .texts("created", text("/created").map(|time| seconds(&time)))
        .texts("id", text("/id"))
        .texts("error", text("/error/detail"))
}

/// `2026-11-29 22:51:01` of `2026-11-29T22:51:01.123Z`. The time zone is UTC.
fn seconds(time: &str) -> String {
    time.split('.').next().unwrap_or_default().replace('T', " ")
}

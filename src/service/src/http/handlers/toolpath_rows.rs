//! `/toolpath/{id}/rows`: the joint motion.

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::Conditions;
use crate::http::error::HttpError;
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::job_document::{JobObject, accepted};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, Text};
use crate::http::openapi::problem_responses::RowsProblems;
use crate::http::result_or_job::ResultOrJob;
use crate::http::state::SharedState;
use crate::http::toolpath_rows::{RowsResponse, rows_or_job, toolpath_record};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::toolpath_row_text::{RowText, RowWriter};
use crate::wire::row_format::RowFormat;
use crate::wire::toolpath_row::{RowsQuery, ToolpathRows};

/// The joint motion of a program
///
/// Returns the rows of a tool path: the joints to which the machine moves, all of them linearly from the row before,
/// with the tool's end and axis in the part frame, and the worst margin. `from` and `to` select rows by their number.
/// The path without the extension selects the format by `format` or Accept; its default is JSON. The service sends the
/// rows while it reads them, and supports strong ETags.
#[utoipa::path(
    get, path = "/toolpath/{id}/rows", operation_id = "get_toolpath_rows", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath."), RowsQuery),
    responses(
        (status = 200, description = "The rows.", content(
            (ToolpathRows = "application/json"), (Text = "application/x-ndjson"), (Text = "text/csv"),
            (Binary = "application/vnd.apache.arrow.stream"),
        )),
        (status = 202, description = "The service evicted the rows. This job computes them again.",
            body = JobObject),
        RowsProblems
    )
)]
pub(crate) async fn get_rows(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<RowsQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let format = match query.format {
        Some(format) => format,
        None => accept.choose(RowFormat::ALL.map(|format| (format.media(), format)))?,
    };
    let (record, count) = toolpath_record(&state, id).await?;
    let (id, range) = (record.id, query.from..query.to.unwrap_or(count));
    check(query.from, query.to, count)?;
    let mut response = match rows_or_job(&state, &record, range.clone(), &wait_policy).await? {
        ResultOrJob::Result(_) => {
            let (tag, media, extension) = (format.name().to_owned(), format.media(), format.name());
            let writer: Box<dyn RowText> = Box::new(RowWriter::new(id, format, range.start)?);
            let rows = RowsResponse { id, range, tag, media, extension };
            rows.respond(&state, &conditions, async { Ok(writer) }).await?
        }
        ResultOrJob::Job(job) => accepted(&job, &state.base)?,
    };
    wait_policy.state_preference(&mut response);
    Ok(response)
}

/// Checks the range of rows.
fn check(from: u64, to: Option<u64>, count: u64) -> Result<(), HttpError> {
    let to_or_end = to.unwrap_or(count);
    if to_or_end > count {
        return Err(HttpError::field("/query/to", format!("must be at most {count}, the number of rows")));
    }
    if from > to_or_end {
        let last = if to.is_some() { "to" } else { "the number of rows" };
        return Err(HttpError::field("/query/from", format!("must be at most {to_or_end}: {last}")));
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Body, Bytes};
    use axum::http::header::{ACCEPT, CONTENT_TYPE, ETAG, IF_NONE_MATCH};
    use axum::http::{HeaderMap, HeaderName, Request, StatusCode};
    use serde_json::{Value, json};

    use crate::process::service::Service;
    use crate::test_service::{send, service};

    async fn get(
        service: &Service,
        path: &str,
        header: (HeaderName, &str),
    ) -> (StatusCode, HeaderMap, Bytes) {
        let request = Request::get(path).header(header.0, header.1);
        send(service, request.body(Body::empty()).unwrap()).await
    }

    /// A service, the path of the rows of a tool path, and their number: several chunks.
    async fn planned() -> (Service, String, usize) {
        let service = service("").await;
        let points: Vec<_> = (0..9000).map(|i| json!([i % 90, i % 70, 300 + i % 2])).collect();
        let body = json!({"program": {"points": points}, "tool_length": 50, "tolerance": {"tip": 50}});
        let request = Request::post("/toolpath").header(CONTENT_TYPE, "application/json");
        let (status, _, report) = send(&service, request.body(body.to_string().into()).unwrap()).await;
        let report: Value = serde_json::from_slice(&report).unwrap();
        assert_eq!(status, StatusCode::OK, "{report}");
        let count = usize::try_from(report["rows"].as_u64().unwrap()).unwrap();
        assert!(count > 8192, "{count}");
        (service, report["links"]["rows"].as_str().unwrap().to_owned(), count)
    }

    #[tokio::test]
    async fn all_formats_have_the_same_rows() {
        let (service, path, count) = planned().await;
        let (status, headers, json) = get(&service, &path, (ACCEPT, "*/*")).await;
        assert_eq!((status, headers[CONTENT_TYPE].to_str().unwrap()), (StatusCode::OK, "application/json"));
        let json: Value = serde_json::from_slice(&json).unwrap();
        let rows = json["rows"].as_array().unwrap();
        assert_eq!((rows.len(), &json["from"], &json["to"]), (count, &json!(0), &json!(count)));
        assert_eq!(
            (&rows[0]["line"], &rows[0]["x"], &rows[0]["duration"]),
            (&json!(1), &json!(0.0), &Value::Null)
        );
        let (_, _, lines) = get(&service, &path, (ACCEPT, "application/x-ndjson")).await;
        let lines = lines.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
        let lines: Vec<Value> = lines.map(|line| serde_json::from_slice(line).unwrap()).collect();
        assert!(lines == *rows);
        let (_, _, csv) = get(&service, &format!("{path}?format=csv"), (ACCEPT, "*/*")).await;
        let csv = String::from_utf8(csv.into()).unwrap();
        let mut csv = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let names = csv.next().unwrap();
        for (row, texts) in rows.iter().zip(csv.by_ref()) {
            assert_eq!(names.len(), texts.len());
            for (name, text) in names.iter().zip(texts) {
                let written = match &row[*name] {
                    Value::Number(number) => Some(number.as_f64()) == Some(text.parse().ok()),
                    Value::String(known) => known == text,
                    other => other.is_null() && text.is_empty(),
                };
                assert!(written, "{name}: {text} {row}");
            }
        }
        assert!(csv.next().is_none());
    }

    #[tokio::test]
    async fn rows_are_found_by_their_number() {
        let (service, path, count) = planned().await;
        let (_, _, all) = get(&service, &format!("{path}?format=ndjson"), (ACCEPT, "*/*")).await;
        let all: Vec<&[u8]> = all.split_inclusive(|byte| *byte == b'\n').collect();
        for (from, to) in [(0, 1), (1000, 1050), (8190, 8195), (count - 1, count), (count, count), (5, 5)] {
            let some = format!("{path}?format=ndjson&from={from}&to={to}");
            let (status, headers, rows) = get(&service, &some, (ACCEPT, "*/*")).await;
            assert_eq!(status, StatusCode::OK);
            assert!(rows == all[from..to].concat(), "{from} {to}");
            let tag = headers[ETAG].to_str().unwrap();
            let (status, _, rest) = get(&service, &some, (IF_NONE_MATCH, tag)).await;
            assert_eq!((status, rest.len()), (StatusCode::NOT_MODIFIED, 0));
        }
        for (query, pointer) in
            [("to=99999999", "/query/to"), ("from=99999999", "/query/from"), ("from=5&to=4", "/query/from")]
        {
            let (status, _, problem) = get(&service, &format!("{path}?{query}"), (ACCEPT, "*/*")).await;
            let problem: Value = serde_json::from_slice(&problem).unwrap();
            assert_eq!((status.as_u16(), &problem["errors"][0]["pointer"]), (422, &json!(pointer)));
        }
    }
}

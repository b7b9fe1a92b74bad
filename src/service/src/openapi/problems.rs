//! The failures that operations document.

use std::collections::BTreeMap;

use serde_json::json;
use utoipa::IntoResponses;
use utoipa::openapi::{ContentBuilder, Ref, RefOr, Response, ResponseBuilder};

use crate::access::Role;
use crate::error::{Error, Fault};
use crate::problem::{PROBLEM_JSON, Problem};

/// Every reason for 503.
const BUSY: &str = "The queue is full, too much is worked on, the service is stopping, jobs cannot be recorded, or the \
                    answer took too long (`queue_full`, `overloaded`, `stopping`, `jobs_unavailable`, `timed_out`, \
                    `job_too_long`).";

type Responses = BTreeMap<String, RefOr<Response>>;

/// Failures of every operation.
pub(crate) struct ServiceProblems;

/// Failures of what takes a key.
pub(crate) struct KeyProblems;

/// Failures of who asks too fast.
pub(crate) struct RateProblems;

/// Failures of what not every key may.
pub(crate) struct ForbiddenProblem;

/// Failures of a question in the query string.
pub(crate) struct QueryProblems;

/// Failures of a question in the body.
pub(crate) struct BodyProblems;

/// Failures of a batch.
pub(crate) struct BatchProblems;

/// Failures of a workspace in the query string.
pub(crate) struct WorkspaceQueryProblems;

/// Failures of a workspace in the body.
pub(crate) struct WorkspaceBodyProblems;

/// Failures of asking for a result by its id.
pub(crate) struct KeptProblems;

/// Failures of asking for a result by its id and parameters.
pub(crate) struct KeptQueryProblems;

/// Failures of asking for a mesh by its id.
pub(crate) struct MeshProblems;

/// Failures of asking for a machine by name.
pub(crate) struct MachineProblems;

/// Failures of asking for a job by its id.
pub(crate) struct JobProblems;

/// Failures of asking whether the service is ready.
pub(crate) struct ReadyProblems;

impl IntoResponses for ServiceProblems {
    fn responses() -> Responses {
        [
            documented("A defect of the service (`internal`).", Error::Internal),
            documented(
                "Too much is worked on, or the answer took too long (`overloaded`, `timed_out`).",
                Error::Overloaded,
            ),
        ]
        .into()
    }
}

impl IntoResponses for KeyProblems {
    fn responses() -> Responses {
        let words = "The service has keys, and none that it knows was sent (`unauthorized`).";
        [documented(words, Error::Unauthorized)].into()
    }
}

impl IntoResponses for RateProblems {
    fn responses() -> Responses {
        let words = "The key or address asks faster than it may (`too_many_requests`).";
        [documented(words, Error::TooManyRequests(1))].into()
    }
}

impl IntoResponses for ForbiddenProblem {
    fn responses() -> Responses {
        [documented("The role of the key does not suffice (`forbidden`).", Error::Forbidden(Role::Compute))]
            .into()
    }
}

impl IntoResponses for QueryProblems {
    fn responses() -> Responses {
        let fault = Fault::new("/query/x", "must be a finite number within ±1e7 mm");
        with(
            ServiceProblems::responses(),
            [documented("A parameter cannot be used (`invalid_request`).", Error::Fields(vec![fault]))],
        )
    }
}

impl IntoResponses for BodyProblems {
    fn responses() -> Responses {
        with(
            of_bodies(),
            [documented("The body is too large (`body_too_large`).", Error::BodyTooLarge(65_536))],
        )
    }
}

impl IntoResponses for BatchProblems {
    fn responses() -> Responses {
        let error = Error::TooManyRows { rows: 200_000, limit: 100_000 };
        let description = "The body or the batch is too large (`body_too_large`, `too_many_rows`).";
        with(of_bodies(), [documented(description, error)])
    }
}

impl IntoResponses for WorkspaceQueryProblems {
    fn responses() -> Responses {
        with(with(QueryProblems::responses(), [not_acceptable(), beyond_the_end()]), of_jobs())
    }
}

impl IntoResponses for WorkspaceBodyProblems {
    fn responses() -> Responses {
        let no_mesh = documented("A family has no mesh (`no_mesh`).", Error::NoMesh("1f2e".to_owned()));
        with(with(BodyProblems::responses(), [not_acceptable(), no_mesh]), of_jobs())
    }
}

impl IntoResponses for KeptProblems {
    fn responses() -> Responses {
        let unknown = Error::NoSuchWorkspace("1f2e".to_owned());
        let unknown = documented(
            "No result is kept under this id, or it has no such part (`workspace_not_found`, `no_mesh`, `no_slice`, `no_cells`).",
            unknown,
        );
        with(ServiceProblems::responses(), [unknown, not_acceptable(), beyond_the_end()])
    }
}

impl IntoResponses for KeptQueryProblems {
    fn responses() -> Responses {
        with(QueryProblems::responses(), KeptProblems::responses())
    }
}

impl IntoResponses for MeshProblems {
    fn responses() -> Responses {
        with(with(KeptQueryProblems::responses(), of_jobs()), ForbiddenProblem::responses())
    }
}

impl IntoResponses for JobProblems {
    fn responses() -> Responses {
        let unknown = Error::NoSuchJob("1f2e".to_owned());
        with(
            ServiceProblems::responses(),
            [
                documented("No job is known under this id (`job_not_found`).", unknown),
                documented(BUSY, Error::JobsUnavailable),
            ],
        )
    }
}

impl IntoResponses for ReadyProblems {
    fn responses() -> Responses {
        let words = "It is stopping, or the disk takes no results or no jobs (`stopping`, `disk_failing`, `jobs_unavailable`).";
        with(ServiceProblems::responses(), [documented(words, Error::DiskFailing)])
    }
}

/// Failures of waiting for a job.
fn of_jobs() -> [(String, RefOr<Response>); 3] {
    [
        documented(BUSY, Error::QueueFull(12)),
        documented(
            "The job was cancelled, or asked for by another version (`job_cancelled`, `other_version`).",
            Error::JobCancelled,
        ),
        documented("The result is larger than the room for results (`no_room`).", Error::NoRoom),
    ]
}

fn not_acceptable() -> (String, RefOr<Response>) {
    let error = Error::NotAcceptable(vec!["application/json", "model/gltf-binary"]);
    documented("Accept names nothing that can be had (`not_acceptable`).", error)
}

fn beyond_the_end() -> (String, RefOr<Response>) {
    let error = Error::RangeNotSatisfiable(162_300);
    documented("The range starts beyond the end (`range_not_satisfiable`).", error)
}

impl IntoResponses for MachineProblems {
    fn responses() -> Responses {
        let error = Error::NoSuchMachine("nautilus".to_owned());
        with(
            ServiceProblems::responses(),
            [documented("No machine has this name (`machine_not_found`).", error)],
        )
    }
}

fn of_bodies() -> Responses {
    let fault =
        Fault::new("/machine/limits/stroke/0", "must be [min, max] with min < max, both within ±1000000 mm");
    with(
        ServiceProblems::responses(),
        [
            documented(
                "The body is not JSON (`bad_json`) or broke off (`bad_request`).",
                Error::Syntax("EOF while parsing a value at line 1 column 0".to_owned()),
            ),
            documented("The body is not declared as JSON (`unsupported_media_type`).", Error::NotJson(None)),
            documented("A field cannot be used (`invalid_request`).", Error::Fields(vec![fault])),
        ],
    )
}

fn with(mut responses: Responses, more: impl IntoIterator<Item = (String, RefOr<Response>)>) -> Responses {
    responses.extend(more);
    responses
}

fn documented(description: &str, error: Error) -> (String, RefOr<Response>) {
    let problem = Problem::from(error);
    let content = ContentBuilder::new()
        .schema(Some(Ref::from_schema_name("Problem")))
        .example(Some(json!(problem)))
        .build();
    let response = ResponseBuilder::new().description(description).content(PROBLEM_JSON, content).build();
    (problem.status().to_string(), response.into())
}

//! The failures that operations document.

use std::collections::BTreeMap;

use serde_json::json;
use utoipa::IntoResponses;
use utoipa::openapi::example::ExampleBuilder;
use utoipa::openapi::{Content, OpenApi, Ref, RefOr, Response};

use crate::http::problem::code::Code;
use crate::http::problem::{PROBLEM_JSON, Problem};

/// Failures of every operation.
const ALWAYS: &[Code] = &[Code::InvalidRequest, Code::NotAcceptable, Code::Internal, Code::TimedOut];

const BODY: &[Code] = &[
    Code::BadJson,
    Code::BadRequest,
    Code::UnsupportedMediaType,
    Code::UnsupportedCoding,
    Code::BodyTooLarge,
];

/// Failures of waiting for a job.
const WAITING: &[Code] = &[
    Code::QueueFull,
    Code::Stopping,
    Code::JobsUnavailable,
    Code::DiskFailing,
    Code::JobTooLong,
    Code::JobCancelled,
    Code::OtherVersion,
    Code::NoRoom,
];

/// Failures of asking for a result by its id.
const KEPT: &[Code] = &[Code::NotFound, Code::WorkspaceNotFound, Code::RangeNotSatisfiable];

type Responses = BTreeMap<String, RefOr<Response>>;

macro_rules! problems {
    ($($(#[$doc:meta])* $name:ident: $($codes:expr),*;)*) => {$(
        $(#[$doc])*
        pub(crate) struct $name;

        impl IntoResponses for $name {
            fn responses() -> Responses {
                let mut responses = Responses::new();
                for codes in [ALWAYS, $($codes),*] {
                    document(&mut responses, codes);
                }
                responses
            }
        }
    )*};
}

problems! {
    /// Failures of every operation.
    ServiceProblems: ;
    /// Failures of a question in the query string.
    QueryProblems: ;
    /// Failures of a question in the body.
    BodyProblems: BODY;
    /// Failures of a batch.
    BatchProblems: BODY, &[Code::TooManyRows];
    /// Failures of a workspace in the query string.
    WorkspaceQueryProblems: WAITING, &[Code::RangeNotSatisfiable];
    /// Failures of a workspace, or a family of them, in the body.
    WorkspaceBodyProblems: BODY, WAITING, &[Code::NoMesh];
    /// Failures of a dexterity map.
    DexterityProblems: BODY, WAITING;
    /// Failures of asking for a result's figures by its id.
    KeptProblems: KEPT;
    /// Failures of asking for a slice.
    SliceProblems: KEPT, &[Code::NoSlice];
    /// Failures of asking for a mesh by its id. A mesh that is no longer kept is computed again, which takes a role.
    MeshProblems: KEPT, WAITING, &[Code::NoMesh, Code::Forbidden];
    /// Failures of asking for the points of a dexterity map.
    CellsProblems: KEPT, WAITING, &[Code::NoCells, Code::Forbidden];
    /// Failures of asking for a machine by name.
    MachineProblems: &[Code::NotFound, Code::MachineNotFound];
    /// Failures of listing jobs.
    JobsProblems: &[Code::JobsUnavailable];
    /// Failures of asking for a job by its id.
    JobProblems: &[Code::NotFound, Code::JobNotFound, Code::JobsUnavailable];
    /// Failures of asking whether the service is ready.
    ReadyProblems: &[Code::Stopping, Code::DiskFailing, Code::JobsUnavailable];
}

/// Adds failures to what an operation documents. Each is an example of its status, under the name of its code.
pub(crate) fn document(responses: &mut Responses, codes: &[Code]) {
    for &code in codes {
        let status = code.status().as_str().to_owned();
        let response = responses.entry(status).or_insert_with(|| Response::default().into());
        let RefOr::T(response) = response else { continue };
        let content =
            response.content.entry(PROBLEM_JSON.to_owned()).or_insert_with(|| Content::default().into());
        let RefOr::T(content) = content else { continue };
        content.schema = Some(Ref::from_schema_name("Problem").into());
        let example = Ref::new(format!("#/components/examples/{}", code.name()));
        content.examples.insert(code.name().to_owned(), RefOr::Ref(example));
        let documented = Code::ALL.iter().filter(|code| content.examples.contains_key(code.name()));
        let meanings = documented.map(|code| format!("`{}`: {}", code.name(), code.meaning()));
        response.description = meanings.collect::<Vec<_>>().join(" ");
    }
}

/// The document with an example of every code, and their list.
pub(crate) fn with_codes(mut document: OpenApi) -> OpenApi {
    let mut rows = String::new();
    for &code in Code::ALL {
        let (name, status, meaning) = (code.name(), code.status().as_u16(), code.meaning());
        rows = format!("{rows}| `{name}` | {status} | {meaning} |\n");
        let example =
            ExampleBuilder::new().summary(meaning).value(Some(json!(Problem::from(code.example()))));
        let examples = &mut document.components.get_or_insert_default().examples;
        examples.insert(name.to_owned(), example.build().into());
    }
    let description = document.info.description.get_or_insert_default();
    *description = format!("{description}\n\n| code | status | meaning |\n|---|---|---|\n{rows}");
    document
}

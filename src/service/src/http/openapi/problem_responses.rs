//! The problems that operations document: each type stands for a set of codes.

use std::collections::BTreeMap;

use serde_json::json;
use utoipa::IntoResponses;
use utoipa::openapi::example::ExampleBuilder;
use utoipa::openapi::{Content, OpenApi, Ref, RefOr, Response};

use crate::http::problem::code::Code;
use crate::http::problem::{PROBLEM_JSON, Problem};

/// Codes of every operation.
const COMMON: &[Code] = &[Code::InvalidRequest, Code::NotAcceptable, Code::Internal, Code::TimedOut];

/// Codes of requests with a body.
const BODY: &[Code] = &[
    Code::BadJson,
    Code::BadRequest,
    Code::UnsupportedMediaType,
    Code::UnsupportedCoding,
    Code::BodyTooLarge,
];

/// Codes of requests with a program as their body.
const PROGRAM_BODY: &[Code] = &[
    Code::BadRequest,
    Code::UnsupportedCoding,
    Code::BodyTooLarge,
    Code::ProgramFault,
    Code::ProgramTooLarge,
    Code::DiskFailing,
];

/// Codes of requests that wait for a job.
const JOB: &[Code] = &[
    Code::QueueFull,
    Code::Stopping,
    Code::JobsUnavailable,
    Code::DiskFailing,
    Code::JobTooLong,
    Code::JobCancelled,
    Code::OtherVersion,
    Code::NoRoom,
];

/// Codes of requests for a stored result.
const RESULT: &[Code] = &[Code::NotFound, Code::WorkspaceNotFound, Code::RangeNotSatisfiable];

/// Codes of requests for a stored tool path.
const TOOLPATH: &[Code] = &[Code::NotFound, Code::ToolpathNotFound, Code::RangeNotSatisfiable];

/// Codes of requests with a program.
const PROGRAM: &[Code] = &[Code::ProgramFault, Code::ProgramNotFound];

type Responses = BTreeMap<String, RefOr<Response>>;

macro_rules! problems {
    ($($(#[$doc:meta])* $name:ident: $($codes:expr),*;)*) => {$(
        $(#[$doc])*
        pub(crate) struct $name;

        impl IntoResponses for $name {
            fn responses() -> Responses {
                let mut responses = Responses::new();
                for codes in [COMMON, $($codes),*] {
                    add_codes(&mut responses, codes);
                }
                responses
            }
        }
    )*};
}

problems! {
    /// Problems of every operation.
    CommonProblems: ;
    /// Problems of a request with a body.
    BodyProblems: BODY;
    /// Problems of an atlas in the query string.
    AtlasProblems: &[Code::RangeNotSatisfiable];
    /// Problems of an atlas in the body.
    AtlasBodyProblems: BODY;
    /// Problems of a batch.
    BatchProblems: BODY, &[Code::TooManyRows, Code::BadRows];
    /// Problems of a calibration.
    CalibrationProblems: BODY, &[Code::TooManyRows, Code::BadRows, Code::NoFit];
    /// Problems of a workspace in the query string.
    WorkspaceQueryProblems: JOB, &[Code::RangeNotSatisfiable];
    /// Problems of a workspace, or a family of workspaces, in the body.
    WorkspaceBodyProblems: BODY, JOB, &[Code::NoMesh];
    /// Problems of a dexterity map.
    DexterityProblems: BODY, JOB;
    /// Problems of an error map.
    ErrorMapProblems: BODY, JOB, &[Code::NoMesh];
    /// Problems of the summary of a stored result.
    SummaryProblems: RESULT;
    /// Problems of a slice of a stored result.
    SliceProblems: RESULT, &[Code::NoSlice];
    /// Problems of a mesh of a stored result. If the store evicted the mesh, a job computes it again, which needs a
    /// role.
    MeshProblems: RESULT, JOB, &[Code::NoMesh, Code::Forbidden];
    /// Problems of the points of a map.
    CellsProblems: RESULT, JOB, &[Code::NoCells, Code::Forbidden];
    /// Problems of a program in the body.
    ProgramBodyProblems: PROGRAM_BODY;
    /// Problems of a stored program.
    ProgramProblems: &[Code::NotFound, Code::ProgramNotFound];
    /// Problems of a tool path.
    ToolpathProblems: BODY, JOB, PROGRAM;
    /// Problems of a tool path whose program is the body.
    ToolpathFileProblems: PROGRAM_BODY, JOB;
    /// Problems of the report on a tool path.
    ReportProblems: TOOLPATH;
    /// Problems of the rows of a tool path. If the store evicted them, a job computes them again, which needs a role
    /// and the program.
    RowsProblems: TOOLPATH, JOB, &[Code::Forbidden, Code::ProgramNotFound];
    /// Problems of the joint program of a tool path.
    JointProgramProblems: TOOLPATH, JOB, &[Code::Forbidden, Code::ProgramNotFound, Code::NoJointProgram];
    /// Problems of mesh and slices of a region of origins. If the store evicted the mesh, a job computes it again,
    /// which needs a role and the program.
    RegionProblems: TOOLPATH, JOB, &[Code::NoRegion, Code::Forbidden, Code::ProgramNotFound];
    /// Problems of a machine.
    MachineProblems: &[Code::NotFound, Code::MachineNotFound];
    /// Problems of the list of jobs.
    JobsProblems: &[Code::JobsUnavailable];
    /// Problems of a job.
    JobProblems: &[Code::NotFound, Code::JobNotFound, Code::JobsUnavailable];
    /// Problems of the readiness probe.
    ReadyProblems: &[Code::Stopping, Code::DiskFailing, Code::JobsUnavailable];
}

/// Adds codes to the responses of an operation. Each code is an example of its status.
pub(crate) fn add_codes(responses: &mut Responses, codes: &[Code]) {
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

/// The document with an example of every code, and with the table of codes.
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

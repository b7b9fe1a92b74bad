//! The table of problems: for each error its stable code, status and meaning. Problem documents, the OpenAPI document
//! and its list of codes are made from this table. A new error needs a row here.

use axum::http::StatusCode;
use verne_jobs::UnavailableError;
use verne_program::{Format, ProgramErrors, ReadError, ReadOptions};

use crate::http::error::HttpError::{self, Access, Job, Limit, Lookup, Operation, Request};
use crate::http::error::{AccessError, JobError, LookupError, RequestError};
use crate::limits::error::LimitError;
use crate::wire::error::OperationError;
use crate::wire::role::Role;

/// Each row: code, name, status, meaning; the errors that have this code => an example of them.
macro_rules! problems {
    ($($code:ident, $name:literal, $status:ident, $meaning:literal; $errors:pat => $example:expr;)*) => {
        /// The stable name of a problem, for programs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Code {
            $(#[doc = $meaning] $code,)*
        }

        impl Code {
            /// All codes.
            pub(crate) const ALL: &[Self] = &[$(Self::$code),*];

            /// The name.
            pub(crate) const fn name(self) -> &'static str {
                match self { $(Self::$code => $name),* }
            }

            /// The HTTP status.
            pub(crate) const fn status(self) -> StatusCode {
                match self { $(Self::$code => StatusCode::$status),* }
            }

            /// The meaning, as a sentence.
            pub(crate) const fn meaning(self) -> &'static str {
                match self { $(Self::$code => $meaning),* }
            }

            /// An error with this code, for the OpenAPI document.
            pub(crate) fn example(self) -> HttpError {
                match self { $(Self::$code => $example.into()),* }
            }
        }

        impl From<&HttpError> for Code {
            fn from(error: &HttpError) -> Self {
                match error { $($errors => Self::$code),* }
            }
        }
    };
}

problems! {
    BadJson, "bad_json", BAD_REQUEST, "The body is not JSON.";
        Operation(OperationError::Syntax(_))
            => OperationError::Syntax(
                "expected value at line 1 column 1; it begins with \"rho=674,685,250\"".to_owned());
    BadRequest, "bad_request", BAD_REQUEST, "The body is incomplete, or the service cannot decode it.";
        Request(RequestError::UnreadableBody(_) | RequestError::MalformedHead(_))
            => RequestError::UnreadableBody("it cannot be decoded from gzip: invalid gzip header".to_owned());
    Unauthorized, "unauthorized", UNAUTHORIZED,
        "The service requires an API key, and the request has no valid one.";
        Access(AccessError::Unauthorized) => AccessError::Unauthorized;
    Forbidden, "forbidden", FORBIDDEN, "The role of the API key does not allow this request.";
        Access(AccessError::Forbidden(_)) => AccessError::Forbidden(Role::Compute);
    OtherOrigin, "other_origin", FORBIDDEN,
        "A web page of another origin cannot start or cancel jobs or send POST requests.";
        Access(AccessError::OtherOrigin) => AccessError::OtherOrigin;
    HostNotAllowed, "host_not_allowed", MISDIRECTED_REQUEST,
        "The service does not accept the host name in the header Host.";
        Access(AccessError::HostNotAllowed(_)) => AccessError::HostNotAllowed("example.org".to_owned());
    UriTooLong, "uri_too_long", URI_TOO_LONG, "The request URI is longer than the limit.";
        Request(RequestError::UriTooLong(_)) => RequestError::UriTooLong(16_384);
    HeadersTooLarge, "headers_too_large", REQUEST_HEADER_FIELDS_TOO_LARGE,
        "The size or the number of the request headers exceeds the limit.";
        Request(RequestError::HeadersTooLarge) => RequestError::HeadersTooLarge;
    NotFound, "not_found", NOT_FOUND, "No operation has this path.";
        HttpError::UnknownPath => HttpError::UnknownPath;
    MachineNotFound, "machine_not_found", NOT_FOUND, "No machine has this name.";
        Lookup(LookupError::Machine(_)) => LookupError::Machine("nautilus".to_owned());
    WorkspaceNotFound, "workspace_not_found", NOT_FOUND, "No stored result has this id.";
        Lookup(LookupError::Result(_)) => LookupError::Result("1f2e".to_owned());
    ToolpathNotFound, "toolpath_not_found", NOT_FOUND, "No stored tool path has this id.";
        Lookup(LookupError::Toolpath(_)) => LookupError::Toolpath("1f2e".to_owned());
    ProgramNotFound, "program_not_found", NOT_FOUND,
        "The service has no program with this id, or has evicted it; the client can send it again.";
        Operation(OperationError::ProgramNotFound(_)) => OperationError::ProgramNotFound("1f2e".to_owned());
    NoMesh, "no_mesh", NOT_FOUND, "A family of workspaces has no mesh of its own.";
        Lookup(LookupError::Mesh(_)) => LookupError::Mesh("1f2e".to_owned());
    NoSlice, "no_slice", NOT_FOUND, "Only a single workspace has slices.";
        Lookup(LookupError::Slice(_)) => LookupError::Slice("1f2e".to_owned());
    NoRegion, "no_region", NOT_FOUND, "Only a region of origins has a mesh and slices.";
        Lookup(LookupError::Region(_)) => LookupError::Region("1f2e".to_owned());
    NoCells, "no_cells", NOT_FOUND, "Only a dexterity map and an error map have a grid of points.";
        Lookup(LookupError::Grid(_)) => LookupError::Grid("1f2e".to_owned());
    JobNotFound, "job_not_found", NOT_FOUND, "No job record has this id.";
        Lookup(LookupError::Job(_)) => LookupError::Job("1f2e".to_owned());
    MethodNotAllowed, "method_not_allowed", METHOD_NOT_ALLOWED, "The path does not support the method.";
        HttpError::MethodNotAllowed => HttpError::MethodNotAllowed;
    NotAcceptable, "not_acceptable", NOT_ACCEPTABLE,
        "Accept allows no available media type, or Accept-Encoding allows no available coding.";
        HttpError::NotAcceptable(_) | HttpError::NoAcceptableCoding
            => HttpError::NotAcceptable(vec!["application/json"]);
    JobCancelled, "job_cancelled", CONFLICT, "The job was cancelled while the request waited for it.";
        Job(JobError::Cancelled) | Operation(OperationError::Cancelled) => JobError::Cancelled;
    NoJointProgram, "no_joint_program", CONFLICT,
        "The machine cannot run the program, or a move of it has no duration.";
        Operation(OperationError::NoJointProgram(_)) => OperationError::NoJointProgram(
            "the machine cannot run the program; the report says why".to_owned());
    OtherVersion, "other_version", CONFLICT, "A binary of another version, or for another target, created the job.";
        Operation(OperationError::OtherVersion) => OperationError::OtherVersion;
    BodyTooLarge, "body_too_large", PAYLOAD_TOO_LARGE, "The decoded body is larger than the limit.";
        Request(RequestError::BodyTooLarge(_)) => RequestError::BodyTooLarge(65_536);
    TooManyRows, "too_many_rows", PAYLOAD_TOO_LARGE, "The batch has more rows than the limit.";
        Operation(OperationError::TooManyRows { .. })
            => OperationError::TooManyRows { rows: 200_000, limit: 100_000 };
    UnsupportedMediaType, "unsupported_media_type", UNSUPPORTED_MEDIA_TYPE,
        "The Content-Type of the body is not application/json.";
        Request(RequestError::NotJson(_)) => RequestError::NotJson(None);
    UnsupportedCoding, "unsupported_coding", UNSUPPORTED_MEDIA_TYPE,
        "The Content-Encoding of the body is neither gzip nor br.";
        Request(RequestError::UnsupportedCoding(_)) => RequestError::UnsupportedCoding("zstd".to_owned());
    RangeNotSatisfiable, "range_not_satisfiable", RANGE_NOT_SATISFIABLE,
        "The range starts beyond the end of the content.";
        HttpError::RangeNotSatisfiable(_) => HttpError::RangeNotSatisfiable(162_300);
    InvalidRequest, "invalid_request", UNPROCESSABLE_ENTITY, "Fields or query parameters are invalid.";
        Operation(OperationError::Fields(_))
            => HttpError::field("/query/tool_length", "must be a number from 0 to 1e7 mm");
    BadRows, "bad_rows", UNPROCESSABLE_ENTITY, "The body is not of its format of rows, or ends too early.";
        Operation(OperationError::Rows(_))
            => OperationError::Rows("the Arrow stream cannot be read: it ends within a message".to_owned());
    ProgramFault, "program_fault", UNPROCESSABLE_ENTITY,
        "The program has faults; `errors` lists them with line, column and word.";
        Operation(OperationError::ProgramFaults(_)) => OperationError::ProgramFaults(example_of_faults());
    NoFit, "no_fit", UNPROCESSABLE_ENTITY, "No machine of the architecture was found that fits the measurements.";
        Operation(OperationError::NoFit(_)) => OperationError::NoFit(
            "the machine that fits best cannot stand at a measured pose, /rho/3: not in the working mode".to_owned());
    TooManyRequests, "too_many_requests", TOO_MANY_REQUESTS, "The client exceeded its request rate.";
        Limit(LimitError::TooManyRequests(_)) => LimitError::TooManyRequests(1);
    Internal, "internal", INTERNAL_SERVER_ERROR, "The service has a defect.";
        Operation(OperationError::Internal) => OperationError::Internal;
    Overloaded, "overloaded", SERVICE_UNAVAILABLE,
        "The server is at its limit of requests, connections or memory, in total or for this client.";
        Limit(LimitError::Overloaded) => LimitError::Overloaded;
    QueueFull, "queue_full", SERVICE_UNAVAILABLE, "The job queue is full.";
        Job(JobError::QueueFull(_)) => JobError::QueueFull(12);
    Stopping, "stopping", SERVICE_UNAVAILABLE, "The service is stopping.";
        Job(JobError::Stopping) => JobError::Stopping;
    JobsUnavailable, "jobs_unavailable", SERVICE_UNAVAILABLE,
        "The service cannot read or write its job records.";
        Job(JobError::RecordsUnavailable(_)) => JobError::RecordsUnavailable(UnavailableError(String::new()));
    DiskFailing, "disk_failing", SERVICE_UNAVAILABLE, "The service cannot store results.";
        Operation(OperationError::StoreUnavailable) => OperationError::StoreUnavailable;
    JobTooLong, "job_too_long", SERVICE_UNAVAILABLE, "The job exceeded its time limit.";
        Job(JobError::DeadlinePassed) => JobError::DeadlinePassed;
    TimedOut, "timed_out", SERVICE_UNAVAILABLE,
        "The request exceeded its time limit, or its body arrived too slowly.";
        HttpError::TimedOut | Request(RequestError::SlowBody(_)) => HttpError::TimedOut;
    NoRoom, "no_room", INSUFFICIENT_STORAGE, "The result is larger than the whole storage for results.";
        Job(JobError::ResultTooLarge) => JobError::ResultTooLarge;
    ProgramTooLarge, "program_too_large", INSUFFICIENT_STORAGE,
        "The program is larger than the whole storage for results.";
        Operation(OperationError::ProgramTooLarge) => OperationError::ProgramTooLarge;
}

fn example_of_faults() -> ProgramErrors {
    let text: &[u8] = b"UNITS/MM\nGOTO/0,0\n";
    match verne_program::read(Format::Apt, text, &ReadOptions::default()) {
        Err(ReadError::Program(refused)) => refused,
        _ => ProgramErrors { errors: Vec::new(), complete: true },
    }
}

#[cfg(test)]
mod tests {
    use super::Code;

    #[test]
    fn the_example_of_a_code_has_that_code() {
        for &code in Code::ALL {
            assert_eq!(Code::from(&code.example()), code);
        }
    }
}

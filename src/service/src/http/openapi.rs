//! The OpenAPI document: generated from the handlers, with examples whose answers the solver computes.

mod bare_references;
pub(crate) mod body_schemas;
pub(crate) mod example;
pub(crate) mod examples;
pub(crate) mod machine_schema;
mod one_media_type;
mod operations;
mod optional_fields;
pub(crate) mod problem_responses;
pub(crate) mod security;
pub(crate) mod table_examples;
mod version_3_0;
pub(crate) mod versions;

use serde_json::{Value, json};
use utoipa::OpenApi;

use crate::http::openapi::bare_references::bare_references;
use crate::http::openapi::examples::examples;
use crate::http::openapi::machine_schema::join_descriptions;
use crate::http::openapi::one_media_type::keep_one_media_type;
use crate::http::openapi::operations::drop_unused;
use crate::http::openapi::optional_fields::describe_defaults;
use crate::http::openapi::table_examples::write_table_examples;
use crate::http::problem::Problem;
use crate::wire::dexterity::{DexterityCells, DexteritySummary};
use crate::wire::error_map::{ErrorCells, ErrorMapSummary};
use crate::wire::family::FamilySummary;
use crate::wire::workspace_summary::WorkspaceSummary;

/// The parts of the document that belong to no route.
#[derive(OpenApi)]
#[openapi(
    info(
        title = "verne",
        description = "Kinematics and workspaces of the VERNE five-axis hybrid machine's architecture \
            (arXiv:0707.3507). Kinematics: every forward and inverse solution, with a label and with signed margins to \
            every limit. Workspaces: volumes, watertight meshes, slices and tests of points.\n\n\
            **Units**: lengths are in mm, angles in degrees; z points down in the base frame. Field names are the \
            symbols of the paper.\n\n\
            **Machines**: a request names a machine or contains a complete machine object. The built-in machine \
            `verne` has invented, round dimensions that reproduce the solution counts printed in the paper. They are \
            not Fatronik's dimensions, which the paper does not give. Every answer has the hash of the machine (BLAKE3 \
            of geometry, table and limits), so clients can compare answers.\n\n\
            **No solution is not an error**: the status is 200, `solutions` is empty, and the answer has `reason` and \
            the `constraint` that prevents a solution.\n\n\
            **Order**: the working solution comes first, then alpha and rho determine the order. With `near`, the \
            distance from it determines the order: the root of the sum of squares of lengths in mm and of angles as \
            arcs of radius R1.\n\n\
            **Keys**: if the service was started with `--keys`, every request needs an API key, except for the probes \
            and this document. Clients send it as `Authorization: Bearer KEY`. The role of the key determines what it \
            may do. `read`: requests that need no job, batches, machines, stored results, the key's own jobs, \
            metrics. `compute`: in addition, start jobs and cancel its own jobs. `admin`: in addition, read and cancel \
            the jobs of all clients. Any key may read any result by its id: the id is a hash of the request, so a \
            client that knows the id knows the request.\n\n\
            **Queries**: the service rejects unknown and repeated parameters. A list is `rho=1,2,3`, \
            `rho=1&rho=2&rho=3` or `rho=[1,2,3]`.\n\n\
            **Bodies** may have `Content-Encoding: gzip` or `br`; limits apply to the decoded bytes. The service \
            rejects unknown and repeated fields.\n\n\
            **Errors** are `application/problem+json` (RFC 9457) with a stable `code`. `errors` lists the invalid \
            fields, each with a JSON Pointer into the body, or `/query/<name>`; for `program_fault` it lists the \
            faults of the program, each with line, column and word.\n\n\
            **Stability**: within a series of versions, such as 0.1, nothing in this document is removed, and no \
            meaning changes. Versions may add paths, optional parameters, fields, names and codes: a client must \
            accept those that it does not know. Ids change with the version and the target of the service's binary. \
            Parts that a later series will lose are marked `deprecated`. `docs/stability.md` has the whole promise."
    ),
    servers((url = "/", description = "This service.")),
    external_docs(url = "/guide/", description = "The guide: quick starts, limits, workspaces and tool paths."),
    tags(
        (name = "kinematics", description = "Forward and inverse kinematics."),
        (name = "workspace", description = "Positions that the machine can reach."),
        (name = "programs", description = "Files of tool paths."),
        (name = "toolpath", description = "Joint motion of programs."),
        (name = "jobs", description = "Computations that take longer than a request."),
        (name = "machines", description = "Published machines."),
        (name = "service", description = "State and description of the service.")
    ),
    components(schemas(
        Problem, WorkspaceSummary, FamilySummary, DexteritySummary, DexterityCells, ErrorMapSummary, ErrorCells
    ))
)]
pub(crate) struct Document;

/// The document as JSON, as generators of clients read it, with an example of each request and its answer.
pub(crate) fn complete(api: &utoipa::openapi::OpenApi) -> Value {
    let mut document = json!(api);
    keep_one_media_type(&mut document);
    for example in examples() {
        example.write_into(&mut document);
    }
    write_table_examples(&mut document);
    join_descriptions(&mut document);
    bare_references(&mut document);
    describe_defaults(&mut document);
    // No operation lists some codes, such as that of an unknown path.
    drop_unused(&mut document, "examples");
    document
}

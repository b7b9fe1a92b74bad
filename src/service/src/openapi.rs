//! The OpenAPI document: what the handlers say, completed with examples that the solver answers.

pub(crate) mod access;
pub(crate) mod binary;
mod examples;
mod inlined;
pub(crate) mod machine_schema;
pub(crate) mod problems;

use serde_json::{Value, json};
use utoipa::OpenApi;

use crate::problem::Problem;
use crate::wire::dexterity::DexteritySummary;
use crate::wire::family::FamilySummary;
use crate::wire::workspace_summary::WorkspaceSummary;

/// What the document says beside its routes.
#[derive(OpenApi)]
#[openapi(
    info(
        title = "verne",
        description = "Kinematics and workspaces of the VERNE five-axis hybrid machine's architecture \
            (arXiv:0707.3507): every forward and inverse solution, labelled, with signed margins to every limit; \
            workspaces as volumes, watertight meshes, slices and membership.\n\n\
            **Units**: lengths in mm, angles in degrees; z points down in the base frame. Field names are the paper's.\n\n\
            **Machines**: named, or whole in the request. The built-in machine `verne` has invented, round dimensions \
            that reproduce the counts printed in the paper; they are not Fatronik's, which the paper does not give. \
            Every answer carries the machine's hash: BLAKE3 of geometry, table and limits, so that two answers can be \
            compared.\n\n\
            **No solution is not an error**: 200 with empty `solutions`, `reason` and the `constraint` that prevents \
            one.\n\n\
            **Order**: the working solution first, then by alpha, then by rho; with `near`, by distance from it: the \
            root of the sum of squares of lengths in mm and of angles as arcs of radius R1.\n\n\
            **Keys**: where the service was started with `--keys`, all but the probes and this document takes one, sent as \
            `Authorization: Bearer KEY`. Its role says what it is good for. `read`: questions that are answered at \
            once, batches of them, machines, kept results, its own jobs, metrics. `compute`: also what begins jobs, \
            and the end of its own. `admin`: also the jobs of all. Results go by their ids: who knows the id knows the \
            question, and any key may read them.\n\n\
            **Queries**: unknown and repeated parameters are refused. A list is `rho=1,2,3`, `rho=1&rho=2&rho=3` or \
            `rho=[1,2,3]`.\n\n\
            **Bodies** may be sent with `Content-Encoding: gzip` or `br`; limits count decoded bytes.\n\n\
            **Failures** are `application/problem+json` (RFC 9457) with a stable `code`. Bad fields are listed in `errors` with \
            a JSON Pointer into the body, or `/query/<name>`. Unknown and repeated fields are refused."
    ),
    servers((url = "/", description = "This service.")),
    tags(
        (name = "kinematics", description = "From joints to poses and back."),
        (name = "workspace", description = "Where the machine can go."),
        (name = "jobs", description = "What takes longer than a request."),
        (name = "machines", description = "Machines that requests may name."),
        (name = "service", description = "The service itself.")
    ),
    components(schemas(Problem, WorkspaceSummary, FamilySummary, DexteritySummary))
)]
pub(crate) struct Document;

/// The document as JSON, with an example of each request and the answer it gets.
pub(crate) fn complete(api: &utoipa::openapi::OpenApi) -> Value {
    let mut document = json!(api);
    for example in examples::examples() {
        example.write_into(&mut document);
    }
    inlined::join_descriptions(&mut document);
    document
}

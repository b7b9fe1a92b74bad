//! `/machines`.

use axum::Json;
use axum::extract::State;
use serde_json::Value;

use crate::http::error::HttpError;
use crate::http::extractors::PathParameter;
use crate::http::machine_documents::{machine_answer, machine_list};
use crate::http::openapi::machine_schema::machine_schema;
use crate::http::openapi::problem_responses::{CommonProblems, MachineProblems};
use crate::http::state::SharedState;
use crate::wire::machine_list::{MachineAnswer, MachineList};

/// Published machines
///
/// Lists the machine names that requests may use, with the source of the numbers of each machine.
#[utoipa::path(
    get, path = "/machines", operation_id = "list_machines", tag = "machines",
    responses((status = 200, description = "The machines, sorted by name.", body = MachineList), CommonProblems)
)]
pub(crate) async fn get_machines(State(state): State<SharedState>) -> Json<MachineList> {
    Json(machine_list(&state.machines))
}

/// One machine
///
/// Returns all numbers of a published machine. Requests and `verne --machine FILE` accept `definition`.
#[utoipa::path(
    get, path = "/machines/{name}", operation_id = "get_machine", tag = "machines",
    params(("name" = String, Path, description = "Name of the machine.")),
    responses((status = 200, description = "The machine.", body = MachineAnswer), MachineProblems)
)]
pub(crate) async fn get_machine(
    State(state): State<SharedState>,
    PathParameter(name): PathParameter,
) -> Result<Json<MachineAnswer>, HttpError> {
    Ok(Json(machine_answer(&state.machines, &name)?))
}

/// JSON Schema of the machine object
///
/// Editors can use the schema, and clients can validate a machine before they send it. Only the service can check
/// whether the numbers define a valid machine.
#[utoipa::path(
    get, path = "/machines/schema", operation_id = "get_machine_schema", tag = "machines",
    responses((status = 200, description = "The schema.", body = Object), CommonProblems)
)]
pub(crate) async fn get_machine_schema() -> Json<Value> {
    Json(machine_schema())
}

//! `/machines`.

use axum::Json;
use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use serde_json::Value;

use crate::http::error::{HttpError, LookupError};
use crate::http::openapi::machine_schema::machine_schema;
use crate::http::openapi::problems::{MachineProblems, ServiceProblems};
use crate::http::state::Shared;
use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::wire::machine::MachineObject;
use crate::wire::machine_list::{MachineAnswer, MachineEntry, MachineList};

/// The published machines with their descriptions.
pub(crate) fn list(machines: &MachineRegistry) -> MachineList {
    let entry = |machine: &IdentifiedMachine| MachineEntry {
        id: machine.id.clone(),
        description: machine.data().description.clone(),
    };
    MachineList { machines: machines.iter().map(entry).collect() }
}

/// One published machine with its numbers.
pub(crate) fn show(machines: &MachineRegistry, name: &str) -> Result<MachineAnswer, LookupError> {
    let machine = machines.get(name).ok_or_else(|| LookupError::Machine(name.to_owned()))?;
    let definition = MachineObject::from(machine.data());
    Ok(MachineAnswer { machine: machine.id.clone(), definition })
}

/// Published machines
///
/// Lists the machine names that requests may use, with the source of the numbers of each machine.
#[utoipa::path(
    get, path = "/machines", operation_id = "machines", tag = "machines",
    responses((status = 200, description = "The machines, sorted by name.", body = MachineList), ServiceProblems)
)]
pub(crate) async fn get_machines(State(state): State<Shared>) -> Json<MachineList> {
    Json(list(&state.machines))
}

/// One machine
///
/// Returns all numbers of a published machine. Requests and `verne --machine FILE` accept `definition`.
#[utoipa::path(
    get, path = "/machines/{name}", operation_id = "machine", tag = "machines",
    params(("name" = String, Path, description = "Name of the machine.")),
    responses((status = 200, description = "The machine.", body = MachineAnswer), MachineProblems)
)]
pub(crate) async fn get_machine(
    State(state): State<Shared>,
    name: Result<Path<String>, PathRejection>,
) -> Result<Json<MachineAnswer>, HttpError> {
    let Path(name) = name.map_err(|_| HttpError::UnknownPath)?;
    Ok(Json(show(&state.machines, &name)?))
}

/// JSON Schema of the machine object
///
/// Editors can use the schema, and clients can validate a machine before they send it. Only the service can check
/// whether the numbers define a valid machine.
#[utoipa::path(
    get, path = "/machines/schema", operation_id = "machine_schema", tag = "machines",
    responses((status = 200, description = "The schema.", body = Object), ServiceProblems)
)]
pub(crate) async fn get_machine_schema() -> Json<Value> {
    Json(machine_schema())
}

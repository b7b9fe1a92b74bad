//! The one list of routes: the router and the OpenAPI document are both made from it.

use axum::Router;
use axum::routing::{any, get};
use serde_json::Value;
use utoipa::OpenApi;
use utoipa_axum::router::{OpenApiRouter, UtoipaMethodRouter};
use utoipa_axum::routes;

use crate::http::gate::{Access, Access::For, Access::Open, Access::Probe, Gate};
use crate::http::handlers::{
    batch, contains, dexterity, jobs, kinematics, machines, service, workspace, workspace_results,
};
use crate::http::openapi::{self, Document, access, problems};
use crate::http::query_parameters::only_known;
use crate::http::state::Shared;
use crate::limits::admission::{Admission, Load::Question, Load::Watch, Load::Work};
use crate::wire::role::{Role::Compute, Role::Read};

/// The OpenAPI document, generated from the handlers.
pub fn document() -> Value {
    openapi::complete(routes(&Gate::for_all(Admission::new(1, 1))).get_openapi())
}

/// Every route with who may use it, and what it is to the service.
fn list() -> [(Access, UtoipaMethodRouter<Shared>); 22] {
    [
        (For(Read, Question), routes!(kinematics::get_fk, kinematics::post_fk)),
        (For(Read, Question), routes!(kinematics::get_ik, kinematics::post_ik)),
        (For(Read, Work), routes!(batch::fk_batch)),
        (For(Read, Work), routes!(batch::ik_batch)),
        (For(Compute, Work), routes!(workspace::get_workspace, workspace::post_workspace)),
        (For(Read, Work), routes!(contains::post_contains)),
        (For(Compute, Work), routes!(dexterity::post_dexterity)),
        (For(Read, Work), routes!(workspace_results::get_summary)),
        (For(Read, Work), routes!(workspace_results::get_mesh)),
        (For(Read, Work), routes!(workspace_results::get_slice)),
        (For(Read, Work), routes!(dexterity::get_cells)),
        (For(Read, Work), routes!(jobs::get_jobs)),
        (For(Read, Work), routes!(jobs::get_job)),
        (For(Compute, Work), routes!(jobs::delete_job)),
        (For(Read, Work), routes!(jobs::get_events)),
        (For(Read, Question), routes!(machines::get_machines)),
        (For(Read, Question), routes!(machines::get_machine_schema)),
        (For(Read, Question), routes!(machines::get_machine)),
        (For(Read, Watch), routes!(service::get_metrics)),
        (Open, routes!(service::get_openapi)),
        (Probe, routes!(service::get_livez)),
        (Probe, routes!(service::get_readyz)),
    ]
}

/// What is answered when all connections are taken: how the service fares.
pub(crate) fn probes(gate: &Gate) -> Router<Shared> {
    Router::new()
        .route("/livez", get(service::get_livez))
        .route("/readyz", get(service::get_readyz))
        .route("/metrics", gate.before(get(service::get_metrics), For(Read, Watch)))
        .fallback(service::no_place_here)
}

/// Every route behind the gate, with its documentation.
pub(crate) fn routes(gate: &Gate) -> OpenApiRouter<Shared> {
    let document = problems::with_codes(access::with_scheme(Document::openapi()));
    // Unknown paths count as requests, too.
    let nothing = gate.before(any(service::nothing_here), Open);
    let router = OpenApiRouter::with_openapi(document).fallback(nothing);
    list().into_iter().fold(router, |router, (access, (schemas, paths, route))| {
        let route = gate.before(only_known(route, &paths), access);
        router.routes((schemas, access::documented(paths, access), route))
    })
}

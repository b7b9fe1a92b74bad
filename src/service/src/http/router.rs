//! The list of routes. The router and the OpenAPI document are made from it.
//!
//! To add a route:
//!
//! 1. Write its handler with `#[utoipa::path]` in [`handlers`](crate::http::handlers).
//! 2. Add it to [`list`] with its access.
//! 3. Add an example to [`openapi::examples`].
//! 4. Write the document anew: `cargo run -- openapi > openapi/openapi.json`.

use axum::Router;
use axum::routing::{any, get};
use serde_json::Value;
use utoipa::OpenApi;
use utoipa::openapi::Paths;
use utoipa_axum::router::{OpenApiRouter, UtoipaMethodRouter};
use utoipa_axum::routes;

use crate::http::access_control::{Access, Access::Key, Access::Open, Access::Probe, AccessControl};
use crate::http::format_paths;
use crate::http::handlers::{
    atlas, batch, calibration, dexterity, error_budget, jobs, joint_program, kinematics, machines, origins,
    placement, programs, results, service, toolpath, toolpath_rows, window, workspace,
};
use crate::http::openapi::{self, Document, problem_responses, security};
use crate::http::state::SharedState;
use crate::http::unknown_parameters::reject_unknown;
use crate::limits::admission::{
    Admission, RequestClass::Fast, RequestClass::Monitoring, RequestClass::Other,
};
use crate::wire::role::{Role::Compute, Role::Read};

/// The OpenAPI document, generated from the handlers.
pub fn document() -> Value {
    openapi::complete(routes(&AccessControl::admitting_all(Admission::new(1, 1))).get_openapi())
}

/// Each route with its access.
fn list() -> [(Access, UtoipaMethodRouter<SharedState>); 40] {
    [
        (Key(Read, Fast), routes!(kinematics::get_fk, kinematics::post_fk)),
        (Key(Read, Fast), routes!(kinematics::get_ik, kinematics::post_ik)),
        (Key(Read, Other), routes!(atlas::get_atlas, atlas::post_atlas)),
        (Key(Read, Other), routes!(batch::fk_batch)),
        (Key(Read, Other), routes!(batch::ik_batch)),
        (Key(Read, Other), routes!(error_budget::post_error_budget)),
        (Key(Compute, Other), routes!(workspace::get_workspace, workspace::post_workspace)),
        (Key(Read, Other), routes!(batch::workspace_contains)),
        (Key(Compute, Other), routes!(dexterity::post_dexterity)),
        (Key(Compute, Other), routes!(error_budget::post_error_map)),
        (Key(Read, Other), routes!(results::get_summary)),
        (Key(Read, Other), routes!(results::get_mesh)),
        (Key(Read, Other), routes!(results::get_slice)),
        (Key(Read, Other), routes!(dexterity::get_cells)),
        (Key(Compute, Other), routes!(programs::post_program)),
        (Key(Read, Other), routes!(programs::get_program)),
        (Key(Read, Other), routes!(programs::get_source)),
        (Key(Compute, Other), routes!(toolpath::post_toolpath)),
        (Key(Compute, Other), routes!(toolpath::post_toolpath_file)),
        (Key(Compute, Other), routes!(placement::post_placement)),
        (Key(Compute, Other), routes!(origins::post_origins)),
        (Key(Read, Other), routes!(origins::get_origins_mesh)),
        (Key(Read, Other), routes!(origins::get_origins_slice)),
        (Key(Compute, Other), routes!(window::post_window)),
        (Key(Read, Other), routes!(toolpath::get_report)),
        (Key(Read, Other), routes!(toolpath_rows::get_rows)),
        (Key(Read, Other), routes!(joint_program::get_joint_program)),
        (Key(Read, Other), routes!(joint_program::get_path)),
        (Key(Read, Other), routes!(jobs::get_jobs)),
        (Key(Read, Other), routes!(jobs::get_job)),
        (Key(Compute, Other), routes!(jobs::delete_job)),
        (Key(Read, Other), routes!(jobs::get_events)),
        (Key(Read, Fast), routes!(machines::get_machines)),
        (Key(Read, Fast), routes!(machines::get_machine_schema)),
        (Key(Read, Fast), routes!(machines::get_machine)),
        (Key(Read, Other), routes!(calibration::post_calibration)),
        (Key(Read, Monitoring), routes!(service::get_metrics)),
        (Open, routes!(service::get_openapi)),
        (Probe, routes!(service::get_livez)),
        (Probe, routes!(service::get_readyz)),
    ]
}

/// The routes of connections beyond the limit: probes and metrics. All other requests are rejected.
pub(crate) fn probes(control: &AccessControl) -> Router<SharedState> {
    Router::new()
        .route("/livez", get(service::get_livez))
        .route("/readyz", get(service::get_readyz))
        .route("/metrics", control.guard(get(service::get_metrics), Key(Read, Monitoring)))
        .fallback(service::overloaded)
}

/// All routes with their access control and documentation.
pub(crate) fn routes(control: &AccessControl) -> OpenApiRouter<SharedState> {
    let document = problem_responses::with_codes(security::with_bearer_scheme(Document::openapi()));
    // Requests to unknown paths are limited, too.
    let fallback = control.guard(any(service::unknown_path), Open);
    let router = OpenApiRouter::with_openapi(document).fallback(fallback);
    list().into_iter().fold(router, |router, (access, (schemas, paths, route))| {
        let guarded = |paths: &Paths, route| control.guard(reject_unknown(route, paths), access);
        let formats = format_paths::of(&paths, &route);
        let (router, listed) = if format_paths::is_listed(&paths) {
            (router, Some((paths, route)))
        } else {
            let of_path =
                |router: OpenApiRouter<_>, path: &String| router.route(path, guarded(&paths, route.clone()));
            (paths.paths.keys().fold(router, of_path), None)
        };
        listed.into_iter().chain(formats).fold(router, |router, (paths, route)| {
            let route = guarded(&paths, route);
            router.routes((schemas.clone(), security::with_access_problems(paths, access), route))
        })
    })
}

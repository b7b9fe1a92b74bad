//! The one list of routes: the router and the OpenAPI document are both made from it.

use utoipa::OpenApi;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::handlers::{
    batch, contains, dexterity, jobs, kinematics, machines, service, workspace, workspace_results,
};
use crate::openapi::Document;
use crate::state::Shared;

/// Every route with its documentation.
pub(crate) fn routes() -> OpenApiRouter<Shared> {
    OpenApiRouter::with_openapi(Document::openapi())
        .routes(routes!(kinematics::get_fk, kinematics::post_fk))
        .routes(routes!(kinematics::get_ik, kinematics::post_ik))
        .routes(routes!(batch::fk_batch))
        .routes(routes!(batch::ik_batch))
        .routes(routes!(workspace::get_workspace, workspace::post_workspace))
        .routes(routes!(contains::post_contains))
        .routes(routes!(dexterity::post_dexterity))
        .routes(routes!(workspace_results::get_summary))
        .routes(routes!(workspace_results::get_mesh))
        .routes(routes!(workspace_results::get_slice))
        .routes(routes!(dexterity::get_cells))
        .routes(routes!(jobs::get_jobs))
        .routes(routes!(jobs::get_job, jobs::delete_job))
        .routes(routes!(jobs::get_events))
        .routes(routes!(machines::get_machines))
        .routes(routes!(machines::get_machine_schema))
        .routes(routes!(machines::get_machine))
        .routes(routes!(service::get_openapi))
        .routes(routes!(service::get_livez))
        .routes(routes!(service::get_readyz))
        .routes(routes!(service::get_metrics))
        .fallback(service::nothing_here)
}

//! What a job leaves in the store.

use serde_json::{from_value, json};
use tokio::runtime::Handle;
use verne_jobs::{RunControl, Work};
use verne_store::Store;

use super::JobExecutor;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::question::Question;
use crate::operations::question_text::JobParameters;
use crate::operations::results::{MESH, Results};
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::telemetry::metrics::computations::ComputationMetrics;
use crate::wire::format::MeshFormat;

struct Unwatched;

impl RunControl for Unwatched {
    fn progress(&self, _: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

#[tokio::test]
async fn a_job_stores_the_mesh_in_the_format_that_the_client_waits_for() {
    let results = Results::new(Store::in_memory(1 << 24));
    let executor = JobExecutor::new(results.clone(), ComputationMetrics::default(), Handle::current());
    let request = from_value(json!({"tolerance": 50})).unwrap();
    let question = WorkspaceQuestion::new(&request, &MachineRegistry::default()).unwrap();
    let id = question.id;
    let parameters = JobParameters { max_triangles: 100_000, cost: 1.0, mesh_format: Some(MeshFormat::Stl) };
    let job = Question::Workspace(question).submission(parameters, String::new(), None).unwrap();
    let run = tokio::task::spawn_blocking(move || executor.run(&job.id, &job.payload, &Unwatched));
    run.await.unwrap().unwrap();
    for (blob, stored) in [(MESH, true), ("mesh.stl", true), ("mesh.glb", false)] {
        assert_eq!(results.blob(id, blob).await.is_some(), stored, "{blob}");
    }
    assert!(results.record(id).await.is_some());
}

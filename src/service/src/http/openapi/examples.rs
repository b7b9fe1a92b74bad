//! An example of each operation: the request here, the answer from the solver.

use std::fmt::Display;

use serde::Serialize;
use serde_json::{Map, Value, json};
use verne_solver::workspace::Unobserved;

use crate::http::handlers::machines;
use crate::http::openapi::machine_schema::machine_schema;
use crate::operations::contains::answer_contains;
use crate::operations::forward::answer_fk;
use crate::operations::forward_batch::answer_fk_batch;
use crate::operations::inverse::answer_ik;
use crate::operations::inverse_batch::answer_ik_batch;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::slice::answer_slice;
use crate::operations::workspace::compute_workspace;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::alphas::Alphas;
use crate::wire::error::OperationError;
use crate::wire::format::SliceFormat;
use crate::wire::health::{Health, HealthStatus};
use crate::wire::parse::parse_body;
use crate::wire::query::{FkQuery, IkQuery};
use crate::wire::query_string::parse_query;

/// Rows that an example may have.
const ROWS: usize = 100;

/// How an example asks.
enum Asked {
    /// Values of path and query parameters.
    Parameters(Value),
    /// A body.
    Body(Value),
}

/// A question that the tests send, and the answer it gets.
pub(crate) struct Example {
    method: &'static str,
    path: &'static str,
    asked: Asked,
    /// Nothing where it is no JSON, or long.
    answer: Option<Value>,
}

impl Example {
    /// Writes question and answer into their operation.
    pub(crate) fn write_into(self, document: &mut Value) {
        let Some(operation) = document["paths"][self.path].get_mut(self.method) else { return };
        match self.asked {
            Asked::Body(body) => operation["requestBody"]["content"]["application/json"]["example"] = body,
            Asked::Parameters(values) => {
                let parameters = operation.get_mut("parameters").and_then(Value::as_array_mut);
                for parameter in parameters.into_iter().flatten() {
                    if let Some(value) = parameter["name"].as_str().and_then(|name| values.get(name)) {
                        parameter["example"] = value.clone();
                    }
                }
            }
        }
        if let Some(answer) = self.answer {
            operation["responses"]["200"]["content"]["application/json"]["example"] = answer;
        }
    }
}

/// An example of each operation but the document's own.
pub(crate) fn examples() -> Vec<Example> {
    let machines = MachineRegistry::default();
    let mut examples = of_the_service(&machines);
    examples.extend(of_queries(&machines));
    examples.extend(of_bodies(&machines));
    examples.extend(of_workspaces(&machines));
    examples
}

fn of_the_service(registry: &MachineRegistry) -> Vec<Example> {
    let get = |path, asked, answer| Example {
        method: "get",
        path,
        asked: Asked::Parameters(asked),
        answer: Some(answer),
    };
    let health = json!(Health { status: HealthStatus::Ok, failing: Vec::new() });
    vec![
        Example { method: "get", path: "/metrics", asked: Asked::Parameters(json!({})), answer: None },
        get("/livez", json!({}), health.clone()),
        get("/readyz", json!({}), health),
        get("/machines", json!({}), json!(machines::list(registry))),
        get("/machines/schema", json!({}), machine_schema()),
        get("/machines/{name}", json!({"name": "verne"}), answered(machines::show(registry, "verne"))),
    ]
}

fn of_queries(registry: &MachineRegistry) -> Vec<Example> {
    let get = |path, asked, answer| Example {
        method: "get",
        path,
        asked: Asked::Parameters(asked),
        answer: Some(answer),
    };
    let fk = parse_query::<FkQuery>("rho=674,685,250").and_then(FkQuery::into_request);
    let ik = parse_query::<IkQuery>("frame=platform&x=-240&y=-86&z=1000").and_then(IkQuery::into_request);
    vec![
        get(
            "/fk",
            json!({"rho": [674, 685, 250]}),
            answered(fk.and_then(|request| answer_fk(&request, registry))),
        ),
        get(
            "/ik",
            json!({"frame": "platform", "x": -240, "y": -86, "z": 1000}),
            answered(ik.and_then(|request| answer_ik(&request, registry))),
        ),
    ]
}

fn of_bodies(registry: &MachineRegistry) -> Vec<Example> {
    vec![
        post(
            "/fk",
            json!({"machine": "verne", "joints": {"rho": [674, 685, 250], "theta1": 0, "theta2": 0},
                   "tool_length": 50, "table_clearance": 0, "solutions": "working"}),
            |body| {
                parse_body(body).and_then(|request| answer_fk(&request, registry)).map(|answer| json!(answer))
            },
        ),
        post(
            "/ik",
            json!({"machine": "verne", "frame": "part",
                   "pose": {"x": 100, "y": 50, "z": 150, "axis": [0.0, -0.5, 0.866_025_403_784_438_6]},
                   "tool_length": 50, "table_clearance": 0, "solutions": "feasible"}),
            |body| {
                parse_body(body).and_then(|request| answer_ik(&request, registry)).map(|answer| json!(answer))
            },
        ),
        post(
            "/fk/batch",
            json!({"joints": [[674, 685, 250], [400, 400, 400, 10, 90], null, [0, 0, 5000]], "tool_length": 50}),
            |body| answer_fk_batch(body, registry, ROWS).and_then(|answer| parse_body(&answer)),
        ),
        post(
            "/ik/batch",
            json!({"frame": "part", "tool_length": 50,
                   "poses": [[100, 50, 150, 0, 0], [100, 50, 150, 30, 90], [0, 0, 900, 0, 0], [1, 2], [5000, 0, 0, 0, 0]]}),
            |body| answer_ik_batch(body, registry, ROWS).and_then(|answer| parse_body(&answer)),
        ),
    ]
}

fn of_workspaces(machines: &MachineRegistry) -> Vec<Example> {
    let asked = json!({"machine": "verne", "kind": "part", "tool_length": 50, "table_clearance": 0, "phi1": 30, "tolerance": 10});
    let question = parse_body(asked.to_string().as_bytes())
        .and_then(|request| WorkspaceQuestion::new(&request, machines));
    let computed = question.clone().and_then(|question| {
        compute_workspace(&question, usize::MAX, &Unobserved).map(|computed| (question, computed))
    });
    let summary = computed.as_ref().map_err(Clone::clone).and_then(|(_, found)| parse_body(&found.summary));
    let slice = computed.as_ref().map_err(Clone::clone).and_then(|(question, found)| {
        let alphas = Alphas::List(vec![0.0]);
        answer_slice(question, found.inclination, 300.0, &alphas, SliceFormat::Json, &Unobserved)
            .and_then(|text| parse_body(&text))
    });
    let id = question.map(|question| question.id.to_string()).unwrap_or_default();
    let dexterity = json!({"tool_length": 50, "phi1": {"from": -20, "to": 20}, "cell": 200});
    let get = |path, asked, answer| Example { method: "get", path, asked: Asked::Parameters(asked), answer };
    let summary: Value = answered(summary as Result<Value, OperationError>);
    let slice: Value = answered(slice as Result<Value, OperationError>);
    vec![
        get("/workspace", asked.clone(), Some(summary.clone())),
        post("/workspace", asked, |_| Ok(summary.clone())),
        // Its answer takes seconds.
        Example { method: "post", path: "/workspace/dexterity", asked: Asked::Body(dexterity), answer: None },
        get("/jobs", json!({"state": "failed", "limit": 10}), Some(json!({"jobs": [], "next": null}))),
        get("/jobs/{id}", json!({"id": id}), None),
        get("/jobs/{id}/events", json!({"id": id}), None),
        Example {
            method: "delete",
            path: "/jobs/{id}",
            asked: Asked::Parameters(json!({"id": id})),
            answer: None,
        },
        get("/workspace/{id}", json!({"id": id}), Some(summary.clone())),
        get("/workspace/{id}/mesh", json!({"id": id, "format": "glb"}), None),
        get("/workspace/{id}/slice", json!({"id": id, "z": 300, "alpha": "0"}), Some(slice)),
        post(
            "/workspace/contains",
            json!({"kind": "part", "tool_length": 50, "points": [[100, 50, 150], [0, 0, 900], null, [5000, 0, 0]]}),
            |body| answer_contains(body, machines, ROWS, &Unobserved).and_then(|answer| parse_body(&answer)),
        ),
    ]
}

fn post(path: &'static str, body: Value, answer: impl Fn(&[u8]) -> Result<Value, OperationError>) -> Example {
    let answer = answered(answer(body.to_string().as_bytes()));
    Example { method: "post", path, asked: Asked::Body(body), answer: Some(answer) }
}

/// The answer as JSON; a question that fails shows its failure, which the tests take for stale.
fn answered(answer: Result<impl Serialize, impl Display>) -> Value {
    match answer {
        Ok(answer) => json!(answer),
        Err(error) => Value::Object(Map::from_iter([("error".to_owned(), error.to_string().into())])),
    }
}

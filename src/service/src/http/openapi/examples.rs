//! An example of each operation: a request, and the answer that the solver computes.

mod toolpaths;

use serde_json::{Value, json};
use verne_program::Format;
use verne_solver::workspace::Unobserved;

use crate::http::machine_documents::{machine_answer, machine_list};
use crate::http::openapi::example::{Example, PROGRAM, get, json_of, post, value_of};
use crate::http::openapi::examples::toolpaths::of_toolpaths;
use crate::http::openapi::machine_schema::machine_schema;
use crate::operations::atlas::answer_atlas;
use crate::operations::calibration::answer_calibration;
use crate::operations::calibration_request::read_calibration;
use crate::operations::contains::answer_contains;
use crate::operations::error_budget::answer_error_budget;
use crate::operations::forward::answer_fk;
use crate::operations::forward_batch::answer_fk_batch;
use crate::operations::inverse::answer_ik;
use crate::operations::inverse_batch::answer_ik_batch;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::programs::receiver::ProgramReceiver;
use crate::operations::slice::answer_slice;
use crate::operations::workspace::compute_workspace;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::alphas::Alphas;
use crate::wire::error::OperationError;
use crate::wire::format::SliceFormat;
use crate::wire::health::{Health, HealthStatus};
use crate::wire::parse::parse_body;
use crate::wire::program_query::ProgramQuery;
use crate::wire::query::{FkQuery, IkQuery};
use crate::wire::query_string::parse_query;

/// Most rows of an example.
const ROWS: usize = 100;

/// The examples of all operations, except the one that returns this document.
pub(crate) fn examples() -> Vec<Example> {
    let machines = MachineRegistry::default();
    let mut examples = of_service(&machines);
    examples.extend(of_kinematics(&machines));
    examples.push(of_calibration(&machines));
    examples.extend(of_workspaces(&machines));
    examples.extend(of_programs());
    examples.extend(of_toolpaths(&machines));
    examples
}

fn of_service(machines: &MachineRegistry) -> Vec<Example> {
    let health = json!(Health { status: HealthStatus::Ok, failing: Vec::new() });
    vec![
        get("/metrics", json!({}), None),
        get("/livez", json!({}), Some(health.clone())),
        get("/readyz", json!({}), Some(health)),
        get("/machines", json!({}), Some(json!(machine_list(machines)))),
        get("/machines/schema", json!({}), Some(machine_schema())),
        get("/machines/{name}", json!({"name": "verne"}), Some(json_of(machine_answer(machines, "verne")))),
    ]
}

fn of_kinematics(machines: &MachineRegistry) -> Vec<Example> {
    let fk = parse_query::<FkQuery>("rho=674,685,250").and_then(FkQuery::into_request);
    let ik = parse_query::<IkQuery>("frame=platform&x=-240&y=-86&z=1000&certified=true")
        .and_then(IkQuery::into_request);
    let atlas = json!({"machine": "verne", "space": "joints", "u_min": -200, "u_max": 200, "v_min": -200, "v_max": 200,
                       "tolerance": 5});
    vec![
        get(
            "/fk",
            json!({"rho": [674, 685, 250]}),
            Some(json_of(fk.and_then(|request| answer_fk(&request, machines)))),
        ),
        get(
            "/ik",
            json!({"frame": "platform", "x": -240, "y": -86, "z": 1000, "certified": true}),
            Some(json_of(ik.and_then(|request| answer_ik(&request, machines)))),
        ),
        post(
            "/fk",
            json!({"machine": "verne", "joints": {"rho": [674, 685, 250], "theta1": 0, "theta2": 0},
                   "tool_length": 50, "table_clearance": 0, "solutions": "working", "certified": true}),
            |body| parse_body(body).and_then(|request| answer_fk(&request, machines)),
        ),
        post(
            "/ik",
            json!({"machine": "verne", "frame": "part",
                   "pose": {"x": 100, "y": 50, "z": 150, "axis": [0.0, -0.5, 0.866_025_403_784_438_6]},
                   "tool_length": 50, "table_clearance": 0, "solutions": "feasible"}),
            |body| parse_body(body).and_then(|request| answer_ik(&request, machines)),
        ),
        // The answers are long.
        get("/atlas", json!({"space": "joints", "tolerance": 2}), None),
        get("/atlas.svg", json!({"space": "platform"}), None),
        get("/atlas.dxf", json!({"space": "platform"}), None),
        post("/atlas", atlas.clone(), |body| {
            let body = parse_body(body)?;
            value_of(answer_atlas(&body, machines, SliceFormat::Json, &Unobserved))
        }),
        Example { method: "post", path: "/atlas.svg", request: atlas.clone(), file: None, answer: None },
        Example { method: "post", path: "/atlas.dxf", request: atlas, file: None, answer: None },
        post(
            "/fk/batch",
            json!({"joints": [[674, 685, 250], [400, 400, 400, 10, 90], null, [0, 0, 5000]], "tool_length": 50,
                   "orientation": "vector"}),
            |body| value_of(answer_fk_batch(body, machines, ROWS)),
        ),
        post(
            "/ik/batch",
            json!({"frame": "part", "tool_length": 50, "continuous": true,
                   "start": {"rho": [400, 450, 450], "theta1": 0, "theta2": 0},
                   "poses": [[100, 50, 150, 0, 0], [100, 50, 150, 30, 90], [100, 50, 150, 0.3, -0.4, 1.2],
                             [0, 0, 900, 0, 0], [1, 2], [5000, 0, 0, 0, 0]]}),
            |body| value_of(answer_ik_batch(body, machines, ROWS)),
        ),
        post(
            "/error-budget",
            json!({"frame": "part", "tool_length": 50,
                   "parameter_tolerances": {"L1": 0.02, "L2": 0.02, "L3": 0.02, "o1": 0.005, "o2": 0.005, "o3": 0.005,
                                            "tilt_zero": 0.001},
                   "poses": [[100, 50, 150, 0, 0], [100, 50, 150, 30, 90], [0, 0, 900, 0, 0]]}),
            |body| value_of(answer_error_budget(body, machines, ROWS, &Unobserved)),
        ),
    ]
}

/// A plan: what six poses of a tracker would identify.
fn of_calibration(machines: &MachineRegistry) -> Example {
    let rho = json!([
        [600, 500, 500],
        [650, 420, 560],
        [480, 600, 430],
        [400, 380, 390],
        [620, 610, 450],
        [300, 420, 310]
    ]);
    post(
        "/machines/calibration",
        json!({"machine": "verne", "kind": "tracker", "tool_length": 100, "rho": rho, "fixed": ["tool_length", "R2"],
               "sigma": 0.002, "next": 2}),
        |body| {
            let question = read_calibration(body, machines, ROWS)?;
            value_of(answer_calibration(&question, &Unobserved))
        },
    )
}

fn of_workspaces(machines: &MachineRegistry) -> Vec<Example> {
    let request = json!({"machine": "verne", "kind": "part", "tool_length": 50, "table_clearance": 0, "phi1": 30,
                         "tolerance": 10});
    let (id, summary, slice) = match workspace(&request, machines) {
        Ok(workspace) => workspace,
        Err(error) => (String::new(), json!({"error": error.to_string()}), Value::Null),
    };
    let of_job = || json!({"id": id});
    let of_slice = || json!({"id": id, "z": 300, "alpha": "0"});
    let dexterity = json!({"tool_length": 50, "phi1": {"from": -20, "to": 20}, "cell": 200});
    let errors = json!({"kind": "part", "tool_length": 50, "cell": 200, "tolerance": 50,
                        "parameter_tolerances": {"L1": 0.02, "L2": 0.02, "L3": 0.02, "tilt_zero": 0.001}});
    vec![
        get("/workspace", request.clone(), Some(summary.clone())),
        post("/workspace", request, |_| Ok(&summary)),
        // The answer takes seconds.
        Example {
            method: "post",
            path: "/workspace/dexterity",
            request: dexterity,
            file: None,
            answer: None,
        },
        Example {
            method: "post",
            path: "/workspace/error-budget",
            request: errors,
            file: None,
            answer: None,
        },
        get("/jobs", json!({"state": "failed", "limit": 10}), Some(json!({"jobs": [], "next": null}))),
        get("/jobs/{id}", of_job(), None),
        get("/jobs/{id}/events", of_job(), None),
        Example { method: "delete", path: "/jobs/{id}", request: of_job(), file: None, answer: None },
        get("/workspace/{id}", of_job(), Some(summary.clone())),
        get("/workspace/{id}/slice.json", of_slice(), Some(slice)),
        get("/workspace/{id}/slice.svg", of_slice(), None),
        get("/workspace/{id}/slice.dxf", of_slice(), None),
        get("/workspace/{id}/mesh.glb", of_job(), None),
        get("/workspace/{id}/mesh.stl", of_job(), None),
        get("/workspace/{id}/mesh.ply", of_job(), None),
        get("/workspace/{id}/mesh.json", of_job(), None),
        post(
            "/workspace/contains",
            json!({"kind": "part", "tool_length": 50,
                   "points": [[100, 50, 150], [0, 0, 900], null, [5000, 0, 0]]}),
            |body| value_of(answer_contains(body, machines, ROWS, &Unobserved)),
        ),
    ]
}

fn of_programs() -> Vec<Example> {
    let summary = program_summary();
    let of_program = || json!({"id": summary["id"]});
    vec![
        Example {
            method: "post",
            path: "/programs",
            request: json!({"format": "apt"}),
            file: Some(PROGRAM),
            answer: Some(summary.clone()),
        },
        get("/programs/{id}", of_program(), Some(summary.clone())),
        get("/programs/{id}/source", of_program(), None),
    ]
}

/// The summary of the program of the examples.
fn program_summary() -> Value {
    let received = ProgramQuery::default().options(Format::Apt).and_then(|options| {
        let mut receiver = ProgramReceiver::new(Format::Apt, &options);
        // A refused program has its faults in the result.
        let _ = receiver.push(PROGRAM.as_bytes());
        receiver.finish()
    });
    json_of(received.and_then(|received| received.summary().ok_or(OperationError::Internal)))
}

/// The id, the summary and a slice of the workspace for a request.
fn workspace(request: &Value, machines: &MachineRegistry) -> Result<(String, Value, Value), OperationError> {
    let question = WorkspaceQuestion::new(&parse_body(request.to_string().as_bytes())?, machines)?;
    let workspace = compute_workspace(&question, usize::MAX, &Unobserved)?;
    let (inclination, alphas) = (workspace.inclination, Alphas::List(vec![0.0]));
    let slice = answer_slice(&question, inclination, 300.0, &alphas, SliceFormat::Json, &Unobserved);
    Ok((question.id.to_string(), value_of(Ok(workspace.summary))?, value_of(slice)?))
}

//! Examples of operations about tool paths.

use serde_json::{Value, json};
use verne_solver::workspace::Unobserved;

use crate::http::openapi::example::{Example, PROGRAM, get, json_of, post, value_of};
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::origins_question::CheckedOrigins;
use crate::operations::placement::compute_placement;
use crate::operations::placement_question::CheckedPlacement;
use crate::operations::toolpath::compute_toolpath;
use crate::operations::toolpath_request::{ProgramSource, read_fields, read_request};
use crate::operations::window::compute_window;
use crate::operations::window_question::CheckedWindow;
use crate::wire::error::OperationError;
use crate::wire::origins::OriginsBody;
use crate::wire::parse::parse_body;
use crate::wire::placement::PlacementBody;
use crate::wire::window::WindowBody;

/// The examples of tool paths, windows, placements and regions of origins.
pub(super) fn of_toolpaths(machines: &MachineRegistry) -> Vec<Example> {
    let points = json!([
        {"x": 0, "y": 0, "z": 350, "i": 0, "j": 0, "k": 1},
        {"x": 0, "y": 0, "z": 300, "i": 0, "j": 0, "k": 1, "feed": 500},
        {"x": 20, "y": 0, "z": 300, "i": 0, "j": 0.28, "k": 0.96, "feed": 1000},
    ]);
    let request = json!({"program": {"points": points}, "setup": {"x": 10}, "tool_length": 120,
                         "tolerance": {"tip": 0.05}});
    let report = json_of(toolpath_report(&request, machines));
    let window = json!({"program": {"points": request["program"]["points"]}, "setup": {"x": 10},
                        "parameter": "tool_length", "from": 0, "to": 800});
    let placement = json!({"program": {"points": request["program"]["points"]}, "setup": {"x": 10},
                           "tool_length": 120, "free": {"setup.z": [-200, 400]},
                           "reserve": {"stroke": 20, "slider_joint": 2}});
    let origins =
        json!({"program": {"points": request["program"]["points"]}, "tool_length": 120, "cell": 100});
    let region = json_of(origins_id(&origins, machines));
    let (of_region, of_slice) = (|| json!({"id": region}), || json!({"id": region, "z": 0}));
    let of_report = json!({"id": report["id"]});
    let of_path = json!({"id": report["id"], "least": 0, "greatest": 0.25});
    let of_program = json!({"id": report["id"], "axes": "X,Y,Z,A,C", "feed_word": "inverse_time"});
    let some_rows = || json!({"id": report["id"], "from": 0, "to": 3});
    vec![
        post("/toolpath", request, |_| Ok(&report)),
        Example {
            method: "post",
            path: "/toolpath/file",
            request: json!({"format": "apt", "tool_length": "120", "tip_tolerance": 0.05}),
            file: Some(PROGRAM),
            answer: None,
        },
        post("/toolpath/window", window, |body| window_of(body, machines)),
        post("/toolpath/placement", placement, |body| placed(body, machines)),
        Example { method: "post", path: "/toolpath/origins", request: origins, file: None, answer: None },
        get("/toolpath/{id}/mesh.glb", of_region(), None),
        get("/toolpath/{id}/mesh.stl", of_region(), None),
        get("/toolpath/{id}/mesh.ply", of_region(), None),
        get("/toolpath/{id}/mesh.json", of_region(), None),
        get("/toolpath/{id}/slice.json", of_slice(), None),
        get("/toolpath/{id}/slice.svg", of_slice(), None),
        get("/toolpath/{id}/slice.dxf", of_slice(), None),
        get("/toolpath/{id}", of_report, Some(report.clone())),
        get("/toolpath/{id}/rows.json", some_rows(), None),
        get("/toolpath/{id}/rows.ndjson", some_rows(), None),
        get("/toolpath/{id}/rows.csv", some_rows(), None),
        get("/toolpath/{id}/rows.arrow", some_rows(), None),
        get("/toolpath/{id}/program", of_program, None),
        get("/toolpath/{id}/path", of_path, None),
    ]
}

/// The report on a tool path whose request has points.
fn toolpath_report(request: &Value, machines: &MachineRegistry) -> Result<Value, OperationError> {
    let (checked, source) = read_request(request.to_string().as_bytes(), machines)?;
    let ProgramSource::Received(program) = &source else { return Err(OperationError::Internal) };
    let question = checked.question(source.id());
    value_of(compute_toolpath(&question, &program.program, |_| Ok(Vec::new()), |_, _| Ok(()), &Unobserved))
}

/// The window of a parameter of a program whose request has points.
fn window_of(body: &[u8], machines: &MachineRegistry) -> Result<Value, OperationError> {
    let request: WindowBody = parse_body(body)?;
    let (mut checked, source) = read_fields(&request.toolpath, machines)?;
    let ProgramSource::Received(program) = &source else { return Err(OperationError::Internal) };
    let fields = CheckedWindow::new(&request.more, &mut checked)?;
    value_of(compute_window(&fields.question(checked.question(source.id())), &program.program, &Unobserved))
}

/// The placement of a program whose request has points.
fn placed(body: &[u8], machines: &MachineRegistry) -> Result<Value, OperationError> {
    let request: PlacementBody = parse_body(body)?;
    let (checked, source) = read_fields(&request.toolpath, machines)?;
    let ProgramSource::Received(program) = &source else { return Err(OperationError::Internal) };
    let question = CheckedPlacement::new(&request.more, &checked)?.question(checked.question(source.id()));
    value_of(compute_placement(&question, &program.program, &Unobserved))
}

/// The id of the region of origins of a program whose request has points.
fn origins_id(request: &Value, machines: &MachineRegistry) -> Result<String, OperationError> {
    let body = request.to_string();
    let request: OriginsBody = parse_body(body.as_bytes())?;
    let (checked, source) = read_fields(&request.toolpath, machines)?;
    let fields = CheckedOrigins::new(&request.more, &checked)?;
    Ok(fields.question(checked.question(source.id())).id.to_string())
}

//! `/error-budget`: figures against the forward solution of changed machines, rows in every form, invalid requests.

use axum::body::Body;
use axum::http::{Request, header};
use serde_json::{Value, json};

use super::{get, post, send};

fn tolerances() -> Value {
    json!({"e1": 0.01, "e2": 0.01, "R1": 0.02, "r1": 0.01, "R2": 0.02, "r4": 0.01, "L1": 0.03, "L2": 0.02, "L3": 0.02,
           "o1": 0.005, "o2": 0.005, "o3": 0.006})
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// The tool's end in the base frame, by /fk of a machine.
async fn tool(machine: &Value, rho: &[f64]) -> Vec<f64> {
    let body = json!({"machine": machine, "joints": {"rho": rho}, "tool_length": 80});
    let answer = post("/fk", body).await;
    let tool = &answer.solutions()[0]["tool"];
    ["x", "y", "z"].iter().map(|axis| number(&tool[axis])).collect()
}

#[tokio::test]
async fn the_worst_machine_has_the_worst_error() {
    let machine = get("/machines/verne").await.json["definition"].clone();
    let body = json!({"frame": "tool", "tool_length": 80, "parameter_tolerances": tolerances(),
                      "poses": [[120, -60, 1250], [-150, 90, 1200]]});
    let answer = post("/error-budget", body).await.json;
    assert_eq!(answer["counts"]["ok"], 2, "{answer}");
    for (joints, budget) in
        answer["joints"].as_array().unwrap().iter().zip(answer["budgets"].as_array().unwrap())
    {
        let (mut rho, tip) = (numbers(joints), &budget["tip"]);
        let nominal = tool(&machine, &rho).await;
        let mut worst = machine.clone();
        let changes = numbers(&tip["worst_changes"]);
        for (parameter, change) in answer["parameters"].as_array().unwrap().iter().zip(&changes) {
            assert_eq!(number(&parameter["tolerance"]), change.abs(), "{parameter}");
            let field = match parameter["name"].as_str().unwrap() {
                "o1" | "o2" | "o3" => {
                    let slider = parameter["name"].as_str().unwrap().as_bytes()[1] - b'1';
                    rho[usize::from(slider)] += change;
                    continue;
                }
                "e1" => "D1",
                "e2" => "D2",
                name => name,
            };
            worst["geometry"][field] = json!(number(&worst["geometry"][field]) + change);
        }
        let moved = tool(&worst, &rho).await;
        let way: Vec<f64> = moved.iter().zip(&nominal).map(|(a, b)| a - b).collect();
        let (found, exact) = (length(&way), number(&tip["worst_exact"]));
        assert!(found <= exact * (1.0 + 1e-7) && found > exact * (1.0 - 1e-3), "{found} {exact}");
        assert!((exact / number(&tip["worst"]) - 1.0).abs() < 1e-3, "{tip}");
    }
}

#[tokio::test]
async fn figures_obey_their_relations_and_name_their_parameters() {
    let tolerances = json!({"tilt_zero": 0.001, "L2": 0.02, "rotary_axis_y": 0.01, "da": 0});
    let poses = json!([[100, 50, 150, 20, 30], [100, 50, 150, 0, 0, 1], [0, 0, 9000, 0, 0], [1, 2], null]);
    let body = json!({"tool_length": 50, "parameter_tolerances": tolerances, "poses": poses});
    let answer = post("/error-budget", body).await.json;
    let parameters = answer["parameters"].as_array().unwrap();
    let named: Vec<_> = parameters.iter().map(|parameter| parameter["name"].as_str().unwrap()).collect();
    assert_eq!(named, ["L2", "tilt_zero", "rotary_axis_y"]);
    assert_eq!(parameters[0], json!({"name": "L2", "unit": "mm", "nominal": 1050.0, "tolerance": 0.02}));
    assert_eq!(
        parameters[1],
        json!({"name": "tilt_zero", "unit": "deg", "nominal": 0.0, "tolerance": 0.001})
    );
    assert_eq!(answer["status"], json!(["ok", "ok", "infeasible", "invalid", "invalid"]));
    let budgets = answer["budgets"].as_array().unwrap();
    assert!(budgets[3].is_null() && budgets[4].is_null() && answer["joints"][4].is_null());
    for budget in &budgets[..2] {
        for figure in [&budget["tip"], &budget["axis"]] {
            let contributions = numbers(&figure["contributions"]);
            let (rms, worst) = (number(&figure["rms"]), number(&figure["worst"]));
            assert!((length(&contributions) - rms).abs() < 1e-12 * rms, "{figure}");
            assert!((length(&numbers(&figure["standard_deviations"])) - rms).abs() < 1e-12 * rms, "{figure}");
            assert!(rms <= worst && worst <= contributions.iter().sum::<f64>() * (1.0 + 1e-12), "{figure}");
        }
    }
    // An error of the tilting axis turns the tool's axis by as much.
    assert!((number(&budgets[0]["axis"]["contributions"][1]) - 0.001).abs() < 1e-12);
    assert_eq!(budgets[0]["axis"]["contributions"][2], 0.0);
}

#[tokio::test]
async fn the_tool_does_not_matter_to_the_platform() {
    let budget = |frame: &str, tool_length: f64| {
        let body = json!({"frame": frame, "tool_length": tool_length, "poses": [[20, 30, 1200]],
                          "parameter_tolerances": {"L1": 0.02, "tool_length": 0.1}});
        async move { post("/error-budget", body).await.json["budgets"][0].clone() }
    };
    assert_eq!(budget("platform", 0.0).await, budget("platform", 300.0).await);
    assert_eq!(budget("platform", 0.0).await["tip"]["contributions"][1], 0.0);
    assert!(number(&budget("tool", 0.0).await["tip"]["contributions"][1]) > 0.09);
}

#[tokio::test]
async fn a_table_has_the_errors_of_the_rows() {
    let rows = [[100.0, 50.0, 150.0, 0.0, 0.0], [20.0, -30.0, 200.0, 10.0, 40.0]];
    let body =
        json!({"tool_length": 50, "parameter_tolerances": {"L1": 0.02, "tilt_zero": 0.001}, "poses": rows});
    let budgets = post("/error-budget", body).await.json["budgets"].clone();
    let lines: Vec<_> = rows.iter().map(|row| row.map(|n| n.to_string()).join(",") + ",A\n").collect();
    let text = lines.concat();
    let query = "format=csv&tool_length=50&parameter_tolerances=%7B%22L1%22:0.02,%22tilt_zero%22:0.001%7D";
    let request = Request::post(format!("/error-budget?{query}")).header(header::CONTENT_TYPE, "text/csv");
    let reply = send(request.body(Body::from(format!("x,y,z,phi1,phi2,id\n{text}"))).unwrap()).await;
    assert_eq!(reply.status, 200, "{}", reply.json);
    let table = String::from_utf8(reply.bytes).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let column = |name: &str| names.iter().position(|other| *other == name).unwrap();
    let lines: Vec<_> = lines.collect();
    assert_eq!(lines.len(), 2);
    for (line, budget) in lines.iter().zip(budgets.as_array().unwrap()) {
        assert_eq!((line[column("id")], line[column("status")]), ("A", "ok"));
        for figure in ["tip", "axis"] {
            for name in ["rms", "worst", "worst_exact"] {
                let found: f64 = line[column(&format!("{figure}_{name}"))].parse().unwrap();
                assert_eq!(found, number(&budget[figure][name]), "{figure} {name}");
            }
        }
    }
}

#[tokio::test]
async fn a_problem_names_the_field() {
    for (body, pointer) in [
        (json!({"poses": []}), "/parameter_tolerances"),
        (json!({"parameter_tolerances": {"L1": 1}}), "/poses"),
        (json!({"parameter_tolerances": {}, "poses": []}), "/parameter_tolerances"),
        (json!({"parameter_tolerances": {"L1": 0}, "poses": []}), "/parameter_tolerances"),
        (json!({"parameter_tolerances": {"L1": -1, "L2": 1}, "poses": []}), "/parameter_tolerances/L1"),
        (json!({"parameter_tolerances": {"D1": 1}, "poses": []}), "/parameter_tolerances/D1"),
        (json!({"parameter_tolerances": {"L1": 1}, "tool_length": -1, "poses": []}), "/tool_length"),
        (json!({"parameter_tolerances": {"L1": 1}, "machine": "no", "poses": []}), "/machine"),
    ] {
        post("/error-budget", body).await.assert_bad_field(pointer);
    }
    let many = json!({"parameter_tolerances": {"L1": 1}, "poses": vec![json!(null); 2001]});
    post("/error-budget", many).await.assert_problem(413, "too_many_rows");
    let request = |query: &str| {
        let request =
            Request::post(format!("/error-budget?{query}")).header(header::CONTENT_TYPE, "text/csv");
        send(request.body(Body::from("x,y,z,phi1,phi2\n1,2,3,0,0\n")).unwrap())
    };
    request("format=csv").await.assert_bad_field("/query/parameter_tolerances");
    request("format=csv&parameter_tolerances=%7B%22L1%22:-1,%22L2%22:1%7D")
        .await
        .assert_bad_field("/query/parameter_tolerances/L1");
    request("format=csv&parameter_tolerances=1").await.assert_bad_field("/query/parameter_tolerances");
}

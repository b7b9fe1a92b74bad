//! The table as a limit: `table_clearance` and `tool_radius`, and the list of what is not checked.

use serde_json::{Value, json};

use super::{get, post};
use crate::cli::verne;

pub(super) const CHECKED: [&str; 2] = ["part", "fixtures"];
pub(super) const UNCHECKED: [&str; 3] = ["table", "part", "fixtures"];

/// The built-in machine with a limit of its own.
pub(super) fn machine(least: &Value) -> Value {
    let mut machine =
        serde_json::from_str::<Value>(include_str!("../../reference/machine-verne.json")).unwrap();
    machine["limits"]["table_clearance"] = least.clone();
    machine
}

/// A tool end below the table; all other margins are positive.
fn below() -> Value {
    json!({"pose": {"x": 0, "y": 0, "z": -120, "phi1": 0, "phi2": 0}, "tool_length": 400})
}

/// A question with further fields.
pub(super) fn with(mut question: Value, fields: Value) -> Value {
    let Value::Object(fields) = fields else { unreachable!("fields are an object") };
    question.as_object_mut().unwrap().extend(fields);
    question
}

#[tokio::test]
async fn without_a_clearance_the_table_is_listed_as_not_checked() {
    let answer = post("/ik", below()).await;
    let solution = &answer.solutions()[0];
    assert_eq!(solution["feasible"], true);
    assert_eq!(solution["margins"].get("table_clearance"), None);
    assert_eq!(answer.json["not_checked"], json!(UNCHECKED));
    for (uri, question) in [
        ("/fk", json!({"joints": {"rho": [400, 400, 400]}})),
        ("/fk/batch", json!({"joints": [[400, 400, 400, 0, 0]]})),
        ("/ik/batch", json!({"poses": [[0, 0, 100, 0, 0]]})),
        ("/workspace/contains", json!({"points": [[0, 0, 1200]]})),
        ("/workspace", json!({"tolerance": 30})),
        ("/workspace", json!({"kind": "part", "phi1": [0, 1], "tolerance": 30})),
        ("/workspace/dexterity", json!({"phi1": {"from": 0, "to": 0}, "cell": 200})),
    ] {
        let answer = post(uri, question).await;
        assert_eq!(answer.status, 200, "{uri} {}", answer.json);
        assert_eq!(answer.json["not_checked"], json!(UNCHECKED), "{uri}");
    }
}

#[tokio::test]
async fn a_tool_end_below_the_table_is_infeasible() {
    let expected = json!({"constraint": "table_clearance", "value": -120.0, "unit": "mm", "element": "tool"});
    let asked = with(below(), json!({"table_clearance": 0}));
    let query = "/ik?x=0&y=0&z=-120&phi1=0&phi2=0&tool_length=400&table_clearance=0";
    for answer in [post("/ik", &asked).await, get(query).await] {
        assert_eq!(answer.json["not_checked"], json!(CHECKED));
        let solution = &answer.solutions()[0];
        assert_eq!(solution["feasible"], false);
        let margin = &solution["margins"]["table_clearance"];
        assert!((margin["value"].as_f64().unwrap() + 120.0).abs() < 1e-9, "{margin}");
        for field in ["constraint", "unit", "element"] {
            assert_eq!(margin[field], expected[field]);
        }
        assert_eq!(&solution["margins"]["worst"], margin);
        let joints = &solution["joints"];
        let fk = json!({"joints": joints, "tool_length": 400, "table_clearance": 0});
        let fk = post("/fk", fk).await;
        let again = &fk.solutions()[0]["margins"]["table_clearance"];
        assert!((again["value"].as_f64().unwrap() + 120.0).abs() < 1e-6, "{again}");
        assert_eq!(fk.json["not_checked"], json!(CHECKED));
    }
    let feasible = post("/ik", with(asked, json!({"solutions": "feasible"}))).await.json;
    assert_eq!((&feasible["solutions"], &feasible["reason"]), (&json!([]), &json!("infeasible")));
    assert_eq!(feasible["constraint"]["constraint"], "table_clearance");
    // An inclined tool of some radius is lower than its centre by radius × sin(phi1).
    let inclined = json!({"pose": {"x": 0, "y": 0, "z": 100, "phi1": 30, "phi2": 0}, "tool_length": 400,
                          "table_clearance": 10, "tool_radius": 40});
    let margin = post("/ik", inclined).await.solutions()[0]["margins"]["table_clearance"].clone();
    assert!((margin["value"].as_f64().unwrap() - 70.0).abs() < 1e-9, "{margin}");
    // With a short tool a joint of the platform is the lowest: R1 sin(phi1) below P.
    let short = json!({"pose": {"x": 0, "y": 0, "z": 200, "phi1": 40, "phi2": 0}, "table_clearance": 0});
    let margin = post("/ik", short).await.solutions()[0]["margins"]["table_clearance"].clone();
    let expected = 200.0 - 275.0 * 40_f64.to_radians().sin();
    assert!((margin["value"].as_f64().unwrap() - expected).abs() < 1e-9, "{margin}");
    assert_eq!(margin["element"], "joint11");
}

#[tokio::test]
async fn the_clearance_of_a_request_overrides_the_machine() {
    let of_machine = with(below(), json!({"machine": machine(&json!(30)), "solutions": "working"}));
    let value =
        |answer: &Value| answer["solutions"][0]["margins"]["table_clearance"]["value"].as_f64().unwrap();
    let own = post("/ik", &of_machine).await.json;
    assert!((value(&own) + 150.0).abs() < 1e-9);
    assert_eq!(own["not_checked"], json!(CHECKED));
    let asked = post("/ik", with(of_machine.clone(), json!({"table_clearance": 5}))).await.json;
    assert!((value(&asked) + 125.0).abs() < 1e-9);
    // The machine's limit cannot be looked at where theta1 is open: the answer says so.
    for question in [
        json!({"machine": machine(&json!(30)), "frame": "platform", "pose": {"x": 0, "y": 0, "z": 1200}}),
        json!({"machine": machine(&json!(30)), "frame": "tool", "pose": {"x": 0, "y": 0, "z": 1200}}),
    ] {
        let answer = post("/ik", question).await.json;
        assert_eq!(answer["not_checked"], json!(UNCHECKED));
        assert_eq!(answer["solutions"][0]["margins"].get("table_clearance"), None);
    }
    let mixed = json!({"machine": machine(&json!(0)), "joints": [[400, 400, 400, 0, 0], [400, 400, 400]]});
    assert_eq!(post("/fk/batch", mixed).await.json["not_checked"], json!(UNCHECKED));
    let whole = json!({"machine": machine(&json!(0)), "joints": [[400, 400, 400, 0, 0]]});
    assert_eq!(post("/fk/batch", whole).await.json["not_checked"], json!(CHECKED));
}

#[tokio::test]
async fn a_clearance_without_theta1_is_refused() {
    let clear = |question| with(question, json!({"table_clearance": 0}));
    for (uri, question) in [
        ("/fk", json!({"joints": {"rho": [400, 400, 400]}})),
        ("/ik", json!({"frame": "platform", "pose": {"x": 0, "y": 0, "z": 1200}})),
        ("/ik", json!({"frame": "tool", "pose": {"x": 0, "y": 0, "z": 1200}})),
        ("/ik/batch", json!({"frame": "tool", "poses": []})),
        ("/workspace", json!({"kind": "tool"})),
        ("/workspace", json!({"kind": "tool", "tool_length": [1, 2]})),
        ("/workspace/contains", json!({"points": []})),
    ] {
        let answer = post(uri, clear(question)).await;
        answer.assert_bad_field("/table_clearance");
        assert!(answer.json["errors"][0]["detail"].as_str().unwrap().contains("theta1"), "{}", answer.json);
    }
    get("/workspace?table_clearance=0").await.assert_bad_field("/query/table_clearance");
    let rows = json!([[400, 400, 400], [400, 400, 400, 0, 0]]);
    let batch = post("/fk/batch", clear(json!({"joints": rows}))).await.json;
    assert_eq!(batch["status"][0], "invalid");
    assert!(batch["errors"][0]["detail"].as_str().unwrap().contains("theta1"));
    assert_ne!(batch["status"][1], "invalid");
    assert_eq!(batch["not_checked"], json!(CHECKED));
}

#[tokio::test]
async fn clearances_out_of_range_are_refused() {
    let pose = json!({"x": 0, "y": 0, "z": 100, "phi1": 0, "phi2": 0});
    for (uri, question) in [
        ("/ik", json!({"pose": pose})),
        ("/ik/batch", json!({"poses": []})),
        ("/fk/batch", json!({"joints": []})),
        ("/fk", json!({"joints": {"rho": [400, 400, 400], "theta1": 0, "theta2": 0}})),
        ("/workspace", json!({"kind": "part"})),
        ("/workspace", json!({"kind": "part", "phi1": [0, 1]})),
        ("/workspace/contains", json!({"kind": "part", "points": []})),
        ("/workspace/dexterity", json!({"phi1": {"from": 0, "to": 1}})),
        ("/workspace/error-budget", json!({"kind": "part", "parameter_tolerances": {"L1": 0.1}})),
    ] {
        for field in ["table_clearance", "tool_radius"] {
            for number in [json!(-1), json!(1e9)] {
                let mut bad = question.clone();
                bad[field] = number;
                post(uri, bad).await.assert_bad_field(&format!("/{field}"));
            }
        }
    }
    for bad in [json!(-1), json!(1e7)] {
        let answer = post("/fk", json!({"machine": machine(&bad), "joints": {"rho": [400, 400, 400]}})).await;
        answer.assert_bad_field("/machine/limits/table_clearance");
    }
}

#[tokio::test]
async fn batches_check_the_clearance_like_single_requests() {
    let mut rows = Vec::new();
    for i in 0..60 {
        let i = f64::from(i);
        rows.push([
            (37.0 * i) % 500.0 - 250.0,
            (91.0 * i) % 600.0 - 300.0,
            9.0 * i - 200.0,
            i - 30.0,
            2.0 * i,
        ]);
    }
    let shared = json!({"tool_length": 300, "table_clearance": 15, "tool_radius": 25});
    let batch = post("/ik/batch", with(json!({"poses": rows}), shared.clone())).await.json;
    assert_eq!(batch["not_checked"], json!(CHECKED));
    let mut joints = Vec::new();
    let mut by_table = 0;
    for (i, [x, y, z, phi1, phi2]) in rows.iter().enumerate() {
        let pose = json!({"x": x, "y": y, "z": z, "phi1": phi1, "phi2": phi2});
        let alone = post("/ik", with(json!({"pose": pose}), shared.clone())).await.json;
        let solution = &alone["solutions"][0];
        if solution.is_null() {
            assert_eq!(batch["status"][i], "unreachable");
            continue;
        }
        assert_eq!(batch["status"][i] == "ok", solution["feasible"] == true);
        let worst = &solution["margins"]["worst"];
        assert_eq!(batch["constraint"][i], worst["constraint"]);
        assert_eq!(batch["margin"][i], worst["value"]);
        assert_eq!(batch["element"][i], worst["element"]);
        by_table += usize::from(solution["feasible"] == false && worst["constraint"] == "table_clearance");
        joints.push(batch["joints"][i].clone());
    }
    assert!(by_table > 5, "{by_table}");
    let batch = post("/fk/batch", with(json!({"joints": joints}), shared.clone())).await.json;
    for (i, row) in joints.iter().enumerate() {
        let joints = json!({"rho": [row[0], row[1], row[2]], "theta1": row[3], "theta2": row[4]});
        let alone = post("/fk", with(json!({"joints": joints}), shared.clone())).await.json;
        let solution = &alone["solutions"][0];
        assert_eq!(batch["status"][i] == "ok", solution["feasible"] == true);
        assert_eq!(batch["margin"][i], solution["margins"]["worst"]["value"]);
    }
}

#[tokio::test]
async fn the_command_line_accepts_a_clearance() {
    let json = |line: &str| serde_json::from_str::<Value>(&verne(line).unwrap()).unwrap();
    let ik =
        "ik --x 0 --y 0 --z 40 --phi1 20 --phi2 0 --tool-length 300 --table-clearance 5 --tool-radius 30";
    let uri = "/ik?x=0&y=0&z=40&phi1=20&phi2=0&tool_length=300&table_clearance=5&tool_radius=30";
    assert_eq!(json(ik), get(uri).await.json);
    let fk = "fk --rho 500,500,500 --theta1 -10 --theta2 0 --tool-length 300 --table-clearance 5";
    let uri = "/fk?rho=500,500,500&theta1=-10&theta2=0&tool_length=300&table_clearance=5";
    assert_eq!(json(fk), get(uri).await.json);
    let workspace =
        "workspace --kind part --tool-length 400 --tolerance 20 --table-clearance 0 --tool-radius 10";
    let uri = "/workspace?kind=part&tool_length=400&tolerance=20&table_clearance=0&tool_radius=10";
    assert_eq!(json(workspace), get(uri).await.json);
    let refused = verne("fk --rho 1,2,3 --table-clearance 0").unwrap_err();
    assert!(refused.contains("--table-clearance"), "{refused}");
}

#[tokio::test]
async fn a_machine_without_clearance_keeps_its_id() {
    // BLAKE3 of the built-in machine's numbers as it was before there was this limit.
    let hash = "3214e8042fa3ea15fde8cee9b118146867a0d73b30528810d173ea27a1651cdc";
    let answer = get("/machines/verne").await.json;
    assert_eq!(answer["machine"]["hash"], hash);
    assert_eq!(answer["definition"]["limits"].get("table_clearance"), None);
    let schema = get("/machines/schema").await.json;
    let limits = &schema["properties"]["limits"];
    assert!(limits["properties"]["table_clearance"].is_object(), "{limits}");
    assert!(!limits["required"].as_array().unwrap().contains(&json!("table_clearance")));
}

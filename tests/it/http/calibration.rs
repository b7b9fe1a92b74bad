//! `/machines/calibration`: known machines are found again from measurements in every form; plans; invalid requests.

use axum::Router;
use axum::body::Body;
use axum::http::{Request, header};
use serde_json::{Value, json};
use verne_rows::{Column, Format, Writer};

use super::{Reply, config, get_from, json_request, opened, post, send, send_to, service};

const URI: &str = "/machines/calibration";
const TOOL_LENGTH: f64 = 100.0;

/// Positions of the sliders, each on its own way.
fn readings(count: u32) -> Vec<[f64; 3]> {
    let row = |i| {
        let i = f64::from(i);
        [(0.7 * i).sin(), (1.3 * i).sin(), (2.1 * i).cos()].map(|way| (4500.0 + 1150.0 * way).round() / 10.0)
    };
    (0..count).map(row).collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The built-in machine with other lengths, as no drawing shows it.
async fn actual(service: &Router) -> Value {
    let mut machine = get_from(service, "/machines/verne", &[]).await.json["definition"].clone();
    machine["geometry"]["L1"] = json!(1050.3);
    machine["geometry"]["R1"] = json!(274.8);
    machine
}

/// The tool ends of a machine, by /fk.
async fn tips(service: &Router, machine: &Value, rho: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut tips = Vec::new();
    for rho in rho {
        let body = json!({"machine": machine, "joints": {"rho": rho}, "tool_length": TOOL_LENGTH});
        let answer = send_to(service.clone(), json_request(axum::http::Method::POST, "/fk", body)).await;
        let tool = &answer.solutions()[0]["tool"];
        tips.push(["x", "y", "z"].map(|axis| tool[axis].as_f64().unwrap()));
    }
    tips
}

async fn table(uri: &str, media: &str, body: impl Into<Body>) -> Reply {
    let request = Request::post(uri).header(header::CONTENT_TYPE, media);
    send(request.body(body.into()).unwrap()).await
}

/// Rows with named columns, in a format.
fn rows(format: Format, names: &[&str], rows: &[Vec<f64>]) -> Vec<u8> {
    let column = |(i, name): (usize, &&str)| Column::numbers(name, rows.iter().map(|row| Some(row[i])));
    let columns: Vec<_> = names.iter().enumerate().map(column).collect();
    let mut writer = Writer::new(format, &columns).unwrap();
    let mut bytes = writer.write(&columns).unwrap();
    bytes.extend(writer.finish().unwrap());
    bytes
}

#[tokio::test]
async fn a_machine_is_found_again_and_is_ready_for_requests() {
    let (service, rho) = (service().await, readings(30));
    let actual = actual(&service).await;
    let points = tips(&service, &actual, &rho).await;
    let body = json!({"tool_length": TOOL_LENGTH, "rho": rho, "points": points, "sigma": 0.002});
    let answer = post(URI, body).await.json;
    assert_eq!((&answer["rank"], &answer["unidentifiable"]), (&json!(13), &json!([])), "{answer}");
    for (name, value) in [("L1", 1050.3), ("R1", 274.8), ("L2", 1050.0), ("r4", 500.0)] {
        let found = answer["machine"]["geometry"][name].as_f64().unwrap();
        assert!((found - value).abs() < 1e-5, "{name}: {found}");
    }
    let of_list = |list: &str| answer[list].as_array().unwrap().len();
    assert_eq!(["parameters", "residuals", "outliers", "next"].map(of_list), [13, 30, 0, 5]);
    assert!(answer["rms"].as_f64().unwrap() < 1e-8 && answer["frame"].is_null(), "{answer}");

    // In a request as it is ...
    let offsets = numbers(&answer["slider_offsets"]);
    let moved: Vec<_> = rho.iter().map(|rho| [0, 1, 2].map(|i| rho[i] + offsets[i])).collect();
    for (found, measured) in tips(&service, &answer["machine"], &moved).await.iter().zip(&points) {
        assert!((0..3).all(|i| (found[i] - measured[i]).abs() < 1e-6), "{found:?} {measured:?}");
    }
    // ... and published beside the one with which the search began.
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("calibrated.json"), answer["machine"].to_string()).unwrap();
    let with_file = opened(&config(Some(directory.path().into()))).await;
    let published = get_from(&with_file, "/machines/verne-calibrated", &[]).await.json;
    assert_eq!(published["definition"], answer["machine"]);
    assert_eq!(published["hash"], answer["hash"]);
    assert_eq!(get_from(&with_file, "/machines/verne", &[]).await.json["hash"], answer["start"]["hash"]);
}

#[tokio::test]
async fn every_format_has_the_same_answer() {
    let (service, rho) = (service().await, readings(30));
    let points = tips(&service, &actual(&service).await, &rho).await;
    let body = json!({"tool_length": TOOL_LENGTH, "rho": rho, "points": points, "sigma": 0.002,
                      "fixed": ["R2"], "priors": {"L3": {"sigma": 0.1}}, "bounds": {"r4": [499.9, 500.1]}, "next": 2});
    let expected = post(URI, body).await.json;
    assert_eq!(expected["next"].as_array().unwrap().len(), 2, "{expected}");
    let table_rows: Vec<Vec<f64>> = rho.iter().zip(&points).map(|(a, b)| [&a[..], &b[..]].concat()).collect();
    let names = ["rho1", "rho2", "rho3", "x", "y", "z"];
    let query = "tool_length=100&sigma=0.002&fixed=R2&next=2&priors=%7B%22L3%22:%7B%22sigma%22:0.1%7D%7D\
                 &bounds=%7B%22r4%22:[499.9,500.1]%7D";
    for format in Format::ALL {
        let body = rows(format, &names, &table_rows);
        let answer = table(&format!("{URI}?{query}"), format.media(), body.clone()).await;
        assert_eq!((answer.status.as_u16(), &answer.json), (200, &expected), "{}", format.name());
        // curl states a media type of its own.
        let uri = format!("{URI}?format={}&{query}", format.name());
        assert_eq!(table(&uri, "application/x-www-form-urlencoded", body).await.json, expected);
    }
    assert!(expected["parameters"].as_array().unwrap().iter().all(|parameter| parameter["name"] != "R2"));
}

#[tokio::test]
async fn lengths_are_measurements_too() {
    let (service, rho) = (service().await, readings(40));
    let points = tips(&service, &actual(&service).await, &rho).await;
    let distance = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let centre = [10.0, -20.0, 900.0];
    let lengths: Vec<_> = points.iter().map(|tip| distance(tip, &centre)).collect();
    let pairs: Vec<_> = (1..40).map(|i| json!([i - 1, i, distance(&points[i - 1], &points[i])])).collect();
    for (fields, rank, unknowns, names) in [
        (json!({"kind": "ballbar", "lengths": lengths, "centre": centre}), 13, 13, vec![]),
        (json!({"kind": "ballbar", "lengths": lengths}), 14, 16, vec!["centre.x e1 e2", "centre.z o1 o2 o3"]),
        (json!({"kind": "distances", "pairs": pairs}), 11, 13, vec!["e1 e2", "o1 o2 o3"]),
        (json!({"kind": "tracker", "points": points}), 17, 19, vec!["e1 e2 frame.x", "frame.z o1 o2 o3"]),
    ] {
        let mut body = json!({"tool_length": TOOL_LENGTH, "rho": rho, "sigma": 0.002});
        body.as_object_mut().unwrap().extend(fields.as_object().unwrap().clone());
        let answer = post(URI, &body).await.json;
        assert_eq!((&answer["rank"], &answer["unknowns"]), (&json!(rank), &json!(unknowns)), "{answer}");
        let combinations = answer["unidentifiable"].as_array().unwrap().iter();
        let of_names = combinations.map(|names| {
            let mut names: Vec<_> = names.as_object().unwrap().keys().map(String::as_str).collect();
            names.sort_unstable();
            names.join(" ")
        });
        assert_eq!(of_names.collect::<Vec<_>>(), names, "{answer}");
        let parameters = answer["parameters"].as_array().unwrap();
        let length = parameters.iter().find(|parameter| parameter["name"] == "L1").unwrap();
        assert!((length["value"].as_f64().unwrap() - 1050.3).abs() < 1e-4, "{length}");
        assert_eq!(length["identifiable"], true);
    }
}

#[tokio::test]
async fn poses_without_values_are_a_plan() {
    let rho = readings(30);
    let plan =
        post(URI, json!({"rho": rho, "kind": "tracker", "sigma": 0.002, "tool_length": 100})).await.json;
    assert_eq!((&plan["rank"], &plan["unknowns"]), (&json!(17), &json!(19)), "{plan}");
    assert_eq!((&plan["rms"], &plan["residuals"], &plan["frame"]), (&json!(null), &json!([]), &json!(null)));
    let verne = super::get("/machines/verne").await.json;
    assert_eq!((&plan["machine"], &plan["hash"]), (&verne["definition"], &verne["hash"]));
    let text = rho.iter().map(|[a, b, c]| format!("{a},{b},{c}\n"));
    let text = format!("rho1,rho2,rho3\n{}", text.collect::<String>());
    let of_table = table(&format!("{URI}?kind=tracker&sigma=0.002&tool_length=100"), "text/csv", text).await;
    assert_eq!(of_table.json, plan);
}

#[tokio::test]
async fn with_every_parameter_fixed_the_answer_says_how_well_the_machine_fits() {
    let (service, rho) = (service().await, readings(10));
    let points = tips(&service, &actual(&service).await, &rho).await;
    let all = ["e1", "e2", "R1", "r1", "R2", "r4", "L1", "L2", "L3", "o1", "o2", "o3", "tool_length"];
    let mut body = json!({"tool_length": TOOL_LENGTH, "rho": rho, "points": points, "fixed": all});
    let answer = post(URI, &body).await.json;
    assert_eq!((&answer["rank"], &answer["parameters"]), (&json!(0), &json!([])), "{answer}");
    assert!(answer["rms"].as_f64().unwrap() > 0.05, "{answer}");
    body["fixed"] = json!(all[..12]);
    body["bounds"] = json!({"tool_length": [100, 101]});
    body["points"][0] = json!([0, 0, 1300]);
    let answer = post(URI, &body).await.json;
    assert_eq!(answer["parameters"].as_array().unwrap().len(), 1, "{answer}");
}

#[tokio::test]
async fn one_measurement_determines_three_combinations() {
    let body = json!({"rho": [[500, 480, 520]], "points": [[3, -2, 1401]], "tool_length": 100});
    let answer = post(URI, body).await.json;
    assert_eq!((&answer["rank"], &answer["sigma"]), (&json!(3), &json!(null)), "{answer}");
    assert_eq!(answer["unidentifiable"].as_array().unwrap().len(), 10);
    assert!(answer["rms"].as_f64().unwrap() < 1e-6, "{answer}");
    assert!(answer["parameters"].as_array().unwrap().iter().all(|parameter| parameter["sigma"].is_null()));
}

#[tokio::test]
async fn a_problem_names_the_field() {
    let faults = [
        (json!({"rho": null}), "/rho"),
        (json!({"rho": [], "points": []}), "/rho"),
        (json!({"rho": [[500, 500], [500, 500, 500]]}), "/rho/0"),
        (json!({"rho": [[500, 500, 500], [500, null, 500]]}), "/rho/1/1"),
        (json!({"rho": [[5e8, 500, 500], [450, 480, 520]]}), "/rho/0/0"),
        (json!({"rho": [[500, 500, 500], [0, 5000, 0]]}), "/rho/1"),
        (json!({"points": [[0, 0, 1400]]}), "/points"),
        (json!({"points": [[0, 0, 1400], [0, 0, -1e8]]}), "/points/1/2"),
        (json!({"kind": "ballbar"}), "/points"),
        (json!({"kind": "sphere"}), "/kind"),
        (json!({"kind": "part"}), "/table"),
        (json!({"table": [[0, 0], [0, 0]]}), "/table"),
        (json!({"lengths": [1, 2]}), "/lengths"),
        (json!({"pairs": [[0, 1, 5]]}), "/pairs"),
        (json!({"centre": [0, 0, 900]}), "/centre"),
        (json!({"fixed": ["D1"]}), "/fixed/0"),
        (json!({"fixed": ["L1", "da"]}), "/fixed/1"),
        (json!({"priors": {"L1": {"sigma": 0.1}}}), "/sigma"),
        (json!({"sigma": 0.002, "priors": {"L1": {"sigma": -0.1}}}), "/priors/L1/sigma"),
        (json!({"sigma": 0.002, "priors": {"L1": {"value": 1050}}}), "/priors/L1/sigma"),
        (json!({"sigma": 0.002, "priors": {"D1": {"sigma": 0.1}}}), "/priors/D1"),
        (json!({"sigma": 0.002, "priors": {"L1": {"sigma": 0.1}}, "fixed": ["L1"]}), "/priors/L1"),
        (json!({"bounds": {"L1": [1051, 1052]}}), "/bounds/L1"),
        (json!({"bounds": {"L1": [1000]}}), "/bounds/L1"),
        (json!({"bounds": {"L1": [1000, 1100]}, "fixed": ["L1"]}), "/bounds/L1"),
        (json!({"sigma": 0}), "/sigma"),
        (json!({"loss": "cubes"}), "/loss"),
        (json!({"next": 51}), "/next"),
        (json!({"tool_length": -1}), "/tool_length"),
        (json!({"machine": "no"}), "/machine"),
        (json!({"sigmas": 1}), "/sigmas"),
    ];
    for (change, pointer) in faults {
        let mut body =
            json!({"rho": [[500, 500, 500], [450, 480, 520]], "points": [[0, 0, 1400], [1, 2, 1400]]});
        body.as_object_mut().unwrap().extend(change.as_object().unwrap().clone());
        println!("{body}");
        post(URI, &body).await.assert_bad_field(pointer);
    }
    for (pairs, pointer) in [
        (json!(null), "/pairs"),
        (json!([]), "/pairs"),
        (json!([[0, 1, 5], [0, 0, 5]]), "/pairs/1"),
        (json!([[0, 2, 5]]), "/pairs/0"),
        (json!([[0, 0.5, 5]]), "/pairs/0"),
        (json!([[0, -1, 5]]), "/pairs/0"),
        (json!([[0]]), "/pairs/0"),
        (json!([[0, 1, -5]]), "/pairs/0/2"),
        (json!([[0, 1, 5], [0, 1]]), "/pairs/1"),
    ] {
        let body = json!({"kind": "distances", "rho": [[500, 500, 500], [450, 480, 520]], "pairs": pairs});
        post(URI, body).await.assert_bad_field(pointer);
    }
    let many = json!({"rho": vec![[5e8, 500.0, 500.0]; 500], "points": vec![[0; 3]; 500]});
    assert_eq!(post(URI, many).await.json["errors"].as_array().unwrap().len(), 100);
}

#[tokio::test]
async fn a_problem_names_the_column_and_the_row() {
    let csv = "rho1,rho2,rho3,x,y,z\n500,500,500,0,0,1400\n";
    for (query, text, pointer, detail) in [
        ("", "rho1,rho2,x,y,z\n1,2,3,4,5\n", "/columns/rho3", "missing"),
        ("", "rho1,rho2,rho3,x,y\n1,2,3,4,5\n", "/columns/z", "missing"),
        ("", &format!("{csv}500,500,500,0,0,nan\n"), "/columns/z", "row 1 in line 3"),
        ("", &format!("{csv}500,500,,0,0,1400\n"), "/columns/rho3", "row 1 in line 3"),
        ("", &format!("{csv}500,5000,500,0,0,1400\n"), "/columns/rho1", "row 1 in line 3"),
        ("?kind=ballbar", "rho1,rho2,rho3,length\n500,500,500,-1\n", "/columns/length", "at least 0"),
        (
            "?kind=distances",
            "rho1,rho2,rho3,to_rho1,to_rho2,to_rho3,distance\n500,500,500,500,500,500,1\n",
            "/columns/to_rho1",
            "another pose",
        ),
        ("?kind=sphere", csv, "/query/kind", "sphere"),
        ("?fixed=L1,D1", csv, "/query/fixed", "D1"),
        ("?fixed=L1,da", csv, "/query/fixed/1", "kind `tips`"),
        ("?sigma=-1", csv, "/query/sigma", "number"),
        ("?bounds=%7B%22L1%22:[1,2]%7D", csv, "/query/bounds/L1", "1050"),
        ("?priors=7", csv, "/query/priors", "object"),
        ("?centre=1,2,3", csv, "/query/centre", "ballbar"),
        ("?machine=no", csv, "/query/machine", "no"),
    ] {
        let reply = table(&format!("{URI}{query}"), "text/csv", text.to_owned()).await;
        println!("{query} {text} {}", reply.json);
        reply.assert_bad_field(pointer);
        let given = reply.json["errors"][0]["detail"].as_str().unwrap();
        assert!(given.contains(detail), "{given}");
    }
}

#[tokio::test]
async fn other_bodies_have_their_own_problems() {
    let empty = table(URI, "text/csv", "rho1,rho2,rho3,x,y,z\n").await;
    empty.assert_problem(422, "bad_rows");
    table(URI, "text/csv", "").await.assert_problem(422, "bad_rows");
    table(URI, "text/plain", "rho1\n").await.assert_problem(415, "unsupported_media_type");
    let in_both = format!("{URI}?kind=tracker");
    post(&in_both, json!({"rho": [[500, 500, 500]]})).await.assert_bad_field("/query/kind");
    post(&format!("{URI}?format=csv"), json!({})).await.assert_bad_field("/query/format");
    post(URI, json!({"rho": vec![[500; 3]; 2001]})).await.assert_problem(413, "too_many_rows");
    let text = format!("rho1,rho2,rho3\n{}", "500,500,500\n".repeat(2001));
    table(URI, "text/csv", text).await.assert_problem(413, "too_many_rows");
    // Points of another machine, and in an order of their own.
    let points: Vec<_> = readings(20).iter().map(|[x, y, z]| [x - 450.0, y - 400.0, 3.0 * z]).collect();
    let body = json!({"rho": readings(20), "points": points, "tool_length": 100, "sigma": 0.002});
    post(URI, body).await.assert_problem(422, "no_fit");
}

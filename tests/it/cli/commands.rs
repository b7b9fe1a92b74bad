//! The commands beside the questions: machines, keys, jobs of a service, completions, manual pages and help.

use std::net::TcpListener;

use serde_json::{Value, json};

use super::{answering, json as json_of, run, verne};
use crate::http::{get, post};

#[tokio::test]
async fn a_printed_machine_is_a_machine_file() {
    let printed = run("machine");
    assert_eq!((printed.status, &printed.out), (Ok(0), &verne("machine verne").unwrap()));
    let published = get("/machines/verne").await.json;
    assert_eq!(serde_json::from_str::<Value>(&printed.out).unwrap(), published["definition"]);
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("my.json");
    std::fs::write(&file, &printed.out).unwrap();
    assert_eq!(verne(&format!("machine {}", file.display())).unwrap(), printed.out);
    let by_file = json_of(&format!("fk --rho 674,685,250 --machine {}", file.display()));
    assert_eq!(by_file, json_of("fk --rho 674,685,250"));
    std::fs::write(&file, printed.out.replacen("\"stroke\"", "\"strike\"", 1)).unwrap();
    assert!(verne(&format!("machine {}", file.display())).unwrap_err().contains("strike"));
    assert!(verne("machine nautilus").unwrap_err().contains("--machine"));
}

#[test]
fn keys_are_appended_to_their_file() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("keys.toml");
    let new = |name: &str| run(&format!("key new --name {name} --role read --keys {}", file.display()));
    let text = || std::fs::read_to_string(&file).unwrap_or_default();
    for (count, name) in [(1, "cam"), (2, "planner"), (3, "cam")] {
        let ran = new(name);
        assert_eq!((ran.status, ran.out.as_str()), (Ok(0), ""));
        assert!(ran.err.starts_with("verne_") && !text().contains(ran.err.trim()), "{}", text());
        assert_eq!(text().matches("[[key]]\n").count(), count);
    }
    std::fs::write(&file, text().trim_end()).unwrap();
    assert_eq!(new("last").status, Ok(0));
    assert!(text().contains("\"\n\n[[key]]\nname = \"last\""), "{}", text());
    let damaged = text().replacen("role", "rule", 1);
    std::fs::write(&file, &damaged).unwrap();
    let refused = new("none");
    assert!(refused.status.unwrap_err().contains("keys.toml: key 1 (cam)") && refused.err.is_empty());
    assert_eq!(text(), damaged);
}

const LIST: &[u8] = b"HTTP/1.1 200 OK\r\ncontent-length: 23\r\n\r\n{\"jobs\":[],\"next\":null}";
const REFUSED: &[u8] =
    b"HTTP/1.1 404 Not Found\r\ncontent-length: 28\r\n\r\n{\"detail\":\"There is no job\"}";

#[test]
fn jobs_of_a_service_are_listed_and_cancelled() {
    let (address, request) = answering(LIST);
    let listed =
        verne(&format!("jobs list --url http://{address}/base/ --state running --after a&b")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&listed).unwrap(), json!({"jobs": [], "next": null}));
    let request = request.join().unwrap().to_lowercase();
    assert!(
        request.starts_with("get /base/jobs?limit=50&state=running&after=a%26b http/1.1\r\n"),
        "{request}"
    );
    assert!(!request.contains("authorization"), "{request}");
    let id = "0".repeat(64);
    let (address, request) = answering(REFUSED);
    let error = verne(&format!("jobs cancel {id} --key verne_1 --url http://{address}")).unwrap_err();
    assert!(error.ends_with(": 404 Not Found: There is no job"), "{error}");
    let request = request.join().unwrap();
    assert!(request.starts_with(&format!("DELETE /jobs/{id} HTTP/1.1\r\n")), "{request}");
    assert!(request.to_lowercase().contains("authorization: bearer verne_1\r\n"), "{request}");
    let unused = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    for (line, expected) in [
        (format!("jobs list --url http://{unused}"), "/jobs?limit=50: "),
        ("jobs list --url ftp://here".to_owned(), "http://"),
        (format!("jobs cancel {} --url http://{unused}", "0".repeat(63)), "64 lowercase hexadecimal digits"),
    ] {
        let error = verne(&line).unwrap_err();
        assert!(error.contains(expected), "{line}: {error}");
    }
}

#[tokio::test]
async fn a_dexterity_map_is_that_of_the_service() {
    let directory = tempfile::tempdir().unwrap();
    let line = "dexterity --phi1 0,20 --tool-length 50 --cell 200 -o DIR/map.stl --set dexterous --cells DIR/cells.csv";
    let summary = json_of(&line.replace("DIR", directory.path().to_str().unwrap()));
    let body = json!({"phi1": {"from": 0, "to": 20}, "tool_length": 50, "cell": 200});
    assert_eq!(summary, post("/workspace/dexterity", body).await.json);
    let stl = std::fs::read(directory.path().join("map.stl")).unwrap();
    assert_eq!(stl.len() as u64, 84 + 50 * summary["dexterous"]["triangles"].as_u64().unwrap());
    let cells = std::fs::read_to_string(directory.path().join("cells.csv")).unwrap();
    assert!(cells.lines().count() as u64 > summary["reached"].as_u64().unwrap(), "{cells}");
    for (line, expected) in [
        ("dexterity", "--phi1"),
        ("dexterity --phi1 5", "two numbers"),
        ("dexterity --phi1 20,0", "--phi1: must run"),
        ("dexterity --phi1 0,1 --cell 0", "--cell: "),
        ("dexterity --phi1 0,1 -o map.obj", "must end in .glb"),
        ("dexterity --phi1 0,1 --cells cells.txt", "must end in .json"),
        ("dexterity --phi1 0,1 -o a.json --cells ./a.json", "would overwrite --output"),
    ] {
        let error = verne(line).unwrap_err();
        assert!(error.contains(expected), "{line}: {error}");
    }
}

#[tokio::test]
async fn an_error_budget_is_that_of_the_service() {
    let tolerances = r#"{"L1":0.02,"tilt_zero":0.001}"#;
    let body = json!({"tool_length": 50, "parameter_tolerances": {"L1": 0.02, "tilt_zero": 0.001},
                      "poses": [[100, 50, 150, 10, 20]]});
    let line = format!(
        "error-budget --x 100 --y 50 --z 150 --phi1 10 --phi2 20 --tool-length 50 --parameter-tolerances {tolerances}"
    );
    assert_eq!(json_of(&line), post("/error-budget", body).await.json);
    let axis = line.replace("--phi1 10 --phi2 20", "--axis 0,0,1");
    assert_eq!(json_of(&axis)["status"], json!(["ok"]));
    for (line, expected) in [
        ("error-budget --x 0 --y 0 --z 0", "--parameter-tolerances"),
        ("error-budget --x 0 --y 0 --z 0 --parameter-tolerances {}", "--parameter-tolerances: must have"),
        ("error-budget --x 0 --y 0 --z 0 --parameter-tolerances {\"D1\":1}", "unknown field"),
        ("error-budget --frame tool --x 0 --y 0 --z 0 --phi1 3 --parameter-tolerances {\"L1\":1}", "invalid"),
    ] {
        match verne(line) {
            Err(error) => assert!(error.contains(expected), "{line}: {error}"),
            Ok(answer) => assert!(answer.contains(expected), "{line}: {answer}"),
        }
    }
}

#[tokio::test]
async fn an_atlas_is_that_of_the_service() {
    let atlas = json_of("atlas --space joints --u-min -300 --tolerance 10");
    assert_eq!(atlas, get("/atlas?space=joints&u_min=-300&tolerance=10").await.json);
    let directory = tempfile::tempdir().unwrap();
    for (name, beginning) in [("a.svg", "<svg"), ("a.dxf", "999"), ("a.json", "{")] {
        let file = directory.path().join(name);
        assert_eq!(verne(&format!("atlas --tolerance 20 -o {}", file.display())).unwrap(), "");
        assert!(std::fs::read_to_string(&file).unwrap().starts_with(beginning), "{name}");
    }
    let error = verne("atlas --u-min 2000 --space platform").unwrap_err();
    assert!(error.contains("--u-min"), "{error}");
    assert!(verne("atlas -o atlas.png").unwrap_err().contains(".json, .svg or .dxf"));
}

#[tokio::test]
async fn an_error_map_is_that_of_the_service() {
    let directory = tempfile::tempdir().unwrap();
    let line = "error-map --kind part --tool-length 50 --cell 200 --tolerance 20 --parameter-tolerances {\"L1\":0.02} \
                -o DIR/map.ply --error axis_rms --cells DIR/cells.csv";
    let summary = json_of(&line.replace("DIR", directory.path().to_str().unwrap()));
    let body = json!({"kind": "part", "tool_length": 50, "cell": 200, "tolerance": 20,
                      "parameter_tolerances": {"L1": 0.02}});
    assert_eq!(summary, post("/workspace/error-budget", body).await.json);
    assert!(std::fs::read(directory.path().join("map.ply")).unwrap().starts_with(b"ply"));
    let cells = std::fs::read_to_string(directory.path().join("cells.csv")).unwrap();
    assert_eq!(cells.lines().count() as u64, 1 + summary["inside"].as_u64().unwrap(), "{cells}");
    let error = verne("error-map --parameter-tolerances {\"L1\":0.02} --cell 0").unwrap_err();
    assert!(error.contains("--cell: "), "{error}");
}

#[test]
fn shells_and_manual_pages_know_every_command() {
    for (shell, beginning) in
        [("bash", "_verne()"), ("zsh", "#compdef verne"), ("fish", "#"), ("powershell", "\nusing namespace")]
    {
        let script = verne(&format!("completions {shell}")).unwrap();
        assert!(script.starts_with(beginning), "{shell}");
        assert!(script.contains("toolpath") && script.contains("tool-length"), "{shell}");
    }
    assert!(verne("completions cmd").is_err());
    assert!(verne("man").unwrap().contains("verne\\-ik(1)"));
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(verne(&format!("man {}/man1", directory.path().display())).unwrap(), "");
    let page = |name: &str| std::fs::read_to_string(directory.path().join("man1").join(name)).unwrap();
    assert!(page("verne.1").contains("verne\\-serve(1)"));
    assert!(
        page("verne-serve.1").contains("\\-\\-max\\-rows") && page("verne-key-new.1").contains("\\-\\-role")
    );
}

#[test]
fn the_front_page_lists_commands_and_serve_has_sections() {
    let help = |line: &str| verne(line).unwrap_err();
    let front = help("--help");
    assert!(front.contains("  toolpath ") && !front.contains("--max-rows"), "{front}");
    let serve = help("serve --help");
    let sections: Vec<_> =
        serve.lines().filter(|line| line.ends_with(':') && !line.starts_with(' ')).collect();
    let expected = [
        "Options:",
        "Addresses, origins and TLS:",
        "Limits of requests:",
        "Jobs and results:",
        "Keys and rates:",
        "Log and traces:",
        "Several processes:",
    ];
    assert_eq!(sections, expected);
}

#[test]
fn pretty_json_has_line_breaks() {
    let (plain, pretty) = ("ik --x 0 --y 0 --z 400", "ik --x 0 --y 0 --z 400 --pretty");
    assert_eq!(json_of(plain), json_of(pretty));
    assert_eq!(verne(plain).unwrap().lines().count(), 1);
    assert!(verne(pretty).unwrap().starts_with("{\n  \"machine\": {\n"));
}

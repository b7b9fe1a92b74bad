//! `verne calibrate`: the answer of the HTTP service, the machine in a file, and files that cannot be used.

use axum::body::Body;
use axum::http::{Request, header};
use serde_json::{Value, json};

use super::{Terminal, json as json_of, run, run_on, verne};
use crate::http::{post, send};

const MEASUREMENTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/measurements.csv");

/// Runs a command in a directory that contains `rows.csv` with this text; `DIR` in the command stands for its path.
fn in_directory(rows: &str, line: &str) -> (super::Ran, tempfile::TempDir) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("rows.csv"), rows).unwrap();
    (run(&line.replace("DIR", directory.path().to_str().unwrap())), directory)
}

#[tokio::test]
async fn the_command_answers_as_http_does() {
    let rows = std::fs::read_to_string(MEASUREMENTS).unwrap();
    let uri = "/machines/calibration?tool_length=100&loss=huber&next=2&fixed=R2,r4";
    let request = Request::post(uri).header(header::CONTENT_TYPE, "text/csv").body(Body::from(rows));
    let expected = send(request.unwrap()).await.json;
    let line = format!("calibrate {MEASUREMENTS} --tool-length 100 --loss huber --next 2 --fixed R2,r4");
    assert_eq!(json_of(&line), expected);
}

#[tokio::test]
async fn the_machine_is_a_file_for_every_command() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("calibrated.json");
    let line = format!("calibrate {MEASUREMENTS} --tool-length 100 --loss huber");
    let ran = run(&format!("{line} -o {}", file.display()));
    let answer: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((ran.status, &answer["outliers"][0]["measurement"]), (Ok(0), &json!(17)));
    let written: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(written, answer["machine"]);
    assert_eq!(json_of(&format!("{line} -o -")), written);
    assert_eq!(json_of(&format!("machine {}", file.display())), written);
    let joints = json!({"joints": {"rho": [500, 480, 520]}, "machine": written});
    let by_http = post("/fk", joints).await.json;
    assert_eq!(json_of(&format!("fk --rho 500,480,520 --machine {}", file.display())), by_http);
    assert_eq!(by_http["machine"], json!({"name": "verne-calibrated", "hash": answer["hash"]}));
}

#[test]
fn a_terminal_gets_tables() {
    let line = format!("calibrate {MEASUREMENTS} --tool-length 100 --loss huber");
    let text = run_on(&line, Some(Terminal { width: 100, colours: false })).out;
    for part in ["calibrated with 40 measurements", "13 of 13", "tool_length", "1 outlier", "Measure next"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn faults_name_the_flag_the_column_or_the_line_and_leave_no_file() {
    let rows = "rho1,rho2,rho3,x,y,z\n500,500,500,0,0,1400\n450,480,520,10,20,1380\n";
    let unreached = format!("{rows}500,5000,500,0,0,1400\n");
    let shuffled =
        (0..12).map(|i| format!("{},{},{},{},300,{}\n", 400 + i, 450 - i, 420, -40 * i, 900 * (i % 2)));
    let shuffled = format!("rho1,rho2,rho3,x,y,z\n{}", shuffled.collect::<String>());
    for (text, options, expected) in [
        (rows, "--kind sphere", "--kind"),
        (rows, "--fixed D1", "--fixed"),
        (rows, "--fixed da", "--fixed 0: kind `tips` does not depend on it"),
        (rows, "--sigma 0", "--sigma: "),
        (rows, "--sigma nan", "--sigma: "),
        (rows, "--tool-length nan", "--tool-length: "),
        (rows, "--bounds {\"L1\":[1,2]}", "--bounds L1: "),
        (rows, "--machine none", "--machine: "),
        (rows, "-o DIR/./rows.csv", "would overwrite the measurements"),
        (rows, "--kind ballbar", "cannot be used\n  column length"),
        ("rho1,rho2\n1,2\n", "", "column rho3"),
        ("rho1,rho2,rho3,x,y,z\n", "", "there is no row"),
        (&rows.replace("1380", "nan"), "", "line 3: z is not a number"),
        (&unreached, "", "line 4: the machine at the start cannot stand there"),
        (&shuffled, "", "No machine was found"),
    ] {
        let output = if options.starts_with("-o") { "" } else { "-o DIR/out.json" };
        let (ran, directory) = in_directory(text, &format!("calibrate DIR/rows.csv {output} {options}"));
        let message = ran.status.unwrap_err();
        assert!(message.contains(expected) && ran.out.is_empty(), "{options}: {message}");
        assert!(!directory.path().join("out.json").exists(), "{options}");
    }
    assert!(verne("calibrate nowhere.csv").unwrap_err().contains("nowhere.csv"));
    assert!(verne("calibrate rows.txt").unwrap_err().contains(".csv, .ndjson, .jsonl or .arrow"));
}

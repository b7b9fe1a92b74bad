//! Answers on a terminal: tables and words, with the numbers of the JSON.

use serde_json::Value;
use verne_service::Terminal;

use super::{Ran, answering, json, run_on, verne};

const WIDE: Terminal = Terminal { width: 120, colours: false };

fn on_terminal(line: &str) -> String {
    let Ran { status, out, .. } = run_on(line, Some(WIDE));
    assert!(status.is_ok(), "{line}: {status:?}");
    assert!(!out.starts_with('{') && !out.contains('\u{1b}'), "{out}");
    out
}

/// The line that begins with a word, as its words.
fn words<'a>(text: &'a str, first: &str) -> Vec<&'a str> {
    let lines = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    lines.into_iter().find(|words| words.first() == Some(&first)).unwrap_or_default()
}

fn rounded(value: &Value) -> String {
    format!("{:.3}", value.as_f64().unwrap())
}

#[test]
fn solutions_are_the_rows_of_a_table() {
    let line = "ik --x 100 --y 50 --z 300";
    let text = on_terminal(line);
    assert!(text.starts_with("verne: 1 solution\n"), "{text}");
    let solution = &json(line)["solutions"][0];
    let joints = &solution["joints"];
    let numbers: Vec<_> = [&joints["rho"][0], &joints["rho"][1], &joints["rho"][2], &joints["theta1"]]
        .map(rounded)
        .into_iter()
        .collect();
    assert_eq!(words(&text, "1")[1..5], numbers);
    assert_eq!(words(&text, "1")[6], "feasible");
    let worst = solution["margins"]["worst"]["element"].as_str().unwrap();
    assert_eq!(words(&text, "1")[7], worst);
    assert!(text.contains("Not checked: table, part, fixtures."), "{text}");
    let line = "fk --rho 674,685,250 --solutions all";
    let solutions = json(line)["solutions"].as_array().unwrap().len();
    assert!(on_terminal(line).starts_with(&format!("verne: {solutions} solutions\n")));
}

#[test]
fn proofs_are_a_column_and_a_sentence() {
    let text = on_terminal("ik --x 100 --y 50 --z 300 --phi2 0 --certified");
    assert!(text.contains("It is proved that there are no other solutions."), "{text}");
    assert!(text.contains("proof") && text.contains("within ") && text.contains("e-1"), "{text}");
    let free = on_terminal("ik --x 100 --y 50 --z 300 --certified");
    assert!(free.contains("It is not proved that there are no other solutions: phi2 is free"), "{free}");
    let plain = on_terminal("ik --x 100 --y 50 --z 300 --phi2 0");
    assert!(!plain.contains("proof") && !plain.contains("proved"), "{plain}");
    let certified = json("fk --rho 674,685,250 --solutions all --certified");
    assert_eq!(certified["completeness"]["complete"], true);
    assert!(verne("ik --batch poses.csv --certified").unwrap_err().contains("--certified"));
}

#[test]
fn a_narrow_terminal_has_a_line_for_each_field() {
    let narrow = Terminal { width: 40, colours: false };
    let text = run_on("ik --x 100 --y 50 --z 300", Some(narrow)).out;
    let usual = run_on("ik --x 100 --y 50 --z 300", Some(Terminal { width: 80, ..narrow })).out;
    assert_eq!(usual.lines().count(), 5, "{usual}");
    assert!(text.contains("\n  rho1         449.434\n  rho2         586.556\n"), "{text}");
}

#[test]
fn an_answer_without_solutions_says_why() {
    let line = "ik --x 5000 --y 50 --z 300";
    let ran = run_on(line, Some(WIDE));
    assert_eq!(ran.status, Ok(3));
    assert!(ran.out.starts_with("verne: no solution\n"), "{}", ran.out);
    assert!(ran.out.contains("slider") || ran.out.contains("leg"), "{}", ran.out);
}

#[test]
fn json_and_pretty_print_json_on_a_terminal() {
    let line = "ik --x 100 --y 50 --z 300";
    for flag in ["--json", "--pretty"] {
        let out = run_on(&format!("{line} {flag}"), Some(WIDE)).out;
        assert!(out.starts_with("{\n  \"machine\": {\n"), "{out}");
        assert_eq!(serde_json::from_str::<Value>(&out).unwrap(), json(line));
    }
    assert_eq!(run_on("machine --json", Some(WIDE)).out, run_on("machine", None).out);
}

#[test]
fn an_atlas_is_a_table_of_areas() {
    let line = "atlas --space joints --tolerance 10";
    let text = on_terminal(line);
    assert!(text.starts_with("verne: forward solutions\n"), "{text}");
    let atlas = json(line);
    let area = |solutions: u64| -> f64 {
        let regions = atlas["regions"].as_array().unwrap().iter();
        let equal = regions.filter(|region| region["solutions"] == solutions);
        equal.map(|region| region["area"].as_f64().unwrap()).sum()
    };
    for solutions in [4, 6] {
        assert_eq!(words(&text, &solutions.to_string())[2], format!("{:.3}", area(solutions)), "{text}");
    }
}

#[test]
fn workspaces_and_machines_are_names_with_values() {
    let line = "workspace --kind part --tool-length 50 --tolerance 50";
    let (text, summary) = (on_terminal(line), json(line));
    assert!(text.starts_with("verne: workspace of part positions in the part frame\n"), "{text}");
    let error = rounded(&summary["volume_error"]);
    assert_eq!(words(&text, "volume"), ["volume", &*rounded(&summary["volume"]), "±", &*error, "mm³"]);
    assert_eq!(words(&text, "id")[1], summary["id"]);
    let slice = on_terminal(&format!("{line} --slice 300"));
    assert!(slice.starts_with("Slice at z = 300 mm in the part frame\n"), "{slice}");
    let map = on_terminal("dexterity --phi1 0,20 --tool-length 50 --cell 200");
    assert!(map.contains("\nreachable\n  volume") && map.contains("\ngrid\n  points"), "{map}");
    let budget = on_terminal(
        "error-budget --x 100 --y 50 --z 150 --tool-length 50 --parameter-tolerances {\"L1\":0.02,\"tilt_zero\":0.001}",
    );
    assert!(budget.starts_with("verne: error budget\n") && budget.contains("\ntool end\n  rms"), "{budget}");
    assert!(
        budget.contains("L1") && budget.contains("0.02000 mm") && budget.contains("0.001000 deg"),
        "{budget}"
    );
    let line = "error-map --kind tool --cell 200 --tolerance 20 --parameter-tolerances {\"L1\":0.02}";
    let map = on_terminal(line);
    assert!(map.contains("\n  tip_worst") && map.contains("the largest at"), "{map}");
    let machine = on_terminal("machine");
    let definition = json("machine");
    let number = |value: &Value| value.as_f64().unwrap().to_string();
    assert_eq!(words(&machine, "L1")[1], number(&definition["geometry"]["L1"]));
    let stroke = &definition["limits"]["stroke"][1];
    assert_eq!(words(&machine, "stroke.2")[1..], [&*number(&stroke[0]), "to", &*number(&stroke[1])]);
}

const JOBS: &[u8] =
    b"HTTP/1.1 200 OK\r\ncontent-length: 199\r\n\r\n{\"jobs\":[{\"id\":\"1f2e\",\"kind\":\"workspace\",\
    \"state\":\"running\",\"progress\":0.257,\"machine\":{\"name\":\"\\u001b[31mmy\",\"hash\":\"\"},\
    \"created\":\"2026-01-02T03:04:05.678Z\",\"result\":null,\"error\":null}],\"next\":\"abc\"}";

#[test]
fn jobs_are_the_rows_of_a_table() {
    let (address, _) = answering(JOBS);
    let text = on_terminal(&format!("jobs list --url http://{address}"));
    assert!(text.starts_with("1 job\n") && text.ends_with("Older jobs: --after abc\n"), "{text}");
    let row = words(&text, "running");
    // The name of a machine comes from another user, and may not control the terminal.
    let expected = ["running", "26", "%", "workspace", "\\u{1b}[31mmy", "2026-01-02", "03:04:05", "1f2e"];
    assert_eq!(row, expected);
}

#[test]
fn the_summary_of_a_tool_path_takes_the_place_of_the_report() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("part.csv");
    std::fs::write(&file, "x,y,z\n-150,0,300\n150,0,300\n").unwrap();
    let line = format!("toolpath {} --tool-length 100", file.display());
    let ran = run_on(&line, Some(WIDE));
    assert_eq!((ran.status, ran.out.as_str()), (Ok(0), ""));
    assert!(ran.err.starts_with("The machine can run the program: "), "{}", ran.err);
    let report = run_on(&format!("{line} --json"), Some(WIDE)).out;
    assert_eq!(serde_json::from_str::<Value>(&report).unwrap(), json(&line));
}

//! `--batch`: rows of files and pipes, with the answers of the HTTP service.

use std::path::Path;

use axum::body::Body;
use axum::http::{Request, header};

use super::{Ran, run};
use crate::http::send;

/// Four poses: reachable, beyond a slider's end, unreadable, out of reach.
const POSES: &str =
    "id,x,y,z,phi1,phi2\nA,0,0,400,0,0\n\nB,0,0,900,0,0\n\"C\nD\",0,zero,400,0,0\nE,600,0,400,0,0\n";

/// Runs a command in a directory that contains `rows.csv` with this text; `DIR` in the command stands for its path.
fn in_directory(rows: &str, line: &str) -> (Ran, tempfile::TempDir) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("rows.csv"), rows).unwrap();
    (run(&line.replace("DIR", directory.path().to_str().unwrap())), directory)
}

fn text(directory: &Path, name: &str) -> String {
    String::from_utf8(std::fs::read(directory.join(name)).unwrap()).unwrap()
}

#[tokio::test]
async fn rows_are_answered_as_http_does() {
    let joints = "rho1,rho2,rho3,theta1,theta2\n674,685,250,0,0\n674,-5,250,0,0\n";
    let points = "z,name,x,y\n1200,inside,0,0\n0,outside,0,0\n?,invalid,0,0\n";
    for (line, uri, rows, status) in [
        ("ik --tool-length 50", "/ik/batch?tool_length=50", POSES, 3),
        ("ik --tool-length 50 --continuous", "/ik/batch?tool_length=50&continuous=true", POSES, 3),
        ("ik --frame platform", "/ik/batch?frame=platform", "x,y,z\n-240,-86,1000\n", 0),
        ("fk --orientation vector", "/fk/batch?orientation=vector", joints, 3),
        ("contains", "/workspace/contains?", points, 3),
        (
            "contains --kind tool --tool-length 9",
            "/workspace/contains?kind=tool&tool_length=9",
            "x,y,z\n0,0,0\n",
            0,
        ),
    ] {
        let (ran, directory) = in_directory(rows, &format!("{line} --batch DIR/rows.csv"));
        let request = Request::post(uri).header(header::CONTENT_TYPE, "text/csv").body(Body::from(rows));
        let answered = String::from_utf8(send(request.unwrap()).await.bytes).unwrap();
        assert_eq!(ran.out, answered, "{line}");
        assert_eq!(ran.status, Ok(status), "{line}: {}", ran.err);
        drop(directory);
    }
}

#[test]
fn the_summary_says_which_lines_have_no_answer_and_why() {
    let (ran, _) = in_directory(POSES, "ik --tool-length 50 --batch DIR/rows.csv");
    let lines: Vec<_> = ran.err.lines().collect();
    assert_eq!(lines[0], "4 rows: 1 ok, 1 unreachable, 1 infeasible, 1 invalid.");
    assert!(
        lines[1].starts_with("  line 4: slider ") && lines[1].ends_with(" end of its stroke"),
        "{}",
        ran.err
    );
    assert_eq!(lines[2], "  line 6: y is not a number");
    assert!(lines[3].starts_with("  line 7: leg ") && lines[3].ends_with(" mm too short"), "{}", ran.err);
    let many = format!("x,y,z\n{}", "0,0,none\n".repeat(12));
    let (ran, _) = in_directory(&many, "contains --batch DIR/rows.csv");
    assert!(ran.err.starts_with("12 rows: 12 invalid.\n  line 2: z is not a number\n"), "{}", ran.err);
    assert!(ran.err.ends_with("  line 11: z is not a number\n  and 2 more rows.\n"), "{}", ran.err);
}

/// What one format says, every other says.
#[test]
fn the_extension_states_the_format() {
    let ok = "id,x,y,z,phi1,phi2\nA,0,0,400,0,0\nB,10,0,390,5,30\n";
    let (ran, directory) = in_directory(ok, "ik --batch DIR/rows.csv");
    let (expected, path) = (ran.out, directory.path());
    let convert = |from: &str, to: &str| {
        let ran = run(&format!("ik --batch {0}/{from} -o {0}/{to}", path.display()));
        assert_eq!((ran.status, ran.out), (Ok(0), String::new()), "{from} to {to}: {}", ran.err);
    };
    for name in ["out.arrow", "out.ndjson", "out.jsonl", "OUT.CSV"] {
        convert("rows.csv", name);
    }
    assert_eq!(text(path, "OUT.CSV"), expected);
    assert_eq!(text(path, "out.ndjson"), text(path, "out.jsonl"));
    assert!(text(path, "out.jsonl").starts_with("{\"id\":\"A\",\"rho1\":"));
    // Joints are rows of the forward problem. Its status replaces that of the inverse problem.
    let poses = ["out.arrow", "out.ndjson", "OUT.CSV"].map(|name| {
        let ran = run(&format!("fk --batch {}/{name} --format csv", path.display()));
        assert_eq!(ran.status, Ok(0), "{name}: {}", ran.err);
        ran.out
    });
    assert_eq!(poses[0].lines().next().unwrap().matches("status").count(), 1, "{}", poses[0]);
    assert!(poses[0].lines().nth(1).unwrap().starts_with("A,"), "{}", poses[0]);
    assert_eq!([&poses[1], &poses[2]], [&poses[0]; 2]);
}

#[test]
fn faulty_commands_are_refused_and_leave_no_file() {
    let rows = "x,y,z,phi1,phi2\n0,0,400,0,0\n";
    let unreadable = format!("{rows}\"{}", "1".repeat(400_000));
    for (rows, line, expected) in [
        (rows, "ik --batch DIR/rows.csv -o DIR/./rows.csv", "would overwrite the rows"),
        (rows, "ik --batch DIR/rows.csv -o DIR/out.txt", "--output "),
        (rows, "ik --batch DIR/rows.json", "must end in .csv, .ndjson, .jsonl or .arrow"),
        (rows, "ik --batch DIR/none.csv", "none.csv: "),
        (rows, "ik --batch DIR/rows.csv -o DIR/out.csv --format csv", "--format"),
        (rows, "ik --batch DIR/rows.csv --format json", "--format"),
        (rows, "ik --batch DIR/rows.csv -o DIR/out.csv --tool-length -1", "--tool-length: "),
        (
            rows,
            "ik --batch DIR/rows.csv --start {\"rho\":[400,450,450],\"theta1\":0,\"theta2\":0}",
            "--start: is allowed only",
        ),
        (rows, "ik --batch DIR/rows.csv --machine none", "--machine: "),
        (rows, "ik --batch DIR/rows.csv -o DIR/out.csv --frame tool", "column phi1: "),
        (rows, "fk --batch DIR/rows.csv -o DIR/out.csv", "rows.csv cannot be used\n  column rho1: "),
        (rows, "ik --batch DIR/rows.csv --x 1", "--x"),
        (rows, "ik --batch DIR/rows.csv --solutions all", "--solutions"),
        (rows, "ik --x 1 --y 2 --z 3 --continuous", "--continuous"),
        (rows, "ik --x 1 --y 2 --z 3 -o DIR/out.csv", "--output"),
        (rows, "ik --continuous", "--batch"),
        (rows, "contains", "--batch"),
        ("1,2,3\n", "contains --batch DIR/rows.csv", "must name the columns"),
        (&unreadable, "ik --batch DIR/rows.csv -o DIR/out.csv", "row 3 of the CSV text is longer"),
    ] {
        let (ran, directory) = in_directory(rows, line);
        let message = ran.status.unwrap_err();
        assert!(message.contains(expected) && ran.out.is_empty(), "{line}: {message}");
        assert!(!directory.path().join("out.csv").exists(), "{line}");
        assert_eq!(text(directory.path(), "rows.csv"), rows, "{line}");
    }
}

#[test]
fn a_question_without_a_solution_has_the_exit_status_3() {
    for (line, status) in [
        ("ik --frame platform --x 0 --y 0 --z 2000 --solutions feasible", 3),
        ("ik --x 600 --y 0 --z 400", 3),
        ("ik --x 0 --y 0 --z 400", 0),
        ("fk --rho 0,9000,0", 3),
        ("fk --rho 674,685,250", 0),
    ] {
        assert_eq!(run(line).status, Ok(status), "{line}");
    }
}

//! The command line, as its users type it.

mod batch;
mod calibrate;
mod commands;
mod terminal;

use std::ffi::OsString;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener};
use std::process::ExitCode;
use std::thread::{self, JoinHandle};

use clap::Parser;
use serde_json::Value;
use verne_service::{Cli, Terminal};

use crate::http::get;

pub(crate) fn verne(line: &str) -> Result<String, String> {
    let words = std::iter::once("verne").chain(line.split_whitespace()).map(OsString::from);
    let mut out = Vec::new();
    Cli::read(words).map_err(|error| error.to_string())?.run(&mut out, &mut std::io::sink(), None)?;
    Ok(String::from_utf8(out).unwrap())
}

/// A command that has ended.
struct Ran {
    /// The exit status, or the message of the error.
    status: Result<u8, String>,
    out: String,
    err: String,
}

fn run(line: &str) -> Ran {
    run_on(line, None)
}

/// Runs a command whose standard output is this terminal, or a pipe.
fn run_on(line: &str, terminal: Option<Terminal>) -> Ran {
    let words = std::iter::once("verne").chain(line.split_whitespace()).map(OsString::from);
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let status = match Cli::read(words) {
        Ok(cli) => cli.run(&mut out, &mut err, terminal).map(|status| {
            let known = (0..=u8::MAX).find(|code| ExitCode::from(*code) == status);
            known.unwrap()
        }),
        Err(error) => Err(error.to_string()),
    };
    Ran { status, out: String::from_utf8(out).unwrap(), err: String::from_utf8(err).unwrap() }
}

fn json(line: &str) -> Value {
    serde_json::from_str(&verne(line).unwrap()).unwrap()
}

#[tokio::test]
async fn the_command_line_answers_as_http_does() {
    for (line, uri) in [
        ("fk --rho 674,685,250 --solutions all", "/fk?rho=674,685,250&solutions=all"),
        ("fk --rho=674,685,250 --theta1 -10 --theta2 -20.5", "/fk?rho=674,685,250&theta1=-10&theta2=-20.5"),
        (
            "ik --frame platform --x -240 --y -86 --z 1000 --solutions all",
            "/ik?frame=platform&x=-240&y=-86&z=1000&solutions=all",
        ),
        (
            "ik --x -100 --y 50 --z 150 --axis -0.1,-0.5,0.8 --tool-length 50 --near-joints -1,2,3",
            "/ik?x=-100&y=50&z=150&axis=-0.1,-0.5,0.8&tool_length=50&near_joints=-1,2,3",
        ),
    ] {
        assert_eq!(json(line), get(uri).await.json, "{line}");
    }
}

#[test]
fn a_machine_can_be_a_file() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/machine-verne.json");
    let by_file = json(&format!("fk --rho 674,685,250 --machine {file}"));
    assert_eq!(by_file, json("fk --rho 674,685,250"));
}

#[test]
fn errors_name_the_flag() {
    for (line, expected) in [
        ("fk --rho 1,2", "expected 3 numbers"),
        ("fk --rho 1,2,nan", "--rho 2:"),
        ("fk --rho 1,2,3 --tool-length -5", "--tool-length:"),
        ("ik --frame tool --x 1 --y 2 --z 3 --phi1 4", "--phi1:"),
        ("ik --frame platform --x 1 --y 2 --z 3 --machine nautilus", "--machine:"),
        ("key new --role read --name 10.0.0.1", "--name"),
        ("fk --rho 1,2,3 --machine ./nowhere.json", "./nowhere.json"),
        ("fk --rho 1,2,3 --near-joints 1,2,3 --near-pose 1,2,3", "--near"),
    ] {
        let error = verne(line).unwrap_err();
        assert!(error.contains(expected), "{line}: {error}");
    }
}

/// A command line with only the arguments that `--help` shows in its line of usage is valid.
/// Runs `verne toolpath` on a file with this text: the exit status, standard output and standard error.
fn toolpath(text: &str, options: &str) -> (String, String, String) {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("part.cls");
    std::fs::write(&file, text).unwrap();
    let options = options.replace("DIR", directory.path().to_str().unwrap());
    let line = format!("verne toolpath {} {options}", file.display());
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let cli = Cli::read(line.split_whitespace().map(OsString::from)).unwrap();
    let status = match cli.run(&mut out, &mut err, None) {
        Ok(status) => format!("{status:?}"),
        Err(message) => message,
    };
    if let Ok(report) = std::fs::read(directory.path().join("report.json")) {
        out.extend(report);
    }
    (status, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

const LINE: &str = "UNITS/MM\nRAPID\nGOTO/-150,0,300\nFEDRAT/1000,MMPM\nGOTO/150,0,300\n";

#[test]
fn a_tool_path_is_rows_a_report_and_a_verdict_in_words() {
    let (status, out, err) = toolpath(LINE, "--tool-length 100");
    let report: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((status, &report["verdict"]), (format!("{:?}", ExitCode::SUCCESS), &"ok".into()));
    assert!(err.contains("The machine can run the program: "), "{err}");
    let (_, rows, _) = toolpath(LINE, "--tool-length 100 -o -");
    assert_eq!(rows.lines().count() as u64, report["rows"].as_u64().unwrap() + 1);
    assert!(
        rows.starts_with("line,kind,x,y,z,") && rows.lines().last().unwrap().starts_with("5,feed,150,0,300,")
    );
    let beyond = format!("{LINE}GOTO/150,0,900\n");
    let (status, report, err) =
        toolpath(&beyond, "--tool-length 100 -o DIR/rows.json --report DIR/report.json");
    let report: Value = serde_json::from_str(&report).unwrap();
    assert_eq!((status, &report["verdict"]), (format!("{:?}", ExitCode::from(3)), &"fails".into()));
    assert!(err.contains("line 6: slider 2 is 226 mm past the low end of its stroke"), "{err}");
}

#[test]
fn errors_of_a_tool_path_name_the_flag_or_the_line() {
    for (text, options, expected) in [
        (LINE, "--tool-length -1", "--tool-length: "),
        (LINE, "--tool-length 1 --tip-tolerance 0", "--tip-tolerance: "),
        (LINE, "--tool-length 1 -o DIR/rows.txt", "must end in .arrow, .csv"),
        (LINE, "--tool-length 1 -o - --report -", "cannot both"),
        (LINE, "--tool-length 1 --report DIR/./part.cls", "would overwrite the program"),
        (LINE, "--tool-length 1 -o DIR/x.csv --report DIR/x.csv", "would overwrite --output"),
        (LINE, "--tool-length 1 -o DIR/x.ngc --axes X,Y,Z,A,A", "\n  --axes: "),
        ("UNITS/MM\nGOTO/1\n", "--tool-length 1", "line 2, column 1, \"GOTO\""),
        (LINE, "--tool-length 1 --format heidenhain", "Heidenhain"),
        (LINE, "--tool-length 1 --tcp --rotary-sense table", "\n  --tcp: is for the format gcode"),
        (
            LINE,
            "--tool-length 1 -o DIR/x.ngc --rapid-word g1",
            "\n  --rapid-word: g1 needs the duration of rapids",
        ),
    ] {
        let (status, out, _) = toolpath(text, options);
        assert!(status.contains(expected) && out.is_empty(), "{options}: {status}");
    }
}

#[test]
fn the_line_of_usage_shows_all_required_arguments() {
    for command in ["fk", "ik", "key new", "workspace", "openapi"] {
        let help = verne(&format!("{command} --help")).unwrap_err();
        let usage = help.lines().find_map(|line| line.strip_prefix("Usage: verne ")).unwrap();
        let line = usage
            .replace("[OPTIONS]", "")
            .replace("<RHO>", "674,685,250")
            .replace("<X>", "100")
            .replace("<Y>", "-50")
            .replace("<Z>", "300")
            .replace("<NAME>", "cam")
            .replace("<ROLE>", "read");
        assert!(!line.contains('<'), "{usage}");
        assert!(verne(&line).is_ok(), "{line}: {:?}", verne(&line));
    }
}

#[test]
fn serve_is_the_default_command() {
    let without_command = Cli::try_parse_from(["verne", "--listen", "127.0.0.1:0"]);
    assert!(without_command.is_ok());
    assert!(Cli::try_parse_from(["verne", "serve", "--machines", "somewhere"]).is_ok());
    assert!(Cli::try_parse_from(["verne", "serve", "--listen", "nowhere"]).is_err());
}

/// Answers one request with these bytes. Returns the address, and the request.
fn answering(bytes: &'static [u8]) -> (SocketAddr, JoinHandle<String>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let answered = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let mut request = [0; 1024];
        let length = stream.read(&mut request).unwrap();
        stream.write_all(bytes).unwrap();
        String::from_utf8_lossy(&request[..length]).into_owned()
    });
    (address, answered)
}

#[test]
fn health_succeeds_only_for_status_200() {
    let (address, request) = answering(b"HTTP/1.1 200 OK\r\ncontent-length: 0\r\n\r\n");
    assert_eq!(verne(&format!("health --url http://{address}/readyz")), Ok(String::new()));
    assert!(request.join().unwrap().starts_with("GET /readyz HTTP/1.1\r\n"));
    for response in [&b"HTTP/1.1 503 Service Unavailable\r\n\r\n"[..], b"200 by no protocol", b""] {
        let (address, _) = answering(response);
        let error = verne(&format!("health --url http://{address}/readyz")).unwrap_err();
        assert!(error.starts_with(&format!("http://{address}/readyz: ")), "{error}");
    }
    let unused = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    assert!(verne(&format!("health --url http://{unused}/readyz")).is_err());
    assert!(verne("health --url ftp://127.0.0.1/readyz").unwrap_err().contains("http://"));
}

//! The command line.

use std::ffi::OsString;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener};
use std::thread::{self, JoinHandle};

use clap::Parser;
use serde_json::Value;
use verne_service::Cli;

use crate::http::get;

pub(crate) fn verne(line: &str) -> Result<String, String> {
    let words = std::iter::once("verne").chain(line.split_whitespace()).map(OsString::from);
    let mut out = Vec::new();
    Cli::read(words).map_err(|error| error.to_string())?.run(&mut out, &mut std::io::sink(), false)?;
    Ok(String::from_utf8(out).unwrap())
}

fn json(line: &str) -> Value {
    serde_json::from_str(&verne(line).unwrap()).unwrap()
}

#[tokio::test]
async fn commands_print_the_answers_of_http() {
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

/// `--help` shows in its line of usage what a command demands.
#[test]
fn the_arguments_in_the_usage_line_suffice() {
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

/// Answers one question with these bytes; where it listens.
fn answering(bytes: &'static [u8]) -> (SocketAddr, JoinHandle<String>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let answered = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let mut question = [0; 1024];
        let length = stream.read(&mut question).unwrap();
        stream.write_all(bytes).unwrap();
        String::from_utf8_lossy(&question[..length]).into_owned()
    });
    (address, answered)
}

#[test]
fn the_health_command_reports_readyz() {
    let (address, question) = answering(b"HTTP/1.1 200 OK\r\ncontent-length: 0\r\n\r\n");
    assert_eq!(verne(&format!("health --url http://{address}/readyz")), Ok(String::new()));
    assert!(question.join().unwrap().starts_with("GET /readyz HTTP/1.1\r\n"));
    for refusal in [&b"HTTP/1.1 503 Service Unavailable\r\n\r\n"[..], b"200 by no protocol", b""] {
        let (address, _) = answering(refusal);
        let error = verne(&format!("health --url http://{address}/readyz")).unwrap_err();
        assert!(error.starts_with(&format!("http://{address}/readyz: ")), "{error}");
    }
    let nobody = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    assert!(verne(&format!("health --url http://{nobody}/readyz")).is_err());
    assert!(verne("health --url ftp://127.0.0.1/readyz").unwrap_err().contains("http://"));
}

//! Clients that close their sending direction: some wait for the answer, some have disconnected.

use serde_json::{Value, json};
use tokio::io::{AsyncReadExt, AsyncWriteExt};

use super::{Served, in_time, rest, serve};

fn posted(path: &str, version: &str, body: &Value) -> String {
    let body = body.to_string();
    let length = body.len();
    format!(
        "POST {path} HTTP/{version}\r\nHost: localhost\r\nContent-Type: application/json\r\n\
         Content-Length: {length}\r\n\r\n{body}"
    )
}

/// The answer to a client that sends this and closes its direction at once, without interim answers.
async fn answered(served: &Served, request: &str) -> String {
    let mut stream = served.connect().await;
    stream.write_all(request.as_bytes()).await.unwrap();
    stream.shutdown().await.unwrap();
    rest(&mut stream).await.replace("HTTP/1.1 100 Continue\r\n\r\n", "")
}

#[tokio::test]
async fn a_half_closed_client_is_answered() {
    let served = serve("").await;
    for version in ["1.1", "1.0"] {
        for path in ["/livez", "/fk?rho=674,685,250", "/workspace?tolerance=20", "/docs/swagger-ui-bundle.js"]
        {
            let request = format!("GET {path} HTTP/{version}\r\nHost: localhost\r\n\r\n");
            let answer = answered(&served, &request).await;
            assert!(answer.starts_with(&format!("HTTP/{version} 200 OK")), "{path}: {answer}");
            let (head, body) = answer.split_once("\r\n\r\n").unwrap();
            let length = format!("content-length: {}", body.len());
            assert!(head.contains(&length), "{path}: {length}: {head}");
        }
        let question = posted("/workspace", version, &json!({"tolerance": 15}));
        let answer = answered(&served, &question).await;
        assert!(answer.starts_with(&format!("HTTP/{version} 200 OK")), "{answer}");
    }
    served.end().await;
}

#[tokio::test]
async fn an_incomplete_body_is_refused_at_once() {
    let served = serve("--timeout 600").await;
    let request = posted("/fk", "1.1", &json!({"joints": {"rho": [674, 685, 250]}}));
    let answer = answered(&served, request.strip_suffix("}").unwrap()).await;
    assert!(answer.starts_with("HTTP/1.1 400 ") && answer.contains("bad_request"), "{answer}");
    served.end().await;
}

#[tokio::test]
async fn a_half_closed_client_gets_its_job_and_a_disconnected_one_stops_waiting() {
    let served = serve("--wait 20 --job-threads 1").await;
    // Each of minutes.
    let question = |first: u32| {
        let lengths = json!({"from": first, "to": first + 99, "step": 1});
        json!({"kind": "part", "tool_length": lengths, "tolerance": 0.02})
    };
    let state = async |state: &str| {
        let jobs = answered(&served, &format!("GET /jobs?state={state} HTTP/1.0\r\n\r\n")).await;
        let jobs: Value = serde_json::from_str(jobs.split_once("\r\n\r\n").unwrap().1).unwrap();
        jobs["jobs"].as_array().unwrap().len()
    };
    let mut gone = Vec::new();
    for (version, first) in [("1.1", 100), ("1.0", 200)] {
        let mut stream = served.connect().await;
        stream.write_all(posted("/workspace", version, &question(first)).as_bytes()).await.unwrap();
        gone.push(stream);
    }
    let mut waiting = served.connect().await;
    waiting.write_all(posted("/workspace", "1.1", &question(300)).as_bytes()).await.unwrap();
    waiting.shutdown().await.unwrap();
    in_time(async { while state("running").await + state("queued").await < 3 {} }).await;
    drop(gone);
    in_time(async { while state("cancelled").await < 2 {} }).await;
    // It is there while it waits: interim answers come, and the answer at the end of its wait.
    let mut answer = String::new();
    in_time(waiting.read_to_string(&mut answer)).await.unwrap();
    let last = answer.replace("HTTP/1.1 100 Continue\r\n\r\n", "");
    assert!(answer.len() > last.len() && last.starts_with("HTTP/1.1 202 Accepted"), "{answer}");
    served.end().await;
}

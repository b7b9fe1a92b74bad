//! A service in this process, and the checks that every answer must pass.

use std::cell::RefCell;

use axum::Router;
use axum::body::{Body, Bytes};
use axum::http::header::{CONTENT_TYPE, LOCATION};
use axum::http::{HeaderMap, Method, Request, StatusCode};
use clap::{Args, Command, FromArgMatches};
use http_body_util::BodyExt;
use serde_json::{Value, json};
use tokio::runtime::Runtime;
use tower::ServiceExt;
use verne_service::{ServeConfig, Service};

/// The documented answers of a service that is at a limit.
const BUSY: [&str; 2] = ["queue_full", "overloaded"];

thread_local! {
    static CLIENT: RefCell<Option<Client>> = const { RefCell::new(None) };
}

/// A service, and a result that it has stored.
pub(crate) struct Client {
    runtime: Runtime,
    router: Router,
    /// The id of a workspace.
    pub(crate) kept: String,
}

/// An answer.
pub(crate) struct Reply {
    pub(crate) status: StatusCode,
    headers: HeaderMap,
    pub(crate) bytes: Bytes,
}

/// This thread's client.
pub(crate) fn with_client<T>(use_it: impl FnOnce(&Client) -> T) -> T {
    CLIENT.with_borrow_mut(|client| use_it(client.get_or_insert_with(Client::new)))
}

/// A JSON body to a path.
pub(crate) fn post(path: &str, body: impl Into<Body>) -> Request<Body> {
    Request::post(path).header(CONTENT_TYPE, "application/json").body(body.into()).unwrap()
}

impl Client {
    fn new() -> Self {
        let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
        // Long computations become jobs.
        let flags = "--memory-only --wait 0 --job-limit 60 --job-threads 1 --queue 8 --max-rows 200";
        let config =
            ServeConfig::from_arg_matches(&command.get_matches_from(flags.split_whitespace())).unwrap();
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        let router = runtime.block_on(Service::open(&config)).unwrap().router;
        let mut client = Self { runtime, router, kept: String::new() };
        let question = json!({"kind": "part", "tool_length": 50, "tolerance": 50}).to_string();
        let mut request = post("/workspace", question);
        request.headers_mut().insert("prefer", "wait=25".parse().unwrap());
        let summary: Value = serde_json::from_slice(&client.send(request).bytes).unwrap();
        summary["id"].as_str().unwrap().clone_into(&mut client.kept);
        client
    }

    /// Sends a request and checks the answer. Cancels the job if there is one.
    pub(crate) fn ask(&self, request: Request<Body>) -> Reply {
        let reply = self.send(request);
        reply.check();
        if reply.status == StatusCode::ACCEPTED {
            let job = reply.headers[LOCATION].to_str().unwrap();
            let delete = Request::builder().method(Method::DELETE).uri(job).body(Body::empty()).unwrap();
            assert_eq!(self.send(delete).status, StatusCode::OK);
        }
        reply
    }

    fn send(&self, request: Request<Body>) -> Reply {
        self.runtime.block_on(async {
            let (parts, body) = self.router.clone().oneshot(request).await.unwrap().into_parts();
            let bytes = body.collect().await.unwrap().to_bytes();
            Reply { status: parts.status, headers: parts.headers, bytes }
        })
    }
}

impl Reply {
    fn check(&self) {
        let text = self.bytes.escape_ascii();
        let status = self.status;
        if status.is_client_error() || status.is_server_error() {
            assert_eq!(self.headers[CONTENT_TYPE], "application/problem+json", "{status} {text}");
            // The answer to HEAD has no document.
            if self.bytes.is_empty() {
                assert!(status.is_client_error(), "{status}");
                return;
            }
            let problem: Value = serde_json::from_slice(&self.bytes).unwrap();
            let code = problem["code"].as_str().unwrap();
            assert_eq!(problem["status"], status.as_u16(), "{text}");
            assert!(problem["detail"].as_str().is_some_and(|detail| !detail.is_empty()), "{text}");
            assert!(!status.is_server_error() || BUSY.contains(&code), "{status} {text}");
        } else {
            assert!(status.is_success() || status.is_redirection(), "{status} {text}");
        }
    }
}

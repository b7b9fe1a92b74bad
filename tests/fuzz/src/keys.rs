//! Arbitrary text as a key file, which the service reads again while it runs.

use std::cell::RefCell;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use axum::body::Body;
use axum::http::header::AUTHORIZATION;
use axum::http::{Request, StatusCode};
use clap::{Args, Command, FromArgMatches};
use tempfile::TempDir;
use tokio::runtime::Runtime;
use tower::ServiceExt;
use verne_service::{ServeConfig, Service};

use crate::draw::Draw;

/// A key, and its hash in a key file.
const KEY: &str = "verne_1219e10d7fff7b51f1e12f93a9234b31be3a0626921c1ad39841b8f97474f300";
const HASH: &str = "08847a9e3b22d4872107d095e929530b2340e8acb935a0af49ad1b8379129880";

/// The hash of an unknown key.
const OTHER: &str = "00000000000000000000000000000000000000000000000000000000000000ff";

thread_local! {
    static GUARDED: RefCell<Guarded> = RefCell::new(Guarded::new());
}

/// A service that requires keys.
struct Guarded {
    runtime: Runtime,
    service: Service,
    path: PathBuf,
    _place: TempDir,
}

impl Guarded {
    fn new() -> Self {
        let place = TempDir::new().unwrap();
        let path = place.path().join("keys.toml");
        fs::write(&path, format!("[[key]]\nname = \"x\"\nrole = \"read\"\nhash = \"{OTHER}\"\n")).unwrap();
        let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
        let keys = path.to_str().unwrap();
        let flags = ["--memory-only", "--job-threads", "1", "--keys", keys];
        let config = ServeConfig::from_arg_matches(&command.get_matches_from(flags)).unwrap();
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        let service = runtime.block_on(Service::open(&config)).unwrap();
        Self { runtime, service, path, _place: place }
    }

    fn lets_in(&self) -> bool {
        let request = Request::get("/machines").header(AUTHORIZATION, format!("Bearer {KEY}"));
        let request = request.body(Body::empty()).unwrap();
        let answer = self.runtime.block_on(self.service.router.clone().oneshot(request)).unwrap();
        answer.status() != StatusCode::UNAUTHORIZED
    }

    /// Whether the service accepted the file; if not, nothing changes, and the error does not contain a key of the
    /// file.
    fn read(&self, text: &[u8]) -> bool {
        fs::write(&self.path, text).unwrap();
        let before = self.lets_in();
        match self.runtime.block_on(self.service.reload_keys()) {
            Ok(()) => true,
            Err(error) => {
                let error = error.to_string();
                assert!(error.contains("keys.toml") && !error.contains(KEY), "{error}");
                assert_eq!(self.lets_in(), before);
                false
            }
        }
    }
}

/// Bytes as a file, or entries with any values.
pub(crate) fn keys(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    GUARDED.with_borrow(|guarded| {
        if draw.one_in(2) {
            guarded.read(draw.rest());
            return;
        }
        let (mut text, mut knows) = (String::new(), false);
        for _ in 0..draw.below(4) {
            knows |= entry(&mut draw, &mut text);
        }
        if guarded.read(text.as_bytes()) {
            assert_eq!(guarded.lets_in(), knows, "{text}");
        }
    });
}

/// Whether this is the hash of the key.
fn entry(draw: &mut Draw<'_>, text: &mut String) -> bool {
    let own = draw.text();
    let name = draw.pick(&["ada", "bob-1", "c.d_e", "", "1a", &own]);
    let role = draw.pick(&["read", "compute", "admin", "root", &own]);
    let hash = draw.pick(&[HASH, HASH, OTHER, KEY, "", &own]);
    writeln!(text, "[[key]]\nname = {name:?}\nrole = {role:?}\nhash = {hash:?}").unwrap();
    for field in ["rate", "rate_burst"] {
        if draw.one_in(3) {
            writeln!(text, "{field} = {}", draw.numeral(100.0)).unwrap();
        }
    }
    if draw.one_in(8) {
        writeln!(text, "{own:?} = {KEY:?}").unwrap();
    }
    hash == HASH
}

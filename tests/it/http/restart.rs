//! Results and jobs in the data directory survive the process; damaged files do not stop the next one.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use axum::Router;
use axum::http::StatusCode;
use axum::http::header::ETAG;
use serde_json::json;
use tempfile::TempDir;
use verne_service::{ServeConfig, Service};

use super::jobs::{events, job, one_core};
use super::workspace::ask;
use super::{Reply, get_from};

/// Opens a directory; again and again while another service of this process still closes it.
pub(super) async fn open(directory: &Path) -> Service {
    let config = ServeConfig { data: Some(directory.to_owned()), memory_only: false, ..one_core() };
    loop {
        match Service::open(&config).await {
            Ok(service) => return service,
            Err(error) => assert!(error.to_string().contains("in use"), "{error}"),
        }
        tokio::task::yield_now().await;
    }
}

/// Stops a service and lets go of its directory.
pub(super) async fn close(service: Service) {
    service.stop(Duration::from_mins(1)).await;
}

struct Answers {
    summary: Reply,
    glb: Reply,
    stl: Reply,
}

async fn answers(service: &Router) -> Answers {
    let summary = ask(service, json!({"kind": "part", "tool_length": 50, "tolerance": 20})).await;
    assert_eq!(summary.status, StatusCode::OK, "{}", summary.json);
    let mesh = summary.json["links"]["mesh"].as_str().unwrap();
    let glb = get_from(service, mesh, &[]).await;
    let stl = get_from(service, &format!("{mesh}?format=stl"), &[]).await;
    Answers { summary, glb, stl }
}

impl Answers {
    fn assert_same(&self, other: &Self, when: &str) {
        for (ours, theirs) in
            [(&self.summary, &other.summary), (&self.glb, &other.glb), (&self.stl, &other.stl)]
        {
            assert_eq!(ours.bytes, theirs.bytes, "{when}");
            assert_eq!(ours.headers[ETAG], theirs.headers[ETAG], "{when}");
        }
    }
}

#[tokio::test]
async fn jobs_and_results_survive_a_restart() {
    let place = TempDir::new().unwrap();
    let service = open(place.path()).await;
    let before = answers(&service.router).await;
    let id = before.summary.json["id"].as_str().unwrap();
    let ended = events(&service.router, id).await.pop().unwrap();
    close(service).await;

    let service = open(place.path()).await;
    assert_eq!(job(&service.router, id).await, ended);
    assert_eq!(get_from(&service.router, "/jobs", &[]).await.json["jobs"], json!([ended]));
    assert_eq!(events(&service.router, id).await, [ended.clone(), ended], "the change and the end");
    answers(&service.router).await.assert_same(&before, "after a restart");
    let metrics = String::from_utf8(get_from(&service.router, "/metrics", &[]).await.bytes).unwrap();
    assert!(metrics.contains("verne_jobs_started_total 0\n"), "nothing is computed again: {metrics}");
}

fn objects(directory: &Path) -> Vec<PathBuf> {
    let inside = |place: &Path| fs::read_dir(place).unwrap().map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = inside(&directory.join("results/objects"))
        .filter(|place| place.is_dir())
        .flat_map(|place| inside(&place).collect::<Vec<_>>())
        .collect();
    found.sort();
    found
}

fn flipped(mut bytes: Vec<u8>) -> Vec<u8> {
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    bytes
}

type Damage = (&'static str, fn(&Path));

const DAMAGES: [Damage; 6] = [
    ("a flipped bit", |file| fs::write(file, flipped(fs::read(file).unwrap())).unwrap()),
    ("cut short", |file| {
        let bytes = fs::read(file).unwrap();
        fs::write(file, &bytes[..bytes.len() / 2]).unwrap();
    }),
    ("empty", |file| fs::write(file, "").unwrap()),
    ("foreign", |file| fs::write(file, "not an object of this store").unwrap()),
    ("gone", |file| fs::remove_file(file).unwrap()),
    ("a directory", |file| {
        fs::remove_file(file).unwrap();
        fs::create_dir(file).unwrap();
    }),
];

/// The record, the mesh and a file of it: whichever is damaged, the answer is the same, asked for it or for its id.
#[tokio::test]
async fn damaged_results_are_computed_again() {
    let undisturbed = answers(&super::service().await).await;
    let id = undisturbed.summary.json["id"].as_str().unwrap();
    for (damage, harm) in DAMAGES {
        for victim in 0..3 {
            let when = format!("{damage}, object {victim}");
            let place = TempDir::new().unwrap();
            let service = open(place.path()).await;
            let mesh = ask(&service.router, json!({"kind": "part", "tool_length": 50, "tolerance": 20}))
                .await
                .json["links"]["mesh"]
                .clone();
            get_from(&service.router, mesh.as_str().unwrap(), &[]).await;
            close(service).await;
            let files = objects(place.path());
            assert_eq!(files.len(), 3, "record, mesh, GLB");
            harm(&files[victim]);

            let service = open(place.path()).await;
            let kept = get_from(&service.router, &format!("/workspace/{id}"), &[]).await;
            if kept.status == StatusCode::NOT_FOUND {
                kept.assert_problem(404, "workspace_not_found");
            } else {
                assert_eq!(kept.bytes, undisturbed.summary.bytes, "{when}");
            }
            let found = get_from(&service.router, mesh.as_str().unwrap(), &[]).await;
            if found.status != StatusCode::NOT_FOUND {
                assert_eq!(found.bytes, undisturbed.glb.bytes, "{when}");
            }
            answers(&service.router).await.assert_same(&undisturbed, &when);
            close(service).await;
        }
    }
}

#[tokio::test]
async fn a_damaged_jobs_database_is_renamed() {
    let place = TempDir::new().unwrap();
    let service = open(place.path()).await;
    let before = answers(&service.router).await;
    close(service).await;
    let database = place.path().join("jobs/jobs.sqlite3");
    fs::write(&database, "no database").unwrap();
    let service = open(place.path()).await;
    assert_eq!(get_from(&service.router, "/jobs", &[]).await.json["jobs"], json!([]));
    answers(&service.router).await.assert_same(&before, "the results are apart from the jobs");
    assert_eq!(fs::read(place.path().join("jobs/jobs.sqlite3.corrupt-1")).unwrap(), b"no database");
}

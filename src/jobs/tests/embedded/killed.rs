//! `kill -9`, and a disk that is full.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::PathBuf;
use std::sync::Arc;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{Backend, Embedded, JobId, State, Stop, Submission, SubmitError, Watch, Work};

use crate::child::{Process, task, wait};
use crate::stage::{id, job};
use crate::stand::{Stand, within_a_minute};

/// Makes a file; says when it begins and ends. The first job of a round holds until the process is killed.
struct Maker {
    directory: PathBuf,
    round: Option<usize>,
}

impl Work for Maker {
    fn run(&self, _job: &JobId, payload: &[u8], watch: &dyn Watch) -> Result<(), Stop> {
        let name = String::from_utf8(payload.to_vec()).unwrap();
        println!("\nbegun {name}");
        if self.round.is_some_and(|round| name == format!("{round}-first")) {
            while !watch.cancelled() {
                std::thread::yield_now();
            }
            return Err(Stop::Cancelled);
        }
        File::create(self.directory.join(format!("made-{name}"))).unwrap();
        println!("\nmade {name}");
        Ok(())
    }
}

fn open(directory: &str, round: Option<usize>) -> Embedded {
    let config = Config { max_attempts: 100, ..Config::in_directory(directory) };
    Embedded::open(config, Arc::new(Maker { directory: directory.into(), round })).unwrap()
}

fn submission(name: &str, cost: f64) -> Submission {
    Submission { payload: name.to_owned().into(), cost, ..job("ada", name, "") }
}

#[tokio::test]
#[ignore = "the process that is killed"]
async fn process_that_makes() {
    let Some((directory, round)) = task() else { return };
    let backend = open(&directory, Some(round));
    let names = (0..20).map(|number| (format!("{round}-{number}"), 1.0));
    for (name, cost) in std::iter::once((format!("{round}-first"), 10.0)).chain(names) {
        backend.submit(submission(&name, cost)).await.unwrap().keep();
        println!("\ntaken {name}");
    }
    wait();
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_survive_five_kills() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let mut taken = BTreeSet::new();
        for round in 0..5 {
            let mut process = Process::start("killed::process_that_makes", directory.path(), round, None);
            let (mut accepted, mut made, mut held) = (0, 0, false);
            while accepted < 10 || made < 3 || !held {
                let line = process.line().unwrap();
                if let Some(name) = line.strip_prefix("taken ") {
                    taken.insert(name.to_owned());
                    accepted += 1;
                }
                made += usize::from(line.starts_with("made "));
                held |= line == format!("begun {round}-first");
            }
            process.kill();
        }
        let backend = open(directory.path().to_str().unwrap(), None);
        for name in taken {
            let mut watcher = backend.watch(id(&name)).await.unwrap().unwrap();
            let mut last = None;
            while let Some(job) = watcher.next().await {
                last = Some(job);
            }
            let end = last.unwrap();
            assert_eq!(end.state, State::Succeeded, "{name}");
            assert!(directory.path().join(format!("made-{name}")).exists(), "{name}");
            assert!(!name.ends_with("first") || end.attempts > 1, "{name}");
        }
    })
    .await;
}

/// What was taken stays; what cannot be recorded is not taken; what runs comes to its end.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "the process whose disk is full"]
async fn process_on_a_full_disk() {
    let Some((directory, _)) = task() else { return };
    let stand = Stand::at(Config::in_directory(&directory));
    let running = stand.submit(job("ada", "running", "hold")).await;
    stand.stage.begun(1).await;
    let mut taken = Vec::new();
    let fault = loop {
        let name = format!("{}", taken.len());
        let padding = " ".repeat(100_000);
        let large = Submission { payload: format!("{name} pass{padding}").into(), ..job("ada", &name, "") };
        match stand.backend.submit(large).await {
            Ok(claim) => {
                claim.keep();
                taken.push(name);
            }
            Err(fault) => break fault,
        }
    };
    assert!(matches!(fault, SubmitError::Unavailable(_)), "{fault}");
    assert!(stand.backend.reachable().await.is_err());
    assert_eq!(stand.backend.get(id(&taken.len().to_string())).await.unwrap(), None);
    stand.stage.open("running");
    assert_eq!(running.finished().await.state, State::Succeeded);
    assert_eq!(stand.get("running").await.state, State::Succeeded);
    fs::write(format!("{directory}/taken"), taken.join("\n")).unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_disk_takes_no_more() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let process = Process::start("killed::process_on_a_full_disk", directory.path(), 0, Some(2000));
        assert!(process.succeeds());
        let taken = fs::read_to_string(directory.path().join("taken")).unwrap();
        assert!(taken.lines().count() > 1);
        let after = Stand::at(Config::in_directory(directory.path()));
        after.stage.open("running");
        for name in taken.lines() {
            assert!(after.end(name).await.state.is_final());
        }
    })
    .await;
}

//! Processes that are killed, and a full disk.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::PathBuf;
use std::sync::Arc;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{Backend, Embedded, JobId, RunControl, State, Submission, SubmitError, Work, WorkError};

use crate::child_process::{Process, task, wait};
use crate::fixture::{Fixture, timed_tests, wait_for_end};
use crate::scripted_work::{id, job};

timed_tests!(jobs_survive_five_kills_of_their_process, a_full_disk_rejects_submissions_and_keeps_jobs,);

/// Makes a file for each job and prints when it starts and ends. The first job of a round runs until the process is
/// killed.
struct FileMaker {
    directory: PathBuf,
    round: Option<usize>,
}

impl Work for FileMaker {
    fn run(&self, _job: &JobId, payload: &[u8], control: &dyn RunControl) -> Result<(), WorkError> {
        let name = String::from_utf8(payload.to_vec()).unwrap();
        println!("\nstarted {name}");
        if self.round.is_some_and(|round| name == format!("{round}-first")) {
            while !control.cancelled() {
                std::thread::yield_now();
            }
            return Err(WorkError::Cancelled);
        }
        File::create(self.directory.join(format!("made-{name}"))).unwrap();
        println!("\nmade {name}");
        Ok(())
    }
}

fn open(directory: &str, round: Option<usize>) -> Embedded {
    let config = Config { max_attempts: 100, ..Config::in_directory(directory) };
    Embedded::open(config, Arc::new(FileMaker { directory: directory.into(), round })).unwrap()
}

fn submission(name: &str, cost: f64) -> Submission {
    Submission { payload: name.to_owned().into(), cost, ..job("ada", name, "") }
}

#[tokio::test]
#[ignore = "the process that is killed"]
async fn process_that_is_killed() {
    let Some((directory, round)) = task() else { return };
    let backend = open(&directory, Some(round));
    let names = (0..20).map(|number| (format!("{round}-{number}"), 1.0));
    for (name, cost) in std::iter::once((format!("{round}-first"), 10.0)).chain(names) {
        backend.submit(submission(&name, cost)).await.unwrap().detach();
        println!("\naccepted {name}");
    }
    wait();
}

async fn jobs_survive_five_kills_of_their_process() {
    let directory = TempDir::new().unwrap();
    let mut accepted = BTreeSet::new();
    for round in 0..5 {
        let mut process = Process::start("crashes::process_that_is_killed", directory.path(), round, None);
        let (mut count, mut made, mut waits) = (0, 0, false);
        while count < 10 || made < 3 || !waits {
            let line = process.line().unwrap();
            if let Some(name) = line.strip_prefix("accepted ") {
                accepted.insert(name.to_owned());
                count += 1;
            }
            made += usize::from(line.starts_with("made "));
            waits |= line == format!("started {round}-first");
        }
        process.kill();
    }
    let backend = open(directory.path().to_str().unwrap(), None);
    for name in accepted {
        let end = wait_for_end(&backend, &name).await;
        assert_eq!(end.state, State::Succeeded, "{name}");
        assert!(directory.path().join(format!("made-{name}")).exists(), "{name}");
        assert!(!name.ends_with("first") || end.attempts > 1, "{name}");
    }
}

/// Accepted jobs stay, a job that cannot be recorded is rejected, and a running job ends.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "the process whose disk is full"]
async fn process_on_a_full_disk() {
    let Some((directory, _)) = task() else { return };
    let fixture = Fixture::embedded(Config::in_directory(&directory));
    let running = fixture.submit(job("ada", "running", "wait")).await;
    fixture.work.started(1).await;
    let mut accepted = Vec::new();
    let error = loop {
        let name = format!("{}", accepted.len());
        let padding = " ".repeat(100_000);
        let large = Submission { payload: format!("{name} pass{padding}").into(), ..job("ada", &name, "") };
        match fixture.backend.submit(large).await {
            Ok(claim) => {
                claim.detach();
                accepted.push(name);
            }
            Err(error) => break error,
        }
    };
    assert!(matches!(error, SubmitError::Unavailable(_)), "{error}");
    assert!(fixture.backend.reachable().await.is_err());
    assert_eq!(fixture.backend.get(id(&accepted.len().to_string())).await.unwrap(), None);
    fixture.work.release("running");
    assert_eq!(running.finished().await.state, State::Succeeded);
    assert_eq!(fixture.get("running").await.state, State::Succeeded);
    fs::write(format!("{directory}/accepted"), accepted.join("\n")).unwrap();
}

async fn a_full_disk_rejects_submissions_and_keeps_jobs() {
    let directory = TempDir::new().unwrap();
    let process = Process::start("crashes::process_on_a_full_disk", directory.path(), 0, Some(2000));
    assert!(process.succeeds());
    let accepted = fs::read_to_string(directory.path().join("accepted")).unwrap();
    assert!(accepted.lines().count() > 1);
    let after = Fixture::embedded(Config::in_directory(directory.path()));
    after.work.release("running");
    for name in accepted.lines() {
        assert!(after.wait_for_end(name).await.state.is_final());
    }
}

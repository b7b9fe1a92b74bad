//! Processes and brokers that are stopped and started.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::jetstream::{Config, Worker, WorkerConfig};
use verne_jobs::{Backend, Failure, Filter, JetStream, State, Submission, SubmitError};

use crate::broker::{Broker, worker};
use crate::fixture::{broker_tests, wait_for_end};
use crate::scripted_work::{ScriptedWork, id, job};

broker_tests!(
    a_drained_worker_returns_its_jobs_to_the_queue,
    a_newer_worker_runs_a_job_that_an_older_one_cannot,
    a_new_process_knows_the_earlier_jobs,
    an_aborted_submission_leaves_no_claim,
    running_processes_create_the_streams_of_an_emptied_broker,
    processes_forget_the_jobs_that_an_emptied_broker_has_lost,
    jobs_of_a_drained_process_continue,
);

/// A drain does not count as a crash: the jobs run again though only one attempt is allowed.
async fn a_drained_worker_returns_its_jobs_to_the_queue() {
    let broker = Broker::start();
    let config = Config { max_attempts: 1, ack_wait: Duration::from_hours(1), ..broker.config() };
    let backend = JetStream::connect(config).await.unwrap();
    let work = Arc::new(ScriptedWork::default());
    let config = WorkerConfig { threads: 2, slots: 2 };
    let before = Worker::start(&backend, config, work.clone()).unwrap();
    let obeys = backend.submit(job("ada", "obeys", "wait")).await.unwrap();
    let ignores = backend.submit(job("ada", "ignore-stop", "ignore-stop")).await.unwrap();
    let parent = backend.submit(job("ada", "parent", "split a=pass")).await.unwrap();
    work.started(2).await;
    before.drain(Duration::from_millis(300)).await;
    for claim in [&obeys, &ignores, &parent] {
        assert_eq!(claim.job().state, State::Queued);
    }
    let after_work = Arc::new(ScriptedWork::default());
    let _after = worker(&backend, &after_work);
    after_work.release("obeys");
    after_work.release("ignore-stop");
    for claim in [obeys, ignores, parent] {
        assert_eq!(claim.finished().await.state, State::Succeeded);
    }
    work.release("ignore-stop");
}

/// Workers are replaced one after the other.
async fn a_newer_worker_runs_a_job_that_an_older_one_cannot() {
    let broker = Broker::start();
    let nodes = [broker.connect().await, broker.connect().await];
    let old = Arc::new(ScriptedWork::outdated());
    let older = worker(&nodes[0], &old);
    let claim = nodes[1].submit(job("ada", "a", "pass")).await.unwrap();
    let parent = nodes[1].submit(job("ada", "parent", "split b=pass c=pass")).await.unwrap();
    old.started(2).await;
    let new = Arc::new(ScriptedWork::default());
    let _worker = worker(&nodes[1], &new);
    assert_eq!(claim.finished().await.state, State::Succeeded);
    assert_eq!(parent.finished().await.state, State::Succeeded);
    let occupancy = older.occupancy();
    assert_eq!(occupancy().slots.total, 3);
    assert!(occupancy().handed_back >= 2, "{:?}", occupancy());
    // It also returns the jobs that it has when it is drained.
    older.drain(Duration::from_secs(10)).await;
}

async fn a_new_process_knows_the_earlier_jobs() {
    let broker = Broker::start();
    let api = broker.connect().await;
    let deadline = Some(Duration::from_secs(3));
    for name in ["a", "b"] {
        api.submit(job("ada", name, "pass")).await.unwrap().detach();
    }
    api.submit(Submission { deadline, ..job("ada", "late", "pass") }).await.unwrap().detach();
    api.get(id("a")).await.unwrap();
    drop(api);
    let later = broker.connect().await;
    let page = later.list(Filter { limit: 9, ..Filter::default() }).await.unwrap();
    assert_eq!(page.jobs.iter().map(|job| job.id).collect::<Vec<_>>(), [id("late"), id("b"), id("a")]);
    assert_eq!(later.counts().queued, 3);
    assert_eq!(wait_for_end(&later, "late").await.failure, Some(Failure::DeadlinePassed));
}

/// The client may disconnect while its job is being recorded.
async fn an_aborted_submission_leaves_no_claim() {
    let broker = Broker::start();
    let api = broker.connect().await;
    for number in 0..100 {
        let name = format!("{number}");
        let submitting = api.submit(job("ada", &name, "pass"));
        // Sometimes before it is recorded, sometimes after.
        drop(tokio::time::timeout(Duration::from_micros(50 * number), submitting).await);
    }
    while api.counts().queued > 0 {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

/// No new process connects.
async fn running_processes_create_the_streams_of_an_emptied_broker() {
    let mut broker = Broker::start();
    let api = broker.connect().await;
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&api, &work);
    api.submit(job("ada", "before", "pass")).await.unwrap().finished().await;
    broker.kill();
    broker.forget();
    broker.restart();
    let claim = loop {
        if let Ok(claim) = api.submit(job("ada", "after", "pass")).await {
            break claim;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    };
    assert_eq!(claim.finished().await.state, State::Succeeded);
}

/// The broker has lost its directory, or another has taken its place.
async fn processes_forget_the_jobs_that_an_emptied_broker_has_lost() {
    let mut broker = Broker::start();
    let api = broker.connect().await;
    for number in 0..20 {
        api.submit(job("ada", &format!("{number}"), "pass")).await.unwrap().detach();
    }
    broker.kill();
    broker.forget();
    broker.restart();
    let fresh = broker.connect().await;
    fresh.submit(job("ada", "new", "pass")).await.unwrap().detach();
    let page = loop {
        let page = api.list(Filter { limit: 9, ..Filter::default() }).await;
        if let Ok(page) = page
            && page.jobs.len() == 1
        {
            break page;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    };
    assert_eq!(page.jobs[0].id, id("new"));
}

async fn jobs_of_a_drained_process_continue() {
    let broker = Broker::start();
    let (api, node) = (broker.connect().await, broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&node, &work);
    let claim = api.submit(job("ada", "a", "wait")).await.unwrap();
    work.started(1).await;
    api.drain(Duration::from_secs(10)).await;
    assert_eq!(claim.finished().await.state, State::Running);
    assert_eq!(api.submit(job("ada", "late", "pass")).await.unwrap_err(), SubmitError::Draining);
    assert!(api.get(id("a")).await.is_err());
    drop((claim, api));
    work.release("a");
    assert_eq!(wait_for_end(&node, "a").await.state, State::Succeeded);
}

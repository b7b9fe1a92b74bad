//! Workers, API processes and brokers that are lost.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::{Backend, Failure, JetStream, JobId, State, Submission, SubmitError};

use crate::broker::{Broker, worker};
use crate::fixture::{broker_tests, wait_for_end};
use crate::scripted_work::{ScriptedWork, id, job};

broker_tests!(
    another_worker_runs_the_job_of_a_lost_worker,
    a_job_that_kills_workers_fails,
    a_recorded_job_without_a_message_is_queued,
    a_damaged_record_is_replaced,
    records_and_messages_of_another_layout_are_not_changed,
    jobs_of_a_lost_process_are_cancelled_unless_detached,
    a_lost_broker_is_reported_and_used_again_when_it_is_back,
    no_job_is_lost_when_workers_and_brokers_are_lost,
);

async fn another_worker_runs_the_job_of_a_lost_worker() {
    let broker = Broker::start();
    let (api, node) = (broker.connect().await, broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let lost = worker(&node, &work);
    let claim = api.submit(job("ada", "a", "wait")).await.unwrap();
    let parent = api.submit(job("bob", "parent", "split b=pass")).await.unwrap();
    work.started(1).await;
    drop((lost, node));
    let _worker = worker(&api, &work);
    work.started(2).await;
    work.release("a");
    let end = claim.finished().await;
    assert_eq!((end.state, end.attempts), (State::Succeeded, 2));
    assert_eq!(parent.finished().await.state, State::Succeeded);
}

async fn a_job_that_kills_workers_fails() {
    let broker = Broker::start();
    let api = broker.connect().await;
    let claim = api.submit(job("ada", "poison", "wait")).await.unwrap();
    for attempt in 1..=3 {
        let work = Arc::new(ScriptedWork::default());
        let lost = worker(&api, &work);
        assert_eq!(work.started(1).await, ["poison"]);
        assert_eq!(claim.job().attempts, attempt);
        drop(lost);
    }
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&api, &work);
    let end = claim.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::TooManyAttempts)));
    let good = api.submit(job("ada", "good", "pass")).await.unwrap();
    assert_eq!(good.finished().await.state, State::Succeeded);
    assert_eq!(work.started(1).await, ["good"]);
}

/// The process died between writing the record and the message.
async fn a_recorded_job_without_a_message_is_queued() {
    let (before, broker) = (Broker::start(), Broker::start());
    let api = before.connect().await;
    api.submit(job("ada", "a", "pass")).await.unwrap().detach();
    // Answered when the job is detached in its record.
    api.get(id("a")).await.unwrap();
    let key = key("a");
    let record = Box::pin(bucket(&before)).await.get(key.as_str()).await.unwrap().unwrap();
    let api = broker.connect().await;
    Box::pin(bucket(&broker)).await.put(key, record).await.unwrap();
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&api, &work);
    assert_eq!(wait_for_end(&api, "a").await.state, State::Succeeded);
}

/// Key of a job's record.
fn key(name: &str) -> String {
    format!("4.{}", id(name))
}

async fn a_damaged_record_is_replaced() {
    let broker = Broker::start();
    let api = broker.connect().await;
    Box::pin(bucket(&broker)).await.put(key("a"), "damaged".into()).await.unwrap();
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&api, &work);
    let claim = api.submit(job("ada", "a", "pass")).await.unwrap();
    assert_eq!(claim.finished().await.state, State::Succeeded);
}

/// A program is replaced, process after process, by one with another layout.
async fn records_and_messages_of_another_layout_are_not_changed() {
    let broker = Broker::start();
    let api = broker.connect().await;
    let client = Box::pin(async_nats::connect(broker.config().url)).await.unwrap();
    let context = async_nats::jetstream::new(client);
    let other = format!("verne.queue.1.large.{}", id("a"));
    context.publish(other.clone(), "of another layout".into()).await.unwrap().await.unwrap();
    Box::pin(bucket(&broker)).await.put(format!("1.{}", id("a")), "so".into()).await.unwrap();
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&api, &work);
    let claim = api.submit(job("ada", "a", "pass")).await.unwrap();
    assert_eq!(claim.finished().await.state, State::Succeeded);
    let queue = context.get_stream("verne-queue").await.unwrap();
    assert_eq!(queue.get_last_raw_message_by_subject(&other).await.unwrap().payload, "of another layout");
    let record = Box::pin(bucket(&broker)).await.get(format!("1.{}", id("a"))).await.unwrap();
    assert_eq!(record.unwrap(), "so");
}

async fn bucket(broker: &Broker) -> async_nats::jetstream::kv::Store {
    let client = async_nats::connect(broker.config().url).await.unwrap();
    async_nats::jetstream::new(client).get_key_value("verne-jobs").await.unwrap()
}

async fn jobs_of_a_lost_process_are_cancelled_unless_detached() {
    let broker = Broker::start();
    let (api, node) = (broker.connect().await, broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&node, &work);
    let waits = api.submit(job("ada", "waits", "wait")).await.unwrap();
    api.submit(job("ada", "detached", "pass")).await.unwrap().detach();
    api.get(id("detached")).await.unwrap();
    let mut seen = waits.watch();
    while seen.next().await.unwrap().state != State::Running {}
    drop(api);
    assert_eq!(wait_for_end(&node, "waits").await.state, State::Cancelled);
    assert_eq!(wait_for_end(&node, "detached").await.state, State::Succeeded);
    assert_eq!(waits.job().state, State::Running);
}

async fn a_lost_broker_is_reported_and_used_again_when_it_is_back() {
    let mut broker = Broker::start();
    let api = broker.connect().await;
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&api, &work);
    let claim = api.submit(job("ada", "a", "wait")).await.unwrap();
    work.started(1).await;
    assert_eq!(api.reachable().await, Ok(()));
    broker.kill();
    let refused = api.submit(job("ada", "b", "pass")).await.unwrap_err();
    assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
    assert!(api.reachable().await.is_err());
    work.release("a");
    work.ended(1).await;
    broker.restart();
    assert_eq!(claim.finished().await.state, State::Succeeded);
    submit(&api, job("ada", "b", "pass")).await;
    assert_eq!(wait_for_end(&api, "b").await.state, State::Succeeded);
    assert_eq!(api.reachable().await, Ok(()));
}

/// Submits a job as soon as the broker accepts it.
async fn submit(api: &JetStream, submission: Submission) -> JobId {
    loop {
        match api.submit(submission.clone()).await {
            Ok(claim) => {
                claim.detach();
                return submission.id;
            }
            Err(SubmitError::Unavailable(_)) => tokio::time::sleep(Duration::from_millis(100)).await,
            Err(error) => panic!("{error}"),
        }
    }
}

async fn no_job_is_lost_when_workers_and_brokers_are_lost() {
    let mut broker = Broker::start();
    let api = Arc::new(broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let mut nodes = Vec::new();
    for _ in 0..2 {
        let node = broker.connect().await;
        nodes.push((worker(&node, &work), node));
    }
    let submitting = {
        let api = Arc::clone(&api);
        tokio::spawn(async move {
            for number in 0..200 {
                submit(&api, job("ada", &format!("{number}"), "pass")).await;
            }
        })
    };
    for round in 1..=2 {
        work.ended(round * 40).await;
        drop(nodes.remove(0));
        if round == 1 {
            broker.kill();
            broker.restart();
        }
        let node = broker.connect().await;
        nodes.push((worker(&node, &work), node));
    }
    submitting.await.unwrap();
    for number in 0..200 {
        assert_eq!(
            wait_for_end(api.as_ref(), &format!("{number}")).await.state,
            State::Succeeded,
            "{number}"
        );
    }
}

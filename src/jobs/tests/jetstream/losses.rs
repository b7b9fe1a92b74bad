//! Workers, processes and brokers that are lost.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::{Backend, Failure, JetStream, JobId, State, Submission, SubmitError};

use crate::broker::{Broker, worker};
use crate::nodes::end;
use crate::stage::{Stage, id, job};
use crate::stand::within_a_minute;

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_lost_workers_job_comes_to_another() {
    within_a_minute(async {
        let broker = Broker::start();
        let (api, node) = (broker.connect().await, broker.connect().await);
        let stage = Arc::new(Stage::default());
        let lost = worker(&node, &stage);
        let claim = api.submit(job("ada", "a", "hold")).await.unwrap();
        let whole = api.submit(job("bob", "whole", "split b=pass")).await.unwrap();
        stage.begun(1).await;
        drop((lost, node));
        let _worker = worker(&api, &stage);
        stage.begun(2).await;
        stage.open("a");
        let end = claim.finished().await;
        assert_eq!((end.state, end.attempts), (State::Succeeded, 2));
        assert_eq!(whole.finished().await.state, State::Succeeded);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_job_at_which_workers_are_lost_is_given_up() {
    within_a_minute(async {
        let broker = Broker::start();
        let api = broker.connect().await;
        let claim = api.submit(job("ada", "poison", "hold")).await.unwrap();
        for attempt in 1..=3 {
            let stage = Arc::new(Stage::default());
            let lost = worker(&api, &stage);
            assert_eq!(stage.begun(1).await, ["poison"]);
            assert_eq!(claim.job().attempts, attempt);
            drop(lost);
        }
        let stage = Arc::new(Stage::default());
        let _worker = worker(&api, &stage);
        let end = claim.finished().await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::TooManyAttempts)));
        let good = api.submit(job("ada", "good", "pass")).await.unwrap();
        assert_eq!(good.finished().await.state, State::Succeeded);
        assert_eq!(stage.begun(1).await, ["good"]);
    })
    .await;
}

/// The process died between the two.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_was_recorded_and_not_queued_is_queued() {
    within_a_minute(async {
        let (before, broker) = (Broker::start(), Broker::start());
        let api = before.connect().await;
        api.submit(job("ada", "a", "pass")).await.unwrap().keep();
        // Answered when that is recorded.
        api.get(id("a")).await.unwrap();
        let key = key("a");
        let record = Box::pin(bucket(&before)).await.get(key.as_str()).await.unwrap().unwrap();
        let api = broker.connect().await;
        Box::pin(bucket(&broker)).await.put(key, record).await.unwrap();
        let stage = Arc::new(Stage::default());
        let _worker = worker(&api, &stage);
        assert_eq!(end(&api, "a").await.state, State::Succeeded);
    })
    .await;
}

/// Of a job's record.
fn key(name: &str) -> String {
    format!("4.{}", id(name))
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_record_that_cannot_be_read_is_in_nobodys_way() {
    within_a_minute(async {
        let broker = Broker::start();
        let api = broker.connect().await;
        Box::pin(bucket(&broker)).await.put(key("a"), "damaged".into()).await.unwrap();
        let stage = Arc::new(Stage::default());
        let _worker = worker(&api, &stage);
        let claim = api.submit(job("ada", "a", "pass")).await.unwrap();
        assert_eq!(claim.finished().await.state, State::Succeeded);
    })
    .await;
}

/// A program is replaced by one that writes otherwise, process after process.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_is_of_another_layout_is_left_to_others() {
    within_a_minute(async {
        let broker = Broker::start();
        let api = broker.connect().await;
        let client = Box::pin(async_nats::connect(broker.config().url)).await.unwrap();
        let context = async_nats::jetstream::new(client);
        let other = format!("verne.queue.1.large.{}", id("a"));
        context.publish(other.clone(), "of another layout".into()).await.unwrap().await.unwrap();
        Box::pin(bucket(&broker)).await.put(format!("1.{}", id("a")), "so".into()).await.unwrap();
        let stage = Arc::new(Stage::default());
        let _worker = worker(&api, &stage);
        let claim = api.submit(job("ada", "a", "pass")).await.unwrap();
        assert_eq!(claim.finished().await.state, State::Succeeded);
        let queue = context.get_stream("verne-queue").await.unwrap();
        assert_eq!(queue.get_last_raw_message_by_subject(&other).await.unwrap().payload, "of another layout");
        let record = Box::pin(bucket(&broker)).await.get(format!("1.{}", id("a"))).await.unwrap();
        assert_eq!(record.unwrap(), "so");
    })
    .await;
}

async fn bucket(broker: &Broker) -> async_nats::jetstream::kv::Store {
    let client = async_nats::connect(broker.config().url).await.unwrap();
    async_nats::jetstream::new(client).get_key_value("verne-jobs").await.unwrap()
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_a_lost_process_waited_for_is_cancelled() {
    within_a_minute(async {
        let broker = Broker::start();
        let (api, node) = (broker.connect().await, broker.connect().await);
        let stage = Arc::new(Stage::default());
        let _worker = worker(&node, &stage);
        let waits = api.submit(job("ada", "waits", "hold")).await.unwrap();
        api.submit(job("ada", "kept", "pass")).await.unwrap().keep();
        api.get(id("kept")).await.unwrap();
        let mut seen = waits.watch();
        while seen.next().await.unwrap().state != State::Running {}
        drop(api);
        assert_eq!(end(&node, "waits").await.state, State::Cancelled);
        assert_eq!(end(&node, "kept").await.state, State::Succeeded);
        assert_eq!(waits.job().state, State::Running);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_lost_broker_is_told_and_found_again() {
    within_a_minute(async {
        let mut broker = Broker::start();
        let api = broker.connect().await;
        let stage = Arc::new(Stage::default());
        let _worker = worker(&api, &stage);
        let claim = api.submit(job("ada", "a", "hold")).await.unwrap();
        stage.begun(1).await;
        assert_eq!(api.reachable().await, Ok(()));
        broker.kill();
        let refused = api.submit(job("ada", "b", "pass")).await.unwrap_err();
        assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
        assert!(api.reachable().await.is_err());
        stage.open("a");
        stage.left(1).await;
        broker.restart();
        assert_eq!(claim.finished().await.state, State::Succeeded);
        submit(&api, job("ada", "b", "pass")).await;
        assert_eq!(end(&api, "b").await.state, State::Succeeded);
        assert_eq!(api.reachable().await, Ok(()));
    })
    .await;
}

/// However long the broker is away.
async fn submit(api: &JetStream, submission: Submission) -> JobId {
    loop {
        match api.submit(submission.clone()).await {
            Ok(claim) => {
                claim.keep();
                return submission.id;
            }
            Err(SubmitError::Unavailable(_)) => tokio::time::sleep(Duration::from_millis(100)).await,
            Err(fault) => panic!("{fault}"),
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn no_job_is_lost_with_workers_and_brokers() {
    within_a_minute(async {
        let mut broker = Broker::start();
        let api = Arc::new(broker.connect().await);
        let stage = Arc::new(Stage::default());
        let mut nodes = Vec::new();
        for _ in 0..2 {
            let node = broker.connect().await;
            nodes.push((worker(&node, &stage), node));
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
            stage.left(round * 40).await;
            drop(nodes.remove(0));
            if round == 1 {
                broker.kill();
                broker.restart();
            }
            let node = broker.connect().await;
            nodes.push((worker(&node, &stage), node));
        }
        submitting.await.unwrap();
        for number in 0..200 {
            assert_eq!(end(&api, &format!("{number}")).await.state, State::Succeeded, "{number}");
        }
    })
    .await;
}

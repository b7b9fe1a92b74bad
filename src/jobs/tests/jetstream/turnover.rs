//! Processes, and brokers, that come and go.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::jetstream::{Config, Worker, WorkerConfig};
use verne_jobs::{Backend, Failure, Filter, JetStream, State, SubmitError};

use crate::broker::{Broker, worker};
use crate::nodes::end;
use crate::stage::{Stage, id, job};
use crate::stand::within_a_minute;

/// A worker that is stopped is no crash: with one attempt allowed its job is run again all the same.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_drained_worker_hands_its_jobs_back() {
    within_a_minute(async {
        let broker = Broker::start();
        let config = Config { max_attempts: 1, ack_wait: Duration::from_hours(1), ..broker.config() };
        let backend = JetStream::connect(config).await.unwrap();
        let stage = Arc::new(Stage::default());
        let places = WorkerConfig { threads: 2, slots: 2 };
        let before = Worker::start(&backend, places, stage.clone()).unwrap();
        let heeds = backend.submit(job("ada", "heeds", "hold")).await.unwrap();
        let deaf = backend.submit(job("ada", "deaf", "deaf")).await.unwrap();
        let whole = backend.submit(job("ada", "whole", "split a=pass")).await.unwrap();
        stage.begun(2).await;
        before.drain(Duration::from_millis(300)).await;
        for claim in [&heeds, &deaf, &whole] {
            assert_eq!(claim.job().state, State::Queued);
        }
        let after_stage = Arc::new(Stage::default());
        let _after = worker(&backend, &after_stage);
        after_stage.open("heeds");
        after_stage.open("deaf");
        for claim in [heeds, deaf, whole] {
            assert_eq!(claim.finished().await.state, State::Succeeded);
        }
        stage.open("deaf");
    })
    .await;
}

/// Workers are replaced one after the other, and some are behind.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_an_old_worker_cannot_read_is_left_to_a_new_one() {
    within_a_minute(async {
        let broker = Broker::start();
        let nodes = [broker.connect().await, broker.connect().await];
        let old = Arc::new(Stage::old());
        let behind = worker(&nodes[0], &old);
        let claim = nodes[1].submit(job("ada", "a", "pass")).await.unwrap();
        let whole = nodes[1].submit(job("ada", "whole", "split b=pass c=pass")).await.unwrap();
        old.begun(2).await;
        let new = Arc::new(Stage::default());
        let _worker = worker(&nodes[1], &new);
        assert_eq!(claim.finished().await.state, State::Succeeded);
        assert_eq!(whole.finished().await.state, State::Succeeded);
        let occupancy = behind.occupancy();
        assert_eq!(occupancy().seats.all, 3);
        assert!(occupancy().handed_back >= 2, "{:?}", occupancy());
        // Nor does it keep what it has in hand when it is stopped.
        behind.drain(Duration::from_secs(10)).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn who_comes_later_knows_what_was_before() {
    within_a_minute(async {
        let broker = Broker::start();
        let api = broker.connect().await;
        let deadline = Some(Duration::from_secs(3));
        for name in ["a", "b"] {
            api.submit(job("ada", name, "pass")).await.unwrap().keep();
        }
        api.submit(verne_jobs::Submission { deadline, ..job("ada", "late", "pass") }).await.unwrap().keep();
        api.get(id("a")).await.unwrap();
        drop(api);
        let later = broker.connect().await;
        let page = later.list(Filter { limit: 9, ..Filter::default() }).await.unwrap();
        assert_eq!(page.jobs.iter().map(|job| job.id).collect::<Vec<_>>(), [id("late"), id("b"), id("a")]);
        assert_eq!(later.counts().queued, 3);
        assert_eq!(end(&later, "late").await.failure, Some(Failure::DeadlinePassed));
    })
    .await;
}

/// The client may leave while its job is being recorded.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn who_goes_away_early_leaves_nothing_behind() {
    within_a_minute(async {
        let broker = Broker::start();
        let api = broker.connect().await;
        for number in 0..100 {
            let name = format!("{number}");
            let submitting = api.submit(job("ada", &name, "pass"));
            // Some before it is recorded, some after.
            drop(tokio::time::timeout(Duration::from_micros(50 * number), submitting).await);
        }
        while api.counts().queued > 0 {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    })
    .await;
}

/// Nobody comes who would make it ready.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_broker_that_begins_anew_is_made_ready_by_who_is_there() {
    within_a_minute(async {
        let mut broker = Broker::start();
        let api = broker.connect().await;
        let stage = Arc::new(Stage::default());
        let _worker = worker(&api, &stage);
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
    })
    .await;
}

/// Its directory was lost, or another took its place.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_broker_that_begins_anew_is_followed() {
    within_a_minute(async {
        let mut broker = Broker::start();
        let api = broker.connect().await;
        for number in 0..20 {
            api.submit(job("ada", &format!("{number}"), "pass")).await.unwrap().keep();
        }
        broker.kill();
        broker.forget();
        broker.restart();
        let fresh = broker.connect().await;
        fresh.submit(job("ada", "new", "pass")).await.unwrap().keep();
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
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_drained_process_leaves_its_jobs_to_go_on() {
    within_a_minute(async {
        let broker = Broker::start();
        let (api, node) = (broker.connect().await, broker.connect().await);
        let stage = Arc::new(Stage::default());
        let _worker = worker(&node, &stage);
        let claim = api.submit(job("ada", "a", "hold")).await.unwrap();
        stage.begun(1).await;
        api.drain(Duration::from_secs(10)).await;
        assert_eq!(claim.finished().await.state, State::Running);
        assert_eq!(api.submit(job("ada", "late", "pass")).await.unwrap_err(), SubmitError::Draining);
        assert!(api.get(id("a")).await.is_err());
        drop((claim, api));
        stage.open("a");
        assert_eq!(end(&node, "a").await.state, State::Succeeded);
    })
    .await;
}

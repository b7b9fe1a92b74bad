//! Several processes at one broker.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::embedded::Retention;
use verne_jobs::jetstream::Config;
use verne_jobs::{Backend, Counts, Filter, JetStream, Job, State};

use crate::broker::{Broker, worker};
use crate::stage::{Stage, id, job};
use crate::stand::within_a_minute;

/// The job at its end, as it is known there.
pub(crate) async fn end(backend: &JetStream, name: &str) -> Job {
    let mut watcher = loop {
        if let Some(watcher) = backend.watch(id(name)).await.unwrap() {
            break watcher;
        }
    };
    let mut last = None;
    while let Some(job) = watcher.next().await {
        last = Some(job);
    }
    last.filter(|job| job.state.is_final()).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn one_submits_another_runs_a_third_watches() {
    within_a_minute(async {
        let broker = Broker::start();
        let (api, node, third) = (broker.connect().await, broker.connect().await, broker.connect().await);
        let stage = Arc::new(Stage::default());
        let _worker = worker(&node, &stage);
        let claim = api.submit(job("ada", "a", "waver")).await.unwrap();
        let mut watcher = loop {
            if let Some(watcher) = third.watch(id("a")).await.unwrap() {
                break watcher;
            }
        };
        while watcher.next().await.unwrap().progress != 0.2 {}
        for gate in ["a-0.2", "a-0.1", "a-NaN", "a-0.5", "a-0.3"] {
            stage.open(gate);
        }
        assert_eq!(claim.finished().await.state, State::Succeeded);
        assert_eq!(end(&third, "a").await, claim.job());
        assert_eq!(third.counts(), Counts { started: 1, succeeded: 1, ..Counts::default() });
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn equal_submissions_to_different_processes_are_computed_once() {
    within_a_minute(async {
        let broker = Broker::start();
        let nodes = [Arc::new(broker.connect().await), Arc::new(broker.connect().await)];
        let stage = Arc::new(Stage::default());
        let _workers = nodes.each_ref().map(|node| worker(node, &stage));
        for round in 0..20 {
            let name = format!("{round}");
            let submissions: Vec<_> = nodes
                .iter()
                .cycle()
                .take(20)
                .map(|node| {
                    let (node, submission) = (Arc::clone(node), job("ada", &name, "hold"));
                    tokio::spawn(async move { node.submit(submission).await.unwrap() })
                })
                .collect();
            let mut claims = Vec::new();
            for submission in submissions {
                claims.push(submission.await.unwrap());
            }
            stage.open(&name);
            for claim in claims {
                assert_eq!(claim.finished().await.state, State::Succeeded);
            }
        }
        assert_eq!(stage.begun(20).await.len(), 20);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn the_last_claim_of_all_processes_takes_a_job_along() {
    within_a_minute(async {
        let broker = Broker::start();
        let (first, second) = (broker.connect().await, broker.connect().await);
        let stage = Arc::new(Stage::default());
        let _worker = worker(&second, &stage);
        let one = first.submit(job("ada", "a", "hold")).await.unwrap();
        stage.begun(1).await;
        let other = second.submit(job("bob", "a", "hold")).await.unwrap();
        drop(one);
        assert_eq!(first.get(id("a")).await.unwrap().unwrap().state, State::Running);
        drop(other);
        assert_eq!(end(&first, "a").await.state, State::Cancelled);
        assert_eq!(stage.left(1).await, ["a"]);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_job_is_cancelled_from_anywhere() {
    within_a_minute(async {
        let broker = Broker::start();
        let (api, node, third) = (broker.connect().await, broker.connect().await, broker.connect().await);
        let stage = Arc::new(Stage::default());
        let _worker = worker(&node, &stage);
        let claim = api.submit(job("ada", "a", "hold")).await.unwrap();
        stage.begun(1).await;
        while third.cancel(id("a")).await.unwrap().is_none() {}
        assert_eq!(claim.finished().await.state, State::Cancelled);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn parts_are_run_by_all() {
    within_a_minute(async {
        let broker = Broker::start();
        let nodes = [broker.connect().await, broker.connect().await];
        let stages = [Arc::new(Stage::default()), Arc::new(Stage::default())];
        let _workers = [worker(&nodes[0], &stages[0]), worker(&nodes[1], &stages[1])];
        let claim = nodes[0].submit(job("ada", "whole", "split a=hold b=hold")).await.unwrap();
        let [mut one, other] = [stages[0].begun(1).await, stages[1].begun(1).await];
        one.extend(other);
        one.sort();
        assert_eq!(one, ["a", "b"]);
        for stage in &stages {
            stage.open("a");
            stage.open("b");
        }
        assert_eq!(claim.finished().await.state, State::Succeeded);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_one_has_taken_any_other_knows_at_once() {
    within_a_minute(async {
        let broker = Broker::start();
        let (one, other) = (broker.connect().await, broker.connect().await);
        for number in 0..50 {
            let name = format!("{number}");
            one.submit(job("ada", &name, "pass")).await.unwrap().keep();
            assert!(other.get(id(&name)).await.unwrap().is_some(), "{number}");
        }
        assert_eq!(other.get(id("never")).await.unwrap(), None);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn finished_jobs_are_forgotten_everywhere() {
    within_a_minute(async {
        let broker = Broker::start();
        let retention = Retention { count: 2, age: Duration::from_mins(10) };
        let config = Config { retention, ..broker.config() };
        let [node, other] = [JetStream::connect(config.clone()).await.unwrap(), broker.connect().await];
        let stage = Arc::new(Stage::default());
        let _worker = worker(&other, &stage);
        for name in ["a", "b", "c", "d"] {
            node.submit(job("ada", name, "pass")).await.unwrap().finished().await;
        }
        while node.get(id("b")).await.unwrap().is_some() {}
        let page = node.list(Filter { limit: 9, ..Filter::default() }).await.unwrap();
        assert_eq!(page.jobs.iter().map(|job| job.id).collect::<Vec<_>>(), [id("d"), id("c")]);
        // Who comes later finds no more, once the broker has been told.
        loop {
            let later = JetStream::connect(config.clone()).await.unwrap();
            if later.get(id("a")).await.unwrap().is_none() {
                break;
            }
        }
        // It lives anew.
        let again = node.submit(job("ada", "a", "pass")).await.unwrap().finished().await;
        assert_eq!((again.state, again.attempts), (State::Succeeded, 1));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn small_and_large_jobs_are_served_by_both_lanes() {
    within_a_minute(async {
        let broker = Broker::start();
        let backend = broker.connect().await;
        let stage = Arc::new(Stage::default());
        let _worker = worker(&backend, &stage);
        let small = |name: &str| verne_jobs::Submission { cost: 1.0, ..job("ada", name, "hold") };
        let first = backend.submit(small("first")).await.unwrap();
        let second = backend.submit(small("second")).await.unwrap();
        stage.begun(2).await;
        let mut claims = vec![first, second];
        for number in 0..10 {
            claims.push(backend.submit(small(&format!("small{number}"))).await.unwrap());
            claims.push(backend.submit(job("ada", &format!("large{number}"), "hold")).await.unwrap());
        }
        stage.open("first");
        stage.open("second");
        for number in 0..10 {
            stage.open(&format!("small{number}"));
            stage.open(&format!("large{number}"));
        }
        for claim in claims {
            let end = claim.finished().await;
            assert_eq!((end.state, end.attempts), (State::Succeeded, 1));
        }
    })
    .await;
}

/// In nobody's hand while its worker has no place for it.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_waits_for_the_main_lane_is_in_nobodys_way() {
    within_a_minute(async {
        let broker = Broker::start();
        let nodes = [broker.connect().await, broker.connect().await];
        let stages = [Arc::new(Stage::default()), Arc::new(Stage::default())];
        let _busy = worker(&nodes[0], &stages[0]);
        let whole = nodes[0].submit(job("ada", "whole", "split a=hold b=pass c=pass")).await.unwrap();
        stages[0].begun(1).await;
        let large = nodes[0].submit(job("ada", "large", "pass")).await.unwrap();
        let small = verne_jobs::Submission { cost: 1.0, ..job("ada", "small", "pass") };
        let small = nodes[0].submit(small).await.unwrap();
        assert_eq!(small.finished().await.state, State::Succeeded, "by the express lane");
        assert_eq!(stages[0].begun(2).await, ["a", "small"]);
        let _idle = worker(&nodes[1], &stages[1]);
        assert_eq!(large.finished().await.state, State::Succeeded);
        let mut others = stages[1].begun(3).await;
        others.sort();
        assert_eq!(others, ["b", "c", "large"]);
        stages[0].open("a");
        assert_eq!(whole.finished().await.state, State::Succeeded);
    })
    .await;
}

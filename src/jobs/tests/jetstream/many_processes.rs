//! Several processes at one broker.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::jetstream::Config;
use verne_jobs::{Backend, Counts, Filter, JetStream, Retention, State, Submission};

use crate::broker::{Broker, worker};
use crate::fixture::{broker_tests, wait_for_end};
use crate::scripted_work::{ScriptedWork, id, job};

broker_tests!(
    a_third_process_watches_a_job_that_another_runs,
    equal_submissions_to_different_processes_are_computed_once,
    dropping_the_last_claim_of_all_processes_cancels_a_job,
    any_process_can_cancel_a_job,
    several_workers_run_the_subtasks_of_one_job,
    a_submitted_job_is_known_to_other_processes_at_once,
    old_ended_jobs_are_deleted_in_all_processes,
    small_and_large_jobs_run_in_all_slots,
    a_worker_without_a_free_slot_leaves_jobs_to_others,
);

async fn a_third_process_watches_a_job_that_another_runs() {
    let broker = Broker::start();
    let (api, node, third) = (broker.connect().await, broker.connect().await, broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&node, &work);
    let claim = api.submit(job("ada", "a", "progress")).await.unwrap();
    let mut watcher = loop {
        if let Some(watcher) = third.watch(id("a")).await.unwrap() {
            break watcher;
        }
    };
    while watcher.next().await.unwrap().progress != 0.2 {}
    for gate in ["a-0.2", "a-0.1", "a-NaN", "a-0.5", "a-0.3"] {
        work.release(gate);
    }
    assert_eq!(claim.finished().await.state, State::Succeeded);
    assert_eq!(wait_for_end(&third, "a").await, claim.job());
    assert_eq!(third.counts(), Counts { started: 1, succeeded: 1, ..Counts::default() });
}

async fn equal_submissions_to_different_processes_are_computed_once() {
    let broker = Broker::start();
    let nodes = [Arc::new(broker.connect().await), Arc::new(broker.connect().await)];
    let work = Arc::new(ScriptedWork::default());
    let _workers = nodes.each_ref().map(|node| worker(node, &work));
    for round in 0..20 {
        let name = format!("{round}");
        let submissions: Vec<_> = nodes
            .iter()
            .cycle()
            .take(20)
            .map(|node| {
                let (node, submission) = (Arc::clone(node), job("ada", &name, "wait"));
                tokio::spawn(async move { node.submit(submission).await.unwrap() })
            })
            .collect();
        let mut claims = Vec::new();
        for submission in submissions {
            claims.push(submission.await.unwrap());
        }
        work.release(&name);
        for claim in claims {
            assert_eq!(claim.finished().await.state, State::Succeeded);
        }
    }
    assert_eq!(work.started(20).await.len(), 20);
}

async fn dropping_the_last_claim_of_all_processes_cancels_a_job() {
    let broker = Broker::start();
    let (first, second) = (broker.connect().await, broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&second, &work);
    let one = first.submit(job("ada", "a", "wait")).await.unwrap();
    work.started(1).await;
    let other = second.submit(job("bob", "a", "wait")).await.unwrap();
    drop(one);
    assert_eq!(first.get(id("a")).await.unwrap().unwrap().state, State::Running);
    drop(other);
    assert_eq!(wait_for_end(&first, "a").await.state, State::Cancelled);
    assert_eq!(work.ended(1).await, ["a"]);
}

async fn any_process_can_cancel_a_job() {
    let broker = Broker::start();
    let (api, node, third) = (broker.connect().await, broker.connect().await, broker.connect().await);
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&node, &work);
    let claim = api.submit(job("ada", "a", "wait")).await.unwrap();
    work.started(1).await;
    while third.cancel(id("a")).await.unwrap().is_none() {}
    assert_eq!(claim.finished().await.state, State::Cancelled);
}

async fn several_workers_run_the_subtasks_of_one_job() {
    let broker = Broker::start();
    let nodes = [broker.connect().await, broker.connect().await];
    let scripts = [Arc::new(ScriptedWork::default()), Arc::new(ScriptedWork::default())];
    let _workers = [worker(&nodes[0], &scripts[0]), worker(&nodes[1], &scripts[1])];
    let claim = nodes[0].submit(job("ada", "parent", "split a=wait b=wait")).await.unwrap();
    let [mut one, other] = [scripts[0].started(1).await, scripts[1].started(1).await];
    one.extend(other);
    one.sort();
    assert_eq!(one, ["a", "b"]);
    for work in &scripts {
        work.release("a");
        work.release("b");
    }
    assert_eq!(claim.finished().await.state, State::Succeeded);
}

async fn a_submitted_job_is_known_to_other_processes_at_once() {
    let broker = Broker::start();
    let (one, other) = (broker.connect().await, broker.connect().await);
    for number in 0..50 {
        let name = format!("{number}");
        one.submit(job("ada", &name, "pass")).await.unwrap().detach();
        assert!(other.get(id(&name)).await.unwrap().is_some(), "{number}");
    }
    assert_eq!(other.get(id("never")).await.unwrap(), None);
}

async fn old_ended_jobs_are_deleted_in_all_processes() {
    let broker = Broker::start();
    let retention = Retention { count: 2, age: Duration::from_mins(10) };
    let config = Config { retention, ..broker.config() };
    let [node, other] = [JetStream::connect(config.clone()).await.unwrap(), broker.connect().await];
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&other, &work);
    for name in ["a", "b", "c", "d"] {
        node.submit(job("ada", name, "pass")).await.unwrap().finished().await;
    }
    while node.get(id("b")).await.unwrap().is_some() {}
    let page = node.list(Filter { limit: 9, ..Filter::default() }).await.unwrap();
    assert_eq!(page.jobs.iter().map(|job| job.id).collect::<Vec<_>>(), [id("d"), id("c")]);
    // A later process does not find it either, once the broker has deleted it.
    loop {
        let later = JetStream::connect(config.clone()).await.unwrap();
        if later.get(id("a")).await.unwrap().is_none() {
            break;
        }
    }
    // It can be submitted again.
    let again = node.submit(job("ada", "a", "pass")).await.unwrap().finished().await;
    assert_eq!((again.state, again.attempts), (State::Succeeded, 1));
}

async fn small_and_large_jobs_run_in_all_slots() {
    let broker = Broker::start();
    let backend = broker.connect().await;
    let work = Arc::new(ScriptedWork::default());
    let _worker = worker(&backend, &work);
    let small = |name: &str| Submission { cost: 1.0, ..job("ada", name, "wait") };
    let first = backend.submit(small("first")).await.unwrap();
    let second = backend.submit(small("second")).await.unwrap();
    work.started(2).await;
    let mut claims = vec![first, second];
    for number in 0..10 {
        claims.push(backend.submit(small(&format!("small{number}"))).await.unwrap());
        claims.push(backend.submit(job("ada", &format!("large{number}"), "wait")).await.unwrap());
    }
    work.release("first");
    work.release("second");
    for number in 0..10 {
        work.release(&format!("small{number}"));
        work.release(&format!("large{number}"));
    }
    for claim in claims {
        let end = claim.finished().await;
        assert_eq!((end.state, end.attempts), (State::Succeeded, 1));
    }
}

async fn a_worker_without_a_free_slot_leaves_jobs_to_others() {
    let broker = Broker::start();
    let nodes = [broker.connect().await, broker.connect().await];
    let scripts = [Arc::new(ScriptedWork::default()), Arc::new(ScriptedWork::default())];
    let _busy = worker(&nodes[0], &scripts[0]);
    let parent = nodes[0].submit(job("ada", "parent", "split a=wait b=pass c=pass")).await.unwrap();
    scripts[0].started(1).await;
    let large = nodes[0].submit(job("ada", "large", "pass")).await.unwrap();
    let small = Submission { cost: 1.0, ..job("ada", "small", "pass") };
    let small = nodes[0].submit(small).await.unwrap();
    assert_eq!(small.finished().await.state, State::Succeeded, "in the express slot");
    assert_eq!(scripts[0].started(2).await, ["a", "small"]);
    let _idle = worker(&nodes[1], &scripts[1]);
    assert_eq!(large.finished().await.state, State::Succeeded);
    let mut others = scripts[1].started(3).await;
    others.sort();
    assert_eq!(others, ["b", "c", "large"]);
    scripts[0].release("a");
    assert_eq!(parent.finished().await.state, State::Succeeded);
}

//! Settings of the embedded back end.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::embedded::Config;
use verne_jobs::{Backend, Embedded, Failure, Slots, State, Submission, SubmitError};

use crate::fixture::{Fixture, timed_tests};
use crate::scripted_work::{ScriptedWork, job};

timed_tests!(
    a_job_has_the_threads_of_its_slot,
    main_slots_share_the_threads,
    an_overdue_job_runs_first,
    a_slot_is_busy_while_a_job_runs_in_it,
    payloads_in_the_queue_are_bounded,
    costs_that_are_not_numbers_are_clamped,
);

async fn threads(fixture: &Fixture, name: &str, cost: f64) -> Option<Failure> {
    let submission = Submission { cost, ..job("ada", name, "threads") };
    fixture.submit(submission).await.finished().await.failure
}

async fn a_job_has_the_threads_of_its_slot() {
    let fixture = Fixture::embedded(Config { threads: 3, slots: 1, ..Config::default() });
    assert_eq!(threads(&fixture, "long", 10.0).await, Some(Failure::Work("3".into())));
    fixture.submit_detached(job("ada", "first", "wait")).await;
    assert_eq!(threads(&fixture, "small", 1.0).await, Some(Failure::Work("1".into())));
}

async fn main_slots_share_the_threads() {
    let fixture = Fixture::embedded(Config { threads: 3, slots: 2, ..Config::default() });
    fixture.submit_detached(job("ada", "first", "wait")).await;
    fixture.submit_detached(job("ada", "second", "wait")).await;
    fixture.submit_detached(job("ada", "third", "wait")).await;
    // Two at once. It does not matter which of them has two threads.
    let mut started = fixture.work.started(2).await;
    started.sort();
    assert_eq!(started, ["first", "second"]);
    assert_eq!(fixture.get("third").await.state, State::Queued);
    fixture.work.release("second");
    assert_eq!(fixture.work.started(3).await[2], "third");
}

async fn an_overdue_job_runs_first() {
    for (overdue_after, order) in
        [(Duration::ZERO, ["large", "small"]), (Duration::from_hours(1), ["small", "large"])]
    {
        let fixture = Fixture::embedded(Config { overdue_after, ..Config::default() });
        fixture.submit_detached(job("ada", "first", "wait")).await;
        fixture.work.started(1).await;
        fixture.submit_detached(job("the guest", "guest", "wait")).await;
        fixture.work.started(2).await;
        fixture.submit_detached(Submission { cost: 1000.0, ..job("ada", "large", "pass") }).await;
        fixture.submit_detached(Submission { cost: 5.0, ..job("bob", "small", "pass") }).await;
        fixture.work.release("first");
        assert_eq!(fixture.work.started(4).await[2..], order);
    }
}

async fn a_slot_is_busy_while_a_job_runs_in_it() {
    let work = Arc::new(ScriptedWork::default());
    let config = Config { threads: 2, slots: 2, ..Config::default() };
    let jobs = Embedded::open(config, work.clone()).unwrap();
    let free = Slots { total: 4, busy: 0 };
    assert_eq!(jobs.slots(), free);
    let claim = jobs.submit(job("ada", "a", "wait")).await.unwrap();
    work.started(1).await;
    assert_eq!(jobs.slots(), Slots { busy: 1, ..free });
    work.release("a");
    claim.finished().await;
    assert_eq!(jobs.slots(), free);
}

async fn payloads_in_the_queue_are_bounded() {
    let fixture = Fixture::embedded(Config { queue_bytes: 20, ..Config::default() });
    fixture.submit_detached(job("ada", "first", "wait")).await;
    fixture.submit_detached(job("ada", "twelve", "pass")).await;
    let refused = fixture.backend.submit(job("ada", "twelve more", "pass")).await.unwrap_err();
    assert!(matches!(refused, SubmitError::Full { .. }), "{refused}");
    fixture.submit_detached(job("ada", "one", "pass")).await;
}

async fn costs_that_are_not_numbers_are_clamped() {
    let fixture = Fixture::embedded(Config::default());
    fixture.submit_detached(job("ada", "first", "wait")).await;
    fixture.work.started(1).await;
    fixture.submit_detached(job("the guest", "guest", "wait")).await;
    fixture.work.started(2).await;
    for (name, cost) in [("nan", f64::NAN), ("infinite", f64::INFINITY), ("negative", -1.0)] {
        fixture.submit_detached(Submission { cost, ..job(name, name, "pass") }).await;
    }
    fixture.submit_detached(job("bob", "good", "pass")).await;
    fixture.work.release("first");
    let mut started = fixture.work.started(6).await;
    started.retain(|name| name != "negative");
    assert_eq!(started, ["first", "guest", "good", "nan", "infinite"]);
}

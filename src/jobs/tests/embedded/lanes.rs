//! Threads, places and bounds of the embedded back end.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::embedded::Config;
use verne_jobs::{Backend, Embedded, Failure, Seats, State, Submission, SubmitError};

use crate::stage::{Stage, job};
use crate::stand::{Stand, within_a_minute};

async fn threads(stand: &Stand, name: &str, cost: f64) -> Option<Failure> {
    let submission = Submission { cost, ..job("ada", name, "threads") };
    stand.submit(submission).await.finished().await.failure
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_has_its_lanes_threads() {
    within_a_minute(async {
        let stand = Stand::at(Config { threads: 3, slots: 1, ..Config::default() });
        assert_eq!(threads(&stand, "long", 10.0).await, Some(Failure::Work("3".into())));
        stand.leave(job("ada", "first", "hold")).await;
        assert_eq!(threads(&stand, "small", 1.0).await, Some(Failure::Work("1".into())));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn threads_are_dealt_out_among_the_slots() {
    within_a_minute(async {
        let stand = Stand::at(Config { threads: 3, slots: 2, ..Config::default() });
        stand.leave(job("ada", "first", "hold")).await;
        stand.leave(job("ada", "second", "hold")).await;
        stand.leave(job("ada", "third", "hold")).await;
        // Two at once; which of them has two threads does not matter.
        let mut begun = stand.stage.begun(2).await;
        begun.sort();
        assert_eq!(begun, ["first", "second"]);
        assert_eq!(stand.get("third").await.state, State::Queued);
        stand.stage.open("second");
        assert_eq!(stand.stage.begun(3).await[2], "third");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_overdue_job_goes_first() {
    within_a_minute(async {
        for (overdue, order) in
            [(Duration::ZERO, ["large", "small"]), (Duration::from_hours(1), ["small", "large"])]
        {
            let stand = Stand::at(Config { overdue, ..Config::default() });
            stand.leave(job("ada", "first", "hold")).await;
            stand.stage.begun(1).await;
            stand.leave(job("the guest", "guest", "hold")).await;
            stand.stage.begun(2).await;
            stand.leave(Submission { cost: 1000.0, ..job("ada", "large", "pass") }).await;
            stand.leave(Submission { cost: 5.0, ..job("bob", "small", "pass") }).await;
            stand.stage.open("first");
            assert_eq!(stand.stage.begun(4).await[2..], order);
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_seat_is_busy_while_a_job_runs_there() {
    within_a_minute(async {
        let stage = Arc::new(Stage::default());
        let config = Config { threads: 2, slots: 2, ..Config::default() };
        let jobs = Embedded::open(config, stage.clone()).unwrap();
        let free = Seats { all: 4, busy: 0 };
        assert_eq!(jobs.seats(), free);
        let claim = jobs.submit(job("ada", "a", "hold")).await.unwrap();
        stage.begun(1).await;
        assert_eq!(jobs.seats(), Seats { busy: 1, ..free });
        stage.open("a");
        claim.finished().await;
        assert_eq!(jobs.seats(), free);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn payloads_in_the_queue_are_bounded() {
    within_a_minute(async {
        let stand = Stand::at(Config { queue_bytes: 20, ..Config::default() });
        stand.leave(job("ada", "first", "hold")).await;
        stand.leave(job("ada", "twelve", "pass")).await;
        let refused = stand.backend.submit(job("ada", "twelve more", "pass")).await.unwrap_err();
        assert!(matches!(refused, SubmitError::Full { .. }), "{refused}");
        stand.leave(job("ada", "one", "pass")).await;
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn costs_that_are_no_numbers_do_no_harm() {
    within_a_minute(async {
        let stand = Stand::at(Config::default());
        stand.leave(job("ada", "first", "hold")).await;
        stand.stage.begun(1).await;
        stand.leave(job("the guest", "guest", "hold")).await;
        stand.stage.begun(2).await;
        for (name, cost) in [("nan", f64::NAN), ("infinite", f64::INFINITY), ("negative", -1.0)] {
            stand.leave(Submission { cost, ..job(name, name, "pass") }).await;
        }
        stand.leave(job("bob", "good", "pass")).await;
        stand.stage.open("first");
        let mut begun = stand.stage.begun(6).await;
        begun.retain(|name| name != "negative");
        assert_eq!(begun, ["first", "guest", "good", "nan", "infinite"]);
    })
    .await;
}

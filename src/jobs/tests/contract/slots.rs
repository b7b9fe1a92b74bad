//! Which clients' jobs have the slots. There is one main slot.

use verne_jobs::embedded::Config;
use verne_jobs::{State, Submission};

use crate::fixture::{Open, for_each_backend, for_each_embedded};
use crate::scripted_work::job;

for_each_backend!(
    one_client_does_not_get_all_slots,
    a_job_that_exceeds_its_estimate_leaves_the_express_slot,
    small_jobs_of_one_client_do_not_delay_those_of_another,
);

mod embedded_only {
    use super::*;
    for_each_embedded!(the_last_free_slot_is_for_another_client);
}

async fn one_client_does_not_get_all_slots(open: Open) {
    let fixture = open(1000);
    fixture.submit_detached(job("ada", "a1", "wait")).await;
    fixture.work.started(1).await;
    for number in 2..=9 {
        fixture.submit_detached(job("ada", &format!("a{number}"), "wait")).await;
    }
    for name in ["b1", "b2"] {
        assert_eq!(fixture.submit(job("bob", name, "pass")).await.finished().await.state, State::Succeeded);
    }
    assert_eq!(fixture.work.started(3).await, ["a1", "b1", "b2"]);
    assert_eq!(fixture.get("a1").await.state, State::Running);
    assert_eq!(fixture.get("a2").await.state, State::Queued);
}

async fn the_last_free_slot_is_for_another_client(open: Open) {
    let fixture = open(1000);
    fixture.submit_detached(job("ada", "a1", "wait")).await;
    fixture.submit_detached(job("bob", "b1", "wait")).await;
    fixture.work.started(2).await;
    fixture.submit_detached(Submission { cost: 3.0, ..job("bob", "b2", "pass") }).await;
    fixture.submit_detached(Submission { cost: 900.0, ..job("ada", "a2", "pass") }).await;
    fixture.work.release("a1");
    // The other is much smaller, but its client has the guest slot.
    assert_eq!(fixture.work.started(4).await[2..], ["a2", "b2"]);
}

/// Its estimate is small, so it blocks the slot for small jobs.
async fn a_job_that_exceeds_its_estimate_leaves_the_express_slot(open: Open) {
    let fixture = open(1000);
    fixture.submit_detached(job("ada", "first", "wait")).await;
    fixture.work.started(1).await;
    let small = |name, verb| Submission { cost: 0.001, ..job("ada", name, verb) };
    fixture.submit_detached(small("underestimated", "wait")).await;
    fixture.work.started(2).await;
    let passes = fixture.submit(small("small", "pass")).await;
    assert_eq!(passes.finished().await.state, State::Succeeded);
    let long = fixture.get("underestimated").await;
    // It is no small job any more, so it is stopped and queued again once only.
    assert!(!long.state.is_final() && long.cost > Config::default().small_cost, "{long:?}");
    fixture.work.release("underestimated");
    fixture.work.release("first");
    let long = fixture.wait_for_end("underestimated").await;
    assert!(long.state == State::Succeeded && long.attempts > 1, "{long:?}");
}

async fn small_jobs_of_one_client_do_not_delay_those_of_another(open: Open) {
    let fixture = open(1000);
    let small = |client, name: &str, verb| Submission { cost: 0.001, ..job(client, name, verb) };
    fixture.submit_detached(job("ada", "first", "wait")).await;
    fixture.work.started(1).await;
    for number in 0..20 {
        fixture.submit_detached(small("ada", &format!("a{number}"), "wait")).await;
    }
    let other = fixture.submit(small("bob", "b", "pass")).await;
    assert_eq!(other.finished().await.state, State::Succeeded);
    assert_eq!(fixture.get("first").await.state, State::Running);
}

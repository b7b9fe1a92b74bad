//! The order of jobs. While they are submitted, a job occupies the main slot and one of another client the guest slot.

use verne_jobs::{State, Submission};

use crate::fixture::{Fixture, Open, for_each_backend, for_each_embedded};
use crate::scripted_work::job;

for_each_backend!(a_small_job_overtakes_a_large_one, a_large_job_does_not_use_the_express_slot);

mod fair_queueing {
    use super::*;
    for_each_embedded!(
        a_client_with_one_job_is_served_before_one_with_many,
        clients_take_turns_by_cost,
        jobs_of_lower_cost_run_first,
        a_job_moves_up_when_a_better_placed_client_submits_it,
        a_job_does_not_move_back_when_another_client_submits_it,
        jobs_of_other_clients_run_between_subtasks,
        a_parent_and_its_subtasks_have_one_share,
        jobs_in_the_express_slot_do_not_set_other_clients_back,
    );
}

async fn with_busy_slots(open: Open) -> Fixture {
    let fixture = open(1000);
    fixture.submit_detached(job("the first", "first", "wait")).await;
    fixture.work.started(1).await;
    fixture.submit_detached(job("the guest", "guest", "wait")).await;
    fixture.work.started(2).await;
    fixture
}

async fn order(fixture: &Fixture, count: usize) -> Vec<String> {
    fixture.work.release("first");
    fixture.work.started(count + 2).await.split_off(2)
}

fn costing(cost: f64, job: Submission) -> Submission {
    Submission { cost, ..job }
}

async fn a_client_with_one_job_is_served_before_one_with_many(open: Open) {
    let fixture = with_busy_slots(open).await;
    for number in 0..100 {
        fixture.submit_detached(job("ada", &format!("a{number}"), "pass")).await;
    }
    fixture.submit_detached(job("bob", "b", "pass")).await;
    let order = order(&fixture, 101).await;
    assert_eq!(order[..3], ["a0", "b", "a1"]);
    assert_eq!(order.last().unwrap(), "a99");
}

async fn clients_take_turns_by_cost(open: Open) {
    let fixture = with_busy_slots(open).await;
    for number in 1..=3 {
        fixture.submit_detached(costing(30.0, job("ada", &format!("a{number}"), "pass"))).await;
    }
    for number in 1..=6 {
        fixture.submit_detached(costing(14.0, job("bob", &format!("b{number}"), "pass"))).await;
    }
    assert_eq!(order(&fixture, 9).await, ["b1", "b2", "a1", "b3", "b4", "a2", "b5", "b6", "a3"]);
}

async fn jobs_of_lower_cost_run_first(open: Open) {
    let fixture = with_busy_slots(open).await;
    fixture.submit_detached(costing(300.0, job("ada", "large", "pass"))).await;
    fixture.submit_detached(costing(20.0, job("bob", "middling", "pass"))).await;
    fixture.submit_detached(costing(10.0, job("eve", "little", "pass"))).await;
    assert_eq!(order(&fixture, 3).await, ["little", "middling", "large"]);
}

async fn a_job_moves_up_when_a_better_placed_client_submits_it(open: Open) {
    let fixture = with_busy_slots(open).await;
    for name in ["a1", "a2", "a3", "a4"] {
        fixture.submit_detached(job("ada", name, "pass")).await;
    }
    fixture.submit_detached(job("bob", "b1", "pass")).await;
    fixture.submit_detached(job("eve", "a4", "pass")).await;
    assert_eq!(order(&fixture, 5).await, ["a1", "a4", "b1", "a2", "a3"]);
}

async fn a_job_does_not_move_back_when_another_client_submits_it(open: Open) {
    let fixture = with_busy_slots(open).await;
    fixture.submit_detached(job("ada", "a", "pass")).await;
    for name in ["b1", "b2"] {
        fixture.submit_detached(costing(12.0, job("bob", name, "pass"))).await;
    }
    fixture.submit_detached(job("bob", "a", "pass")).await;
    assert_eq!(order(&fixture, 3).await, ["a", "b1", "b2"]);
}

async fn a_small_job_overtakes_a_large_one(open: Open) {
    let fixture = with_busy_slots(open).await;
    fixture.submit_detached(job("ada", "waits", "pass")).await;
    let small = fixture.submit(costing(1.0, job("bob", "small", "pass"))).await;
    assert_eq!(small.finished().await.state, State::Succeeded);
    assert_eq!(fixture.get("first").await.state, State::Running);
    assert_eq!(fixture.get("waits").await.state, State::Queued);
}

async fn a_large_job_does_not_use_the_express_slot(open: Open) {
    let fixture = with_busy_slots(open).await;
    fixture.submit_detached(costing(2.5, job("ada", "large", "pass"))).await;
    fixture.submit(costing(2.0, job("bob", "small", "pass"))).await.finished().await;
    assert_eq!(fixture.get("large").await.state, State::Queued);
}

async fn jobs_in_the_express_slot_do_not_set_other_clients_back(open: Open) {
    let fixture = with_busy_slots(open).await;
    for number in 0..10 {
        fixture.submit_detached(job("ada", &format!("a{number}"), "pass")).await;
    }
    for number in 0..60 {
        fixture.submit(costing(2.0, job("eve", &format!("e{number}"), "pass"))).await.finished().await;
    }
    fixture.submit_detached(job("bob", "b", "pass")).await;
    fixture.work.release("first");
    let started = fixture.work.started(73).await;
    assert_eq!(started[62..65], ["a0", "a1", "b"]);
}

async fn jobs_of_other_clients_run_between_subtasks(open: Open) {
    let fixture = open(1000);
    fixture.submit_detached(job("the guest", "guest", "wait")).await;
    fixture.work.started(1).await;
    fixture.submit_detached(costing(100.0, job("ada", "a", "split a1=wait a2=pass a3=pass a4=pass"))).await;
    fixture.work.started(2).await;
    fixture.submit_detached(costing(15.0, job("bob", "b", "pass"))).await;
    fixture.work.release("a1");
    assert_eq!(fixture.work.started(7).await, ["guest", "a1", "a2", "b", "a3", "a4", "a"]);
}

async fn a_parent_and_its_subtasks_have_one_share(open: Open) {
    let fixture = with_busy_slots(open).await;
    fixture.submit_detached(costing(30.0, job("ada", "a", "split a1=pass=15 a2=pass=15"))).await;
    fixture.submit_detached(costing(30.0, job("ada", "next", "pass"))).await;
    for number in 1..=4 {
        fixture.submit_detached(costing(14.0, job("bob", &format!("b{number}"), "pass"))).await;
    }
    // The parent leaves the queue when it would as one job; its subtasks are next then.
    assert_eq!(order(&fixture, 8).await, ["b1", "b2", "a1", "a2", "a", "b3", "b4", "next"]);
}

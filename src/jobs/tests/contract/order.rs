//! Which job is next. A job holds the only place of the main lane, and one of another client that of the guest lane,
//! while the others are submitted.

use verne_jobs::{State, Submission};

use crate::stage::job;
use crate::stand::{Open, Stand, for_each_backend, for_each_embedded};

for_each_backend!(a_small_job_passes_a_long_one, a_large_job_does_not_take_the_express_lane);

// Clients' shares.
mod shares {
    use super::*;
    for_each_embedded!(
        many_jobs_of_one_do_not_starve_anothers_one,
        clients_take_turns_by_cost,
        small_jobs_go_before_large_ones,
        a_joined_job_moves_up,
        a_joined_job_does_not_move_back,
        others_pass_between_parts,
        a_job_of_parts_is_charged_once,
        what_passes_by_the_express_lane_does_not_set_others_back,
    );
}

async fn held(open: Open) -> Stand {
    let stand = open(1000);
    stand.leave(job("the first", "first", "hold")).await;
    stand.stage.begun(1).await;
    stand.leave(job("the guest", "guest", "hold")).await;
    stand.stage.begun(2).await;
    stand
}

async fn order(stand: &Stand, count: usize) -> Vec<String> {
    stand.stage.open("first");
    stand.stage.begun(count + 2).await.split_off(2)
}

fn costing(cost: f64, job: Submission) -> Submission {
    Submission { cost, ..job }
}

async fn many_jobs_of_one_do_not_starve_anothers_one(open: Open) {
    let stand = held(open).await;
    for number in 0..100 {
        stand.leave(job("ada", &format!("a{number}"), "pass")).await;
    }
    stand.leave(job("bob", "b", "pass")).await;
    let order = order(&stand, 101).await;
    assert_eq!(order[..3], ["a0", "b", "a1"]);
    assert_eq!(order.last().unwrap(), "a99");
}

async fn clients_take_turns_by_cost(open: Open) {
    let stand = held(open).await;
    for number in 1..=3 {
        stand.leave(costing(30.0, job("ada", &format!("a{number}"), "pass"))).await;
    }
    for number in 1..=6 {
        stand.leave(costing(14.0, job("bob", &format!("b{number}"), "pass"))).await;
    }
    assert_eq!(order(&stand, 9).await, ["b1", "b2", "a1", "b3", "b4", "a2", "b5", "b6", "a3"]);
}

async fn small_jobs_go_before_large_ones(open: Open) {
    let stand = held(open).await;
    stand.leave(costing(300.0, job("ada", "large", "pass"))).await;
    stand.leave(costing(20.0, job("bob", "middling", "pass"))).await;
    stand.leave(costing(10.0, job("eve", "little", "pass"))).await;
    assert_eq!(order(&stand, 3).await, ["little", "middling", "large"]);
}

async fn a_joined_job_moves_up(open: Open) {
    let stand = held(open).await;
    for name in ["a1", "a2", "a3", "a4"] {
        stand.leave(job("ada", name, "pass")).await;
    }
    stand.leave(job("bob", "b1", "pass")).await;
    stand.leave(job("eve", "a4", "pass")).await;
    assert_eq!(order(&stand, 5).await, ["a1", "a4", "b1", "a2", "a3"]);
}

async fn a_joined_job_does_not_move_back(open: Open) {
    let stand = held(open).await;
    stand.leave(job("ada", "a", "pass")).await;
    for name in ["b1", "b2"] {
        stand.leave(costing(12.0, job("bob", name, "pass"))).await;
    }
    stand.leave(job("bob", "a", "pass")).await;
    assert_eq!(order(&stand, 3).await, ["a", "b1", "b2"]);
}

async fn a_small_job_passes_a_long_one(open: Open) {
    let stand = held(open).await;
    stand.leave(job("ada", "waits", "pass")).await;
    let small = stand.submit(costing(1.0, job("bob", "small", "pass"))).await;
    assert_eq!(small.finished().await.state, State::Succeeded);
    assert_eq!(stand.get("first").await.state, State::Running);
    assert_eq!(stand.get("waits").await.state, State::Queued);
}

async fn a_large_job_does_not_take_the_express_lane(open: Open) {
    let stand = held(open).await;
    stand.leave(costing(2.5, job("ada", "large", "pass"))).await;
    stand.submit(costing(2.0, job("bob", "small", "pass"))).await.finished().await;
    assert_eq!(stand.get("large").await.state, State::Queued);
}

async fn what_passes_by_the_express_lane_does_not_set_others_back(open: Open) {
    let stand = held(open).await;
    for number in 0..10 {
        stand.leave(job("ada", &format!("a{number}"), "pass")).await;
    }
    for number in 0..60 {
        stand.submit(costing(2.0, job("eve", &format!("e{number}"), "pass"))).await.finished().await;
    }
    stand.leave(job("bob", "b", "pass")).await;
    stand.stage.open("first");
    let begun = stand.stage.begun(73).await;
    assert_eq!(begun[62..65], ["a0", "a1", "b"]);
}

async fn others_pass_between_parts(open: Open) {
    let stand = open(1000);
    stand.leave(job("the guest", "guest", "hold")).await;
    stand.stage.begun(1).await;
    stand.leave(costing(100.0, job("ada", "a", "split a1=hold a2=pass a3=pass a4=pass"))).await;
    stand.stage.begun(2).await;
    stand.leave(costing(15.0, job("bob", "b", "pass"))).await;
    stand.stage.open("a1");
    assert_eq!(stand.stage.begun(7).await, ["guest", "a1", "a2", "b", "a3", "a4", "a"]);
}

async fn a_job_of_parts_is_charged_once(open: Open) {
    let stand = held(open).await;
    stand.leave(costing(30.0, job("ada", "a", "split a1=pass=15 a2=pass=15"))).await;
    stand.leave(costing(30.0, job("ada", "next", "pass"))).await;
    for number in 1..=4 {
        stand.leave(costing(14.0, job("bob", &format!("b{number}"), "pass"))).await;
    }
    // Its turn comes when it would have as one; what it asked for then is due.
    assert_eq!(order(&stand, 8).await, ["b1", "b2", "a1", "a2", "a", "b3", "b4", "next"]);
}

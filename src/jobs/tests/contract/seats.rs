//! Whose jobs have the seats. There is one seat in the main lane, one in the express lane and one in the guest lane.

use verne_jobs::{State, Submission};

use crate::stage::job;
use crate::stand::{Open, for_each_backend, for_each_embedded};

for_each_backend!(
    one_client_does_not_take_all_seats,
    an_overrunning_job_yields_to_small_ones,
    small_jobs_of_one_do_not_keep_anothers_waiting,
);

mod last {
    use super::*;
    for_each_embedded!(the_last_seat_is_for_another_client);
}

async fn one_client_does_not_take_all_seats(open: Open) {
    let stand = open(1000);
    stand.leave(job("ada", "a1", "hold")).await;
    stand.stage.begun(1).await;
    for number in 2..=9 {
        stand.leave(job("ada", &format!("a{number}"), "hold")).await;
    }
    for name in ["b1", "b2"] {
        assert_eq!(stand.submit(job("bob", name, "pass")).await.finished().await.state, State::Succeeded);
    }
    assert_eq!(stand.stage.begun(3).await, ["a1", "b1", "b2"]);
    assert_eq!(stand.get("a1").await.state, State::Running);
    assert_eq!(stand.get("a2").await.state, State::Queued);
}

async fn the_last_seat_is_for_another_client(open: Open) {
    let stand = open(1000);
    stand.leave(job("ada", "a1", "hold")).await;
    stand.leave(job("bob", "b1", "hold")).await;
    stand.stage.begun(2).await;
    stand.leave(Submission { cost: 3.0, ..job("bob", "b2", "pass") }).await;
    stand.leave(Submission { cost: 900.0, ..job("ada", "a2", "pass") }).await;
    stand.stage.open("a1");
    // Though the other is much smaller: its client has the guest lane.
    assert_eq!(stand.stage.begun(4).await[2..], ["a2", "b2"]);
}

/// Its estimate made it small; where small jobs run it is in the way.
async fn an_overrunning_job_yields_to_small_ones(open: Open) {
    let stand = open(1000);
    stand.leave(job("ada", "first", "hold")).await;
    stand.stage.begun(1).await;
    let small = |name, verb| Submission { cost: 0.001, ..job("ada", name, verb) };
    stand.leave(small("liar", "hold")).await;
    stand.stage.begun(2).await;
    let passes = stand.submit(small("small", "pass")).await;
    assert_eq!(passes.finished().await.state, State::Succeeded);
    let liar = stand.get("liar").await;
    assert!(!liar.state.is_final() && liar.cost >= 1.0, "{liar:?}");
    stand.stage.open("liar");
    stand.stage.open("first");
    let liar = stand.end("liar").await;
    assert!(liar.state == State::Succeeded && liar.attempts > 1, "{liar:?}");
}

async fn small_jobs_of_one_do_not_keep_anothers_waiting(open: Open) {
    let stand = open(1000);
    let small = |client, name: &str, verb| Submission { cost: 0.001, ..job(client, name, verb) };
    stand.leave(job("ada", "first", "hold")).await;
    stand.stage.begun(1).await;
    for number in 0..20 {
        stand.leave(small("ada", &format!("a{number}"), "hold")).await;
    }
    let other = stand.submit(small("bob", "b", "pass")).await;
    assert_eq!(other.finished().await.state, State::Succeeded);
    assert_eq!(stand.get("first").await.state, State::Running);
}

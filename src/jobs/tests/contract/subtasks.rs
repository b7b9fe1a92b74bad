//! Jobs with subtasks.

use verne_jobs::{Counts, Failure, Filter, State, Submission, SubmitError};

use crate::fixture::{Fixture, Open, for_each_backend};
use crate::scripted_work::{id, job};

for_each_backend!(
    a_parent_merges_its_subtasks,
    equal_subtasks_are_computed_once,
    a_failed_subtask_fails_its_parent,
    a_cancelled_subtask_cancels_its_parent,
    a_cancelled_parent_cancels_its_subtasks,
    dropping_the_last_claim_on_a_parent_cancels_its_subtasks,
    a_subtask_with_other_claims_continues_without_its_parent,
    progress_of_a_parent_is_the_mean_weighted_by_cost,
    subtasks_wait_for_room_in_the_queue,
    one_parent_does_not_fill_the_queue,
    waiting_parents_take_room_in_the_queue,
    small_subtasks_of_a_large_job_do_not_use_the_express_slot,
    a_small_parent_overtakes_a_subtask_of_a_large_one,
    subtasks_are_not_listed,
    subtasks_that_clients_submitted_are_listed,
    a_subtask_can_have_subtasks,
    an_error_while_naming_subtasks_fails_the_job,
    a_job_that_is_its_own_subtask_fails,
    a_deadline_stops_a_waiting_parent,
);

async fn a_parent_merges_its_subtasks(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "parent", "split a=pass b=pass a=pass")).await.finished().await;
    assert_eq!((end.state, end.progress, end.attempts), (State::Succeeded, 1.0, 1));
    assert_eq!(fixture.work.started(3).await, ["a", "b", "parent"]);
    let subtask = fixture.get("a").await;
    assert_eq!((subtask.state, subtask.client.as_str()), (State::Succeeded, "ada"));
    assert_eq!(fixture.backend.counts(), Counts { started: 3, succeeded: 3, ..Counts::default() });
}

/// A small parent, so that the express slot starts it while a subtask has the main slot.
fn small(name: &str, subtasks: &str) -> Submission {
    Submission { cost: 1.0, ..job("bob", name, &format!("split {subtasks}")) }
}

async fn equal_subtasks_are_computed_once(open: Open) {
    let fixture = open(10);
    let first = fixture.submit(job("ada", "first", "split a=wait")).await;
    fixture.work.started(1).await;
    let second = fixture.submit(small("second", "a=wait b=pass")).await;
    // Subtasks are submitted in order.
    while fixture.backend.get(id("b")).await.unwrap().is_none() {}
    fixture.work.release("a");
    assert_eq!(first.finished().await.state, State::Succeeded);
    assert_eq!(second.finished().await.state, State::Succeeded);
    let mut started = fixture.work.started(4).await;
    started.sort();
    assert_eq!(started, ["a", "b", "first", "second"]);
}

async fn a_failed_subtask_fails_its_parent(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "parent", "split a=fail b=wait")).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Work("as told".into()))));
    assert_eq!(fixture.get("a").await.state, State::Failed);
    assert_eq!(fixture.wait_for_end("b").await.state, State::Cancelled);
}

async fn a_cancelled_subtask_cancels_its_parent(open: Open) {
    let fixture = open(10);
    let parent = fixture.submit(job("ada", "parent", "split a=wait b=wait")).await;
    fixture.work.started(1).await;
    fixture.backend.cancel(id("a")).await.unwrap().unwrap();
    assert_eq!(parent.finished().await.state, State::Cancelled);
    assert_eq!(fixture.wait_for_end("b").await.state, State::Cancelled);
}

async fn a_cancelled_parent_cancels_its_subtasks(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "parent", "split a=wait b=wait")).await;
    fixture.work.started(1).await;
    fixture.backend.cancel(id("parent")).await.unwrap().unwrap();
    for name in ["parent", "a", "b"] {
        assert_eq!(fixture.wait_for_end(name).await.state, State::Cancelled);
    }
    assert_eq!(fixture.submit(job("ada", "c", "pass")).await.finished().await.state, State::Succeeded);
}

async fn dropping_the_last_claim_on_a_parent_cancels_its_subtasks(open: Open) {
    let fixture = open(10);
    let claim = fixture.submit(job("ada", "parent", "split a=wait b=wait")).await;
    fixture.work.started(1).await;
    drop(claim);
    for name in ["parent", "a", "b"] {
        assert_eq!(fixture.wait_for_end(name).await.state, State::Cancelled);
    }
}

async fn a_subtask_with_other_claims_continues_without_its_parent(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "parent", "split a=wait b=pass")).await;
    fixture.work.started(1).await;
    let (a, b) =
        (fixture.submit(job("bob", "a", "wait")).await, fixture.submit(job("bob", "b", "pass")).await);
    fixture.backend.cancel(id("parent")).await.unwrap();
    fixture.work.release("a");
    assert_eq!((a.finished().await.state, b.finished().await.state), (State::Succeeded, State::Succeeded));
    assert_eq!(fixture.work.started(2).await, ["a", "b"]);
}

async fn progress_of_a_parent_is_the_mean_weighted_by_cost(open: Open) {
    let fixture = open(10);
    let parent = fixture.submit(job("ada", "parent", "split-progress a=pass=10 b=progress=30")).await;
    let mut watcher = parent.watch();
    let mut seen = Vec::new();
    for fraction in [0.2, 0.5] {
        let expected = 0.95 * (10.0 + 30.0 * fraction) / 40.0;
        while seen.last().is_none_or(|last: &f64| (last - expected).abs() > 2e-3) {
            seen.push(watcher.next().await.unwrap().progress);
        }
        for gate in if fraction == 0.2 { ["b-0.2", "b-0.1", "b-NaN"] } else { ["b-0.5", "b-0.3", ""] } {
            fixture.work.release(gate);
        }
    }
    // The merge.
    for fraction in ["0.2", "0.1", "NaN"] {
        fixture.work.release(&format!("parent-{fraction}"));
    }
    let expected = 0.95 + 0.05 * 0.5;
    while seen.last().is_none_or(|last| (last - expected).abs() > 2e-3) {
        seen.push(watcher.next().await.unwrap().progress);
    }
    fixture.work.release("parent-0.5");
    fixture.work.release("parent-0.3");
    assert_eq!(parent.finished().await.progress, 1.0);
    assert!(seen.is_sorted(), "{seen:?}");
}

fn many(first: &str, count: usize) -> String {
    let others: Vec<_> = (1..count).map(|number| format!("{number}=pass")).collect();
    format!("split {first} {}", others.join(" "))
}

async fn subtasks_wait_for_room_in_the_queue(open: Open) {
    let fixture = open(3);
    let parent = fixture.submit(job("ada", "parent", &many("first=wait", 20))).await;
    fixture.work.started(1).await;
    until_queued(&fixture, 3).await;
    let refused = fixture.backend.submit(job("bob", "b", "pass")).await.unwrap_err();
    assert!(matches!(refused, SubmitError::Full { .. }), "{refused}");
    fixture.work.release("first");
    assert_eq!(parent.finished().await.state, State::Succeeded);
    assert_eq!(fixture.work.started(21).await.len(), 21);
    assert_eq!(fixture.submit(job("bob", "b", "pass")).await.finished().await.state, State::Succeeded);
}

async fn one_parent_does_not_fill_the_queue(open: Open) {
    let fixture = open(1000);
    let parent = fixture.submit(job("ada", "parent", &many("first=wait", 400))).await;
    fixture.work.started(1).await;
    until_queued(&fixture, 255).await;
    fixture.submit(Submission { cost: 1.0, ..job("bob", "b", "pass") }).await.finished().await;
    assert_eq!(fixture.backend.counts().queued, 255);
    fixture.work.release("first");
    assert_eq!(parent.finished().await.state, State::Succeeded);
}

async fn until_queued(fixture: &Fixture, count: usize) {
    while fixture.backend.counts().queued < count {
        tokio::task::yield_now().await;
    }
}

/// Otherwise more and more jobs could be accepted as each is split.
async fn waiting_parents_take_room_in_the_queue(open: Open) {
    let fixture = open(2);
    let first = fixture.submit(small("first", "a=wait b=pass")).await;
    fixture.work.started(1).await;
    until_queued(&fixture, 1).await;
    let refused = fixture.backend.submit(small("second", "c=pass")).await.unwrap_err();
    assert!(matches!(refused, SubmitError::Full { .. }), "{refused}");
    fixture.work.release("a");
    first.finished().await;
    let second = fixture.submit(small("second", "c=pass")).await;
    assert_eq!(second.finished().await.state, State::Succeeded);
}

async fn listed(fixture: &Fixture) -> Vec<String> {
    let page = fixture.backend.list(Filter { limit: 100, ..Filter::default() }).await.unwrap();
    let name = |payload: &[u8]| String::from_utf8_lossy(payload).split(' ').next().unwrap().to_owned();
    page.jobs.iter().map(|job| name(&job.payload)).collect()
}

async fn small_subtasks_of_a_large_job_do_not_use_the_express_slot(open: Open) {
    let fixture = open(10);
    let parent = fixture.submit(job("ada", "parent", "split a=wait=1 b=wait=1")).await;
    fixture.work.started(1).await;
    let c = Submission { cost: 1.0, ..job("bob", "c", "pass") };
    assert_eq!(fixture.submit(c).await.finished().await.state, State::Succeeded);
    assert_eq!(fixture.work.started(2).await, ["a", "c"]);
    fixture.work.release("a");
    fixture.work.release("b");
    assert_eq!(parent.finished().await.state, State::Succeeded);
}

async fn a_small_parent_overtakes_a_subtask_of_a_large_one(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "parent", "split a=wait=1 b=wait=1")).await;
    fixture.work.started(1).await;
    let second = Submission { client: "ada".to_owned(), ..small("second", "c=pass=0.5 d=pass=0.5") };
    let parent = fixture.submit(second).await;
    assert_eq!(parent.finished().await.state, State::Succeeded);
    assert_eq!(fixture.work.started(4).await, ["a", "c", "d", "second"]);
}

async fn subtasks_are_not_listed(open: Open) {
    let fixture = open(10);
    let parent = fixture.submit(job("ada", "parent", "split a=wait b=fail")).await;
    fixture.work.started(1).await;
    assert_eq!(listed(&fixture).await, ["parent"]);
    let page =
        fixture.backend.list(Filter { state: Some(State::Running), limit: 9, ..Filter::default() }).await;
    assert_eq!(page.unwrap().jobs.len(), 1);
    fixture.work.release("a");
    parent.finished().await;
    assert_eq!(listed(&fixture).await, ["parent"]);
}

async fn subtasks_that_clients_submitted_are_listed(open: Open) {
    let fixture = open(10);
    fixture.submit(job("bob", "before", "pass")).await.finished().await;
    let parent = fixture.submit(job("ada", "parent", "split a=wait before=pass during=pass")).await;
    fixture.work.started(2).await;
    fixture.submit_detached(job("eve", "during", "pass")).await;
    fixture.work.release("a");
    assert_eq!(parent.finished().await.state, State::Succeeded);
    let mut names = listed(&fixture).await;
    names.sort();
    assert_eq!(names, ["before", "during", "parent"]);
}

async fn a_subtask_can_have_subtasks(open: Open) {
    let fixture = open(10);
    let end =
        fixture.submit(job("ada", "parent", "split a=split+b:pass+c:pass d=pass")).await.finished().await;
    assert_eq!(end.state, State::Succeeded);
    let started = fixture.work.started(5).await;
    let position = |name: &str| started.iter().position(|started| started == name).unwrap();
    assert!(position("b") < position("a") && position("c") < position("a"));
    assert_eq!(started[4], "parent");
}

async fn an_error_while_naming_subtasks_fails_the_job(open: Open) {
    let fixture = open(10);
    for (name, verb, failure) in [
        ("a", "split-fail", Failure::Work("as told".into())),
        ("b", "split-panic", Failure::Panicked("as told".to_owned())),
    ] {
        let end = fixture.submit(job("ada", name, verb)).await.finished().await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(failure)));
    }
    assert_eq!(fixture.submit(job("ada", "c", "pass")).await.finished().await.state, State::Succeeded);
}

async fn a_job_that_is_its_own_subtask_fails(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "a", "split b=pass a=pass")).await.finished().await;
    assert!(matches!(end.failure, Some(Failure::Panicked(_))), "{end:?}");
}

async fn a_deadline_stops_a_waiting_parent(open: Open) {
    let fixture = open(10);
    let urgent = Submission {
        deadline: Some(std::time::Duration::from_millis(500)),
        ..job("ada", "parent", "split a=wait b=wait")
    };
    let end = fixture.submit(urgent).await.finished().await;
    assert_eq!(end.failure, Some(Failure::DeadlinePassed));
    assert_eq!(fixture.wait_for_end("a").await.state, State::Cancelled);
}

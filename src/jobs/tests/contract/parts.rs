//! Jobs that are merged from others.

use verne_jobs::{Counts, Failure, Filter, State, Submission, SubmitError};

use crate::stage::{id, job};
use crate::stand::{Open, Stand, for_each_backend};

for_each_backend!(
    parts_are_merged,
    equal_parts_are_computed_once,
    a_part_that_fails_fails_the_whole,
    a_part_that_is_cancelled_cancels_the_whole,
    a_cancelled_whole_cancels_its_parts,
    an_abandoned_whole_abandons_its_parts,
    what_others_want_goes_on_without_the_whole,
    progress_is_the_mean_by_cost,
    parts_wait_for_room,
    one_whole_does_not_fill_the_queue,
    wholes_that_wait_are_in_the_queue,
    small_parts_leave_the_express_lane_to_others,
    a_small_whole_passes_a_part_of_a_large_one,
    parts_are_not_listed,
    parts_that_others_submitted_are_listed,
    parts_have_parts,
    a_fault_in_naming_parts_fails_the_job,
    a_part_of_itself_is_a_fault,
    a_whole_has_its_deadline,
);

async fn parts_are_merged(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "whole", "split a=pass b=pass a=pass")).await.finished().await;
    assert_eq!((end.state, end.progress, end.attempts), (State::Succeeded, 1.0, 1));
    assert_eq!(stand.stage.begun(3).await, ["a", "b", "whole"]);
    let part = stand.get("a").await;
    assert_eq!((part.state, part.client.as_str()), (State::Succeeded, "ada"));
    assert_eq!(stand.backend.counts(), Counts { started: 3, succeeded: 3, ..Counts::default() });
}

/// Small, so that it is split while a part runs on the main lane.
fn small(name: &str, parts: &str) -> Submission {
    Submission { cost: 1.0, ..job("bob", name, &format!("split {parts}")) }
}

async fn equal_parts_are_computed_once(open: Open) {
    let stand = open(10);
    let first = stand.submit(job("ada", "first", "split a=hold")).await;
    stand.stage.begun(1).await;
    let second = stand.submit(small("second", "a=hold b=pass")).await;
    // Its parts are named in order.
    while stand.backend.get(id("b")).await.unwrap().is_none() {}
    stand.stage.open("a");
    assert_eq!(first.finished().await.state, State::Succeeded);
    assert_eq!(second.finished().await.state, State::Succeeded);
    let mut begun = stand.stage.begun(4).await;
    begun.sort();
    assert_eq!(begun, ["a", "b", "first", "second"]);
}

async fn a_part_that_fails_fails_the_whole(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "whole", "split a=fail b=hold")).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Work("as told".into()))));
    assert_eq!(stand.get("a").await.state, State::Failed);
    assert_eq!(stand.end("b").await.state, State::Cancelled);
}

async fn a_part_that_is_cancelled_cancels_the_whole(open: Open) {
    let stand = open(10);
    let whole = stand.submit(job("ada", "whole", "split a=hold b=hold")).await;
    stand.stage.begun(1).await;
    stand.backend.cancel(id("a")).await.unwrap().unwrap();
    assert_eq!(whole.finished().await.state, State::Cancelled);
    assert_eq!(stand.end("b").await.state, State::Cancelled);
}

async fn a_cancelled_whole_cancels_its_parts(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "whole", "split a=hold b=hold")).await;
    stand.stage.begun(1).await;
    stand.backend.cancel(id("whole")).await.unwrap().unwrap();
    for name in ["whole", "a", "b"] {
        assert_eq!(stand.end(name).await.state, State::Cancelled);
    }
    assert_eq!(stand.submit(job("ada", "c", "pass")).await.finished().await.state, State::Succeeded);
}

async fn an_abandoned_whole_abandons_its_parts(open: Open) {
    let stand = open(10);
    let claim = stand.submit(job("ada", "whole", "split a=hold b=hold")).await;
    stand.stage.begun(1).await;
    drop(claim);
    for name in ["whole", "a", "b"] {
        assert_eq!(stand.end(name).await.state, State::Cancelled);
    }
}

async fn what_others_want_goes_on_without_the_whole(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "whole", "split a=hold b=pass")).await;
    stand.stage.begun(1).await;
    let (a, b) = (stand.submit(job("bob", "a", "hold")).await, stand.submit(job("bob", "b", "pass")).await);
    stand.backend.cancel(id("whole")).await.unwrap();
    stand.stage.open("a");
    assert_eq!((a.finished().await.state, b.finished().await.state), (State::Succeeded, State::Succeeded));
    assert_eq!(stand.stage.begun(2).await, ["a", "b"]);
}

async fn progress_is_the_mean_by_cost(open: Open) {
    let stand = open(10);
    let whole = stand.submit(job("ada", "whole", "split-wavering a=pass=10 b=waver=30")).await;
    let mut watcher = whole.watch();
    let mut seen = Vec::new();
    for part in [0.2, 0.5] {
        let expected = 0.95 * (10.0 + 30.0 * part) / 40.0;
        while seen.last().is_none_or(|last: &f64| (last - expected).abs() > 2e-3) {
            seen.push(watcher.next().await.unwrap().progress);
        }
        for gate in if part == 0.2 { ["b-0.2", "b-0.1", "b-NaN"] } else { ["b-0.5", "b-0.3", ""] } {
            stand.stage.open(gate);
        }
    }
    // The merge.
    for part in ["0.2", "0.1", "NaN"] {
        stand.stage.open(&format!("whole-{part}"));
    }
    let expected = 0.95 + 0.05 * 0.5;
    while seen.last().is_none_or(|last| (last - expected).abs() > 2e-3) {
        seen.push(watcher.next().await.unwrap().progress);
    }
    stand.stage.open("whole-0.5");
    stand.stage.open("whole-0.3");
    assert_eq!(whole.finished().await.progress, 1.0);
    assert!(seen.is_sorted(), "{seen:?}");
}

fn many(first: &str, count: usize) -> String {
    let others: Vec<_> = (1..count).map(|number| format!("{number}=pass")).collect();
    format!("split {first} {}", others.join(" "))
}

async fn parts_wait_for_room(open: Open) {
    let stand = open(3);
    let whole = stand.submit(job("ada", "whole", &many("first=hold", 20))).await;
    stand.stage.begun(1).await;
    until_queued(&stand, 3).await;
    let refused = stand.backend.submit(job("bob", "b", "pass")).await.unwrap_err();
    assert!(matches!(refused, SubmitError::Full { .. }), "{refused}");
    stand.stage.open("first");
    assert_eq!(whole.finished().await.state, State::Succeeded);
    assert_eq!(stand.stage.begun(21).await.len(), 21);
    assert_eq!(stand.submit(job("bob", "b", "pass")).await.finished().await.state, State::Succeeded);
}

async fn one_whole_does_not_fill_the_queue(open: Open) {
    let stand = open(1000);
    let whole = stand.submit(job("ada", "whole", &many("first=hold", 400))).await;
    stand.stage.begun(1).await;
    until_queued(&stand, 255).await;
    stand.submit(Submission { cost: 1.0, ..job("bob", "b", "pass") }).await.finished().await;
    assert_eq!(stand.backend.counts().queued, 255);
    stand.stage.open("first");
    assert_eq!(whole.finished().await.state, State::Succeeded);
}

async fn until_queued(stand: &Stand, count: usize) {
    while stand.backend.counts().queued < count {
        tokio::task::yield_now().await;
    }
}

/// One place, and more than one job that is split when its turn comes.
async fn wholes_that_wait_are_in_the_queue(open: Open) {
    let stand = open(2);
    let first = stand.submit(small("first", "a=hold b=pass")).await;
    stand.stage.begun(1).await;
    until_queued(&stand, 1).await;
    let refused = stand.backend.submit(small("second", "c=pass")).await.unwrap_err();
    assert!(matches!(refused, SubmitError::Full { .. }), "{refused}");
    stand.stage.open("a");
    first.finished().await;
    let second = stand.submit(small("second", "c=pass")).await;
    assert_eq!(second.finished().await.state, State::Succeeded);
}

async fn listed(stand: &Stand) -> Vec<String> {
    let page = stand.backend.list(Filter { limit: 100, ..Filter::default() }).await.unwrap();
    let name = |payload: &[u8]| String::from_utf8_lossy(payload).split(' ').next().unwrap().to_owned();
    page.jobs.iter().map(|job| name(&job.payload)).collect()
}

async fn small_parts_leave_the_express_lane_to_others(open: Open) {
    let stand = open(10);
    let whole = stand.submit(job("ada", "whole", "split a=hold=1 b=hold=1")).await;
    stand.stage.begun(1).await;
    let c = Submission { cost: 1.0, ..job("bob", "c", "pass") };
    assert_eq!(stand.submit(c).await.finished().await.state, State::Succeeded);
    assert_eq!(stand.stage.begun(2).await, ["a", "c"]);
    stand.stage.open("a");
    stand.stage.open("b");
    assert_eq!(whole.finished().await.state, State::Succeeded);
}

async fn a_small_whole_passes_a_part_of_a_large_one(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "whole", "split a=hold=1 b=hold=1")).await;
    stand.stage.begun(1).await;
    let second = Submission { client: "ada".to_owned(), ..small("second", "c=pass=0.5 d=pass=0.5") };
    let whole = stand.submit(second).await;
    assert_eq!(whole.finished().await.state, State::Succeeded);
    assert_eq!(stand.stage.begun(4).await, ["a", "c", "d", "second"]);
}

async fn parts_are_not_listed(open: Open) {
    let stand = open(10);
    let whole = stand.submit(job("ada", "whole", "split a=hold b=fail")).await;
    stand.stage.begun(1).await;
    assert_eq!(listed(&stand).await, ["whole"]);
    let page =
        stand.backend.list(Filter { state: Some(State::Running), limit: 9, ..Filter::default() }).await;
    assert_eq!(page.unwrap().jobs.len(), 1);
    stand.stage.open("a");
    whole.finished().await;
    assert_eq!(listed(&stand).await, ["whole"]);
}

async fn parts_that_others_submitted_are_listed(open: Open) {
    let stand = open(10);
    stand.submit(job("bob", "before", "pass")).await.finished().await;
    let whole = stand.submit(job("ada", "whole", "split a=hold before=pass during=pass")).await;
    stand.stage.begun(2).await;
    stand.leave(job("eve", "during", "pass")).await;
    stand.stage.open("a");
    assert_eq!(whole.finished().await.state, State::Succeeded);
    let mut names = listed(&stand).await;
    names.sort();
    assert_eq!(names, ["before", "during", "whole"]);
}

async fn parts_have_parts(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "whole", "split a=split+b:pass+c:pass d=pass")).await.finished().await;
    assert_eq!(end.state, State::Succeeded);
    let begun = stand.stage.begun(5).await;
    let place = |name: &str| begun.iter().position(|begun| begun == name).unwrap();
    assert!(place("b") < place("a") && place("c") < place("a"));
    assert_eq!(begun[4], "whole");
}

async fn a_fault_in_naming_parts_fails_the_job(open: Open) {
    let stand = open(10);
    for (name, verb, failure) in [
        ("a", "split-fail", Failure::Work("as told".into())),
        ("b", "split-panic", Failure::Panicked("as told".to_owned())),
    ] {
        let end = stand.submit(job("ada", name, verb)).await.finished().await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(failure)));
    }
    assert_eq!(stand.submit(job("ada", "c", "pass")).await.finished().await.state, State::Succeeded);
}

async fn a_part_of_itself_is_a_fault(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "a", "split b=pass a=pass")).await.finished().await;
    assert!(matches!(end.failure, Some(Failure::Panicked(_))), "{end:?}");
}

async fn a_whole_has_its_deadline(open: Open) {
    let stand = open(10);
    let hurried = Submission {
        deadline: Some(std::time::Duration::from_millis(500)),
        ..job("ada", "whole", "split a=hold b=hold")
    };
    let end = stand.submit(hurried).await.finished().await;
    assert_eq!(end.failure, Some(Failure::DeadlinePassed));
    assert_eq!(stand.end("a").await.state, State::Cancelled);
}

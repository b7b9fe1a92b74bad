//! Watchers of jobs.

use verne_jobs::State;

use crate::fixture::{Open, for_each_backend};
use crate::scripted_work::{id, job};

for_each_backend!(
    a_watcher_receives_states_and_progress_in_order,
    a_watcher_of_an_ended_job_receives_its_end,
    claims_requests_and_lists_report_progress,
    a_watcher_does_not_prevent_cancellation,
);

async fn a_watcher_receives_states_and_progress_in_order(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "first", "wait")).await;
    fixture.submit_detached(job("ada", "a", "progress")).await;
    let mut watcher = fixture.backend.watch(id("a")).await.unwrap().unwrap();
    assert_eq!(watcher.next().await.unwrap().state, State::Queued);
    fixture.work.release("first");
    let mut seen = Vec::new();
    for gate in ["a-0.2", "a-0.1", "a-NaN", "a-0.5", "a-0.3"] {
        if gate == "a-0.1" || gate == "a-0.3" {
            let fraction = if gate == "a-0.1" { 0.2 } else { 0.5 };
            while seen.last() != Some(&(State::Running, fraction)) {
                let job = watcher.next().await.unwrap();
                seen.push((job.state, job.progress));
            }
        }
        fixture.work.release(gate);
    }
    while let Some(job) = watcher.next().await {
        seen.push((job.state, job.progress));
    }
    assert!(seen.is_sorted_by(|(_, earlier), (_, later)| earlier <= later), "{seen:?}");
    assert!(seen.iter().all(|(_, progress)| (0.0..=1.0).contains(progress)), "{seen:?}");
    assert_eq!(seen.last(), Some(&(State::Succeeded, 1.0)));
    assert_eq!(seen.iter().filter(|(state, _)| state.is_final()).count(), 1);
}

async fn a_watcher_of_an_ended_job_receives_its_end(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "a", "pass")).await.finished().await;
    let mut watcher = fixture.backend.watch(id("a")).await.unwrap().unwrap();
    assert_eq!((watcher.next().await, watcher.next().await), (Some(end), None));
}

async fn claims_requests_and_lists_report_progress(open: Open) {
    let fixture = open(10);
    let claim = fixture.submit(job("ada", "a", "progress")).await;
    let mut watcher = claim.watch();
    while watcher.next().await.unwrap().progress != 0.2 {}
    assert_eq!((claim.job().progress, fixture.get("a").await.progress), (0.2, 0.2));
    let page = fixture.backend.list(verne_jobs::Filter::default()).await.unwrap();
    assert_eq!(page.jobs[0].progress, 0.2);
    fixture.backend.cancel(id("a")).await.unwrap();
    // The last progress stays.
    assert_eq!(claim.finished().await.progress, 0.2);
    assert_eq!(fixture.get("a").await.progress, 0.2);
}

async fn a_watcher_does_not_prevent_cancellation(open: Open) {
    let fixture = open(10);
    let claim = fixture.submit(job("ada", "a", "wait")).await;
    let mut watcher = fixture.backend.watch(id("a")).await.unwrap().unwrap();
    drop(claim);
    let mut last = None;
    while let Some(job) = watcher.next().await {
        last = Some(job.state);
    }
    assert_eq!(last, Some(State::Cancelled));
}

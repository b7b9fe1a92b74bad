//! What a watcher sees.

use verne_jobs::State;

use crate::stage::{id, job};
use crate::stand::{Open, for_each_backend};

for_each_backend!(
    a_watcher_sees_a_life,
    a_watcher_of_a_finished_job_sees_its_end,
    progress_is_there_for_who_asks,
    a_watcher_does_not_hold_a_job,
);

async fn a_watcher_sees_a_life(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "first", "hold")).await;
    stand.leave(job("ada", "a", "waver")).await;
    let mut watcher = stand.backend.watch(id("a")).await.unwrap().unwrap();
    assert_eq!(watcher.next().await.unwrap().state, State::Queued);
    stand.stage.open("first");
    let mut seen = Vec::new();
    for gate in ["a-0.2", "a-0.1", "a-NaN", "a-0.5", "a-0.3"] {
        if gate == "a-0.1" || gate == "a-0.3" {
            let part = if gate == "a-0.1" { 0.2 } else { 0.5 };
            while seen.last() != Some(&(State::Running, part)) {
                let job = watcher.next().await.unwrap();
                seen.push((job.state, job.progress));
            }
        }
        stand.stage.open(gate);
    }
    while let Some(job) = watcher.next().await {
        seen.push((job.state, job.progress));
    }
    assert!(seen.is_sorted_by(|(_, earlier), (_, later)| earlier <= later), "{seen:?}");
    assert!(seen.iter().all(|(_, progress)| (0.0..=1.0).contains(progress)), "{seen:?}");
    assert_eq!(seen.last(), Some(&(State::Succeeded, 1.0)));
    assert_eq!(seen.iter().filter(|(state, _)| state.is_final()).count(), 1);
}

async fn a_watcher_of_a_finished_job_sees_its_end(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "a", "pass")).await.finished().await;
    let mut watcher = stand.backend.watch(id("a")).await.unwrap().unwrap();
    assert_eq!((watcher.next().await, watcher.next().await), (Some(end), None));
}

async fn progress_is_there_for_who_asks(open: Open) {
    let stand = open(10);
    let claim = stand.submit(job("ada", "a", "waver")).await;
    let mut watcher = claim.watch();
    while watcher.next().await.unwrap().progress != 0.2 {}
    assert_eq!((claim.job().progress, stand.get("a").await.progress), (0.2, 0.2));
    let page = stand.backend.list(verne_jobs::Filter::default()).await.unwrap();
    assert_eq!(page.jobs[0].progress, 0.2);
    stand.backend.cancel(id("a")).await.unwrap();
    // How far it came.
    assert_eq!(claim.finished().await.progress, 0.2);
    assert_eq!(stand.get("a").await.progress, 0.2);
}

async fn a_watcher_does_not_hold_a_job(open: Open) {
    let stand = open(10);
    let claim = stand.submit(job("ada", "a", "hold")).await;
    let mut watcher = stand.backend.watch(id("a")).await.unwrap().unwrap();
    drop(claim);
    let mut last = None;
    while let Some(job) = watcher.next().await {
        last = Some(job.state);
    }
    assert_eq!(last, Some(State::Cancelled));
}

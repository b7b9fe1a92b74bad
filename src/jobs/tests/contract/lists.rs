//! Pages of jobs.

use verne_jobs::{Cursor, Filter, Job, Page, State};

use crate::stage::job;
use crate::stand::{Open, Stand, for_each_backend};

for_each_backend!(pages_are_newest_first, a_list_is_filtered, a_list_is_bounded);

fn names(jobs: &[Job]) -> Vec<String> {
    jobs.iter()
        .map(|job| String::from_utf8_lossy(&job.payload).split(' ').next().unwrap().to_owned())
        .collect()
}

async fn list(stand: &Stand, filter: Filter) -> Page {
    stand.backend.list(filter).await.unwrap()
}

async fn pages_are_newest_first(open: Open) {
    let stand = open(10);
    for name in ["a", "b", "c", "d", "e"] {
        stand.submit(job("ada", name, "pass")).await.finished().await;
    }
    // A fresh life is a new job in the list.
    stand.submit(job("ada", "b", "pass")).await.finished().await;
    let mut after = None;
    let mut seen = Vec::new();
    loop {
        let page = list(&stand, Filter { limit: 2, after, ..Filter::default() }).await;
        seen.push(names(&page.jobs));
        let Some(next) = page.next else { break };
        after = Some(next.to_string().parse::<Cursor>().unwrap());
    }
    assert_eq!(seen, [vec!["b", "e"], vec!["d", "c"], vec!["a"]]);
    assert!("a".parse::<Cursor>().is_err());
}

async fn a_list_is_filtered(open: Open) {
    let stand = open(10);
    stand.submit(job("ada", "done", "pass")).await.finished().await;
    stand.leave(job("bob", "running", "hold")).await;
    stand.stage.begun(2).await;
    stand.leave(job("ada", "queued", "pass")).await;
    for (state, expected) in [
        (Some(State::Queued), vec!["queued"]),
        (Some(State::Running), vec!["running"]),
        (Some(State::Succeeded), vec!["done"]),
        (Some(State::Failed), vec![]),
        (None, vec!["queued", "running", "done"]),
    ] {
        let page = list(&stand, Filter { state, limit: 9, ..Filter::default() }).await;
        assert_eq!(names(&page.jobs), expected, "{state:?}");
        assert_eq!(page.next, None);
    }
    let page = list(&stand, Filter { client: Some("bob".to_owned()), limit: 9, ..Filter::default() }).await;
    assert_eq!(names(&page.jobs), ["running"]);
}

async fn a_list_is_bounded(open: Open) {
    let stand = open(200);
    stand.leave(job("ada", "running", "hold")).await;
    for number in 0..Filter::MAX_LIMIT {
        stand.leave(job("ada", &format!("{number}"), "pass")).await;
    }
    let page = list(&stand, Filter { limit: usize::MAX, ..Filter::default() }).await;
    assert_eq!(page.jobs.len(), Filter::MAX_LIMIT);
    assert!(page.next.is_some());
    assert_eq!(list(&stand, Filter::default()).await.jobs.len(), 1);
}

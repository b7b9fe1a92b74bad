//! Pages of jobs.

use verne_jobs::{Clients, Cursor, Filter, Job, Page, State};

use crate::stage::job;
use crate::stand::{Open, Stand, for_each_backend};

for_each_backend!(
    pages_are_newest_first,
    a_list_is_filtered,
    a_list_is_bounded,
    a_job_is_each_clients_who_asked,
    a_part_is_nobodys_until_somebody_asks,
    the_first_clients_stay,
);

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
    stand.leave(job("bob", "queued", "pass")).await;
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
    assert_eq!(names(&page.jobs), ["queued", "running"]);
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

async fn of(stand: &Stand, client: &str) -> Vec<String> {
    let filter = Filter { client: Some(client.to_owned()), limit: 9, ..Filter::default() };
    names(&list(stand, filter).await.jobs)
}

async fn a_job_is_each_clients_who_asked(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "running", "hold")).await;
    stand.stage.begun(1).await;
    stand.leave(job("ada", "queued", "pass")).await;
    stand.leave(job("bob", "running", "hold")).await;
    assert_eq!(of(&stand, "ada").await, ["queued", "running"]);
    assert_eq!(of(&stand, "bob").await, ["running"]);
    stand.stage.open("running");
    let end = stand.end("running").await;
    assert!(["ada", "bob"].iter().all(|client| end.clients.contains(client)) && !end.clients.contains("eve"));
    stand.end("queued").await;
    assert_eq!(of(&stand, "bob").await, ["running"], "also when it has ended");
    // A fresh life is of those who ask for it.
    stand.submit(job("eve", "running", "pass")).await.finished().await;
    assert_eq!((of(&stand, "eve").await.len(), of(&stand, "bob").await.len()), (1, 0));
}

async fn a_part_is_nobodys_until_somebody_asks(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "whole", "split a=hold")).await;
    stand.stage.begun(1).await;
    assert_eq!(stand.get("a").await.clients, Clients::default());
    let claim = stand.submit(job("bob", "a", "hold")).await;
    assert_eq!(of(&stand, "ada").await, ["whole"]);
    assert_eq!(of(&stand, "bob").await, ["a"]);
    drop(claim);
    stand.stage.open("a");
    assert_eq!(stand.end("whole").await.state, State::Succeeded);
}

async fn the_first_clients_stay(open: Open) {
    let stand = open(10);
    for number in 0..=Clients::MOST {
        stand.leave(job(&format!("client {number}"), "a", "hold")).await;
    }
    let clients = stand.get("a").await.clients;
    for number in 0..=Clients::MOST {
        assert_eq!(clients.contains(&format!("client {number}")), number < Clients::MOST, "{number}");
    }
}

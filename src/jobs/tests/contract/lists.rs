//! Pages of jobs.

use verne_jobs::{Clients, Cursor, Filter, Job, Page, State};

use crate::fixture::{Fixture, Open, for_each_backend};
use crate::scripted_work::job;

for_each_backend!(
    pages_are_newest_first,
    lists_are_filtered_by_state_and_client,
    a_page_has_a_greatest_length,
    a_job_is_in_the_lists_of_all_clients_that_submitted_it,
    a_subtask_has_no_clients_until_one_submits_it,
    a_job_names_a_limited_number_of_clients,
);

fn names(jobs: &[Job]) -> Vec<String> {
    jobs.iter()
        .map(|job| String::from_utf8_lossy(&job.payload).split(' ').next().unwrap().to_owned())
        .collect()
}

async fn list(fixture: &Fixture, filter: Filter) -> Page {
    fixture.backend.list(filter).await.unwrap()
}

async fn pages_are_newest_first(open: Open) {
    let fixture = open(10);
    for name in ["a", "b", "c", "d", "e"] {
        fixture.submit(job("ada", name, "pass")).await.finished().await;
    }
    // A new generation is a new job in the list.
    fixture.submit(job("ada", "b", "pass")).await.finished().await;
    let mut after = None;
    let mut seen = Vec::new();
    loop {
        let page = list(&fixture, Filter { limit: 2, after, ..Filter::default() }).await;
        seen.push(names(&page.jobs));
        let Some(next) = page.next else { break };
        after = Some(next.to_string().parse::<Cursor>().unwrap());
    }
    assert_eq!(seen, [vec!["b", "e"], vec!["d", "c"], vec!["a"]]);
    assert!("a".parse::<Cursor>().is_err());
}

async fn lists_are_filtered_by_state_and_client(open: Open) {
    let fixture = open(10);
    fixture.submit(job("ada", "done", "pass")).await.finished().await;
    fixture.submit_detached(job("bob", "running", "wait")).await;
    fixture.work.started(2).await;
    fixture.submit_detached(job("bob", "queued", "pass")).await;
    for (state, expected) in [
        (Some(State::Queued), vec!["queued"]),
        (Some(State::Running), vec!["running"]),
        (Some(State::Succeeded), vec!["done"]),
        (Some(State::Failed), vec![]),
        (None, vec!["queued", "running", "done"]),
    ] {
        let page = list(&fixture, Filter { state, limit: 9, ..Filter::default() }).await;
        assert_eq!(names(&page.jobs), expected, "{state:?}");
        assert_eq!(page.next, None);
    }
    let page = list(&fixture, Filter { client: Some("bob".to_owned()), limit: 9, ..Filter::default() }).await;
    assert_eq!(names(&page.jobs), ["queued", "running"]);
}

async fn a_page_has_a_greatest_length(open: Open) {
    let fixture = open(200);
    fixture.submit_detached(job("ada", "running", "wait")).await;
    for number in 0..Filter::MAX_LIMIT {
        fixture.submit_detached(job("ada", &format!("{number}"), "pass")).await;
    }
    let page = list(&fixture, Filter { limit: usize::MAX, ..Filter::default() }).await;
    assert_eq!(page.jobs.len(), Filter::MAX_LIMIT);
    assert!(page.next.is_some());
    assert_eq!(list(&fixture, Filter::default()).await.jobs.len(), 1);
}

async fn listed_for(fixture: &Fixture, client: &str) -> Vec<String> {
    let filter = Filter { client: Some(client.to_owned()), limit: 9, ..Filter::default() };
    names(&list(fixture, filter).await.jobs)
}

async fn a_job_is_in_the_lists_of_all_clients_that_submitted_it(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "running", "wait")).await;
    fixture.work.started(1).await;
    fixture.submit_detached(job("ada", "queued", "pass")).await;
    fixture.submit_detached(job("bob", "running", "wait")).await;
    assert_eq!(listed_for(&fixture, "ada").await, ["queued", "running"]);
    assert_eq!(listed_for(&fixture, "bob").await, ["running"]);
    fixture.work.release("running");
    let end = fixture.wait_for_end("running").await;
    assert!(["ada", "bob"].iter().all(|client| end.clients.contains(client)) && !end.clients.contains("eve"));
    fixture.wait_for_end("queued").await;
    assert_eq!(listed_for(&fixture, "bob").await, ["running"], "also when it has ended");
    // A new generation belongs to the clients that submit it.
    fixture.submit(job("eve", "running", "pass")).await.finished().await;
    assert_eq!((listed_for(&fixture, "eve").await.len(), listed_for(&fixture, "bob").await.len()), (1, 0));
}

async fn a_subtask_has_no_clients_until_one_submits_it(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "parent", "split a=wait")).await;
    fixture.work.started(1).await;
    assert_eq!(fixture.get("a").await.clients, Clients::default());
    let claim = fixture.submit(job("bob", "a", "wait")).await;
    assert_eq!(listed_for(&fixture, "ada").await, ["parent"]);
    assert_eq!(listed_for(&fixture, "bob").await, ["a"]);
    drop(claim);
    fixture.work.release("a");
    assert_eq!(fixture.wait_for_end("parent").await.state, State::Succeeded);
}

async fn a_job_names_a_limited_number_of_clients(open: Open) {
    let fixture = open(10);
    for number in 0..=Clients::MAX {
        fixture.submit_detached(job(&format!("client {number}"), "a", "wait")).await;
    }
    let clients = fixture.get("a").await.clients;
    for number in 0..=Clients::MAX {
        assert_eq!(clients.contains(&format!("client {number}")), number < Clients::MAX, "{number}");
    }
}

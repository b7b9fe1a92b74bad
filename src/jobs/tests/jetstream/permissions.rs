//! Permissions at the broker.

use std::time::Duration;

use verne_jobs::jetstream::ConnectError;
use verne_jobs::{Backend, JetStream, SubmitError, UnavailableError};

use crate::broker::Broker;
use crate::fixture::broker_tests;
use crate::scripted_work::job;

broker_tests!(
    a_forbidden_subject_is_reported_before_a_submission,
    a_later_denial_is_reported_until_it_is_lifted,
    a_process_without_permissions_is_refused,
);

/// A broker that forbids all clients to publish under some subjects.
fn forbidding(subjects: &str) -> Broker {
    Broker::with(&permissions(subjects))
}

fn permissions(denied: &str) -> String {
    format!(
        "authorization {{ users: [ {{ user: anyone, password: none, \
         permissions: {{ publish: {{ deny: [{denied}] }}, subscribe: \">\" }} }} ] }}\n no_auth_user: anyone"
    )
}

async fn a_forbidden_subject_is_reported_before_a_submission() {
    for (denied, expected) in [("\"$KV.*.*.*\"", "$KV.verne-jobs."), ("\"verne.queue.>\"", "verne.queue.")] {
        let broker = forbidding(denied);
        let api = broker.connect().await;
        let Err(UnavailableError(error)) = api.reachable().await else { panic!("{denied} is not reported") };
        assert!(error.contains("forbids") && error.contains(expected), "{error}");
    }
}

async fn a_later_denial_is_reported_until_it_is_lifted() {
    let mut broker = forbidding("");
    let api = broker.connect().await;
    assert_eq!(api.reachable().await, Ok(()));
    broker.kill();
    broker.configure(&permissions("\"$KV.>\""));
    broker.restart();
    let refused = loop {
        // The client may not be connected again yet.
        let refused = api.submit(job("ada", "a", "pass")).await.map(drop).unwrap_err();
        if matches!(api.reachable().await, Err(UnavailableError(error)) if error.contains("forbids")) {
            break refused;
        }
    };
    assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
    broker.kill();
    broker.configure(&permissions(""));
    broker.restart();
    while api.reachable().await.is_err() {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    api.submit(job("ada", "b", "pass")).await.unwrap();
}

async fn a_process_without_permissions_is_refused() {
    let broker = forbidding("\"$JS.API.>\"");
    let Some(ConnectError::Refused(error)) = JetStream::connect(broker.config()).await.err() else {
        panic!("not refused")
    };
    assert!(error.contains("$JS.API."), "{error}");
}

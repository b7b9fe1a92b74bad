//! What the broker forbids.

use std::time::Duration;

use verne_jobs::jetstream::ConnectError;
use verne_jobs::{Backend, JetStream, SubmitError, Unavailable};

use crate::broker::Broker;
use crate::stage::job;
use crate::stand::within_a_minute;

/// A broker that forbids everyone to publish under some subjects.
fn forbidding(subjects: &str) -> Broker {
    Broker::with(&permissions(subjects))
}

fn permissions(denied: &str) -> String {
    format!(
        "authorization {{ users: [ {{ user: anyone, password: none, \
         permissions: {{ publish: {{ deny: [{denied}] }}, subscribe: \">\" }} }} ] }}\n no_auth_user: anyone"
    )
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_the_broker_forbids_is_told_before_anybody_submits() {
    within_a_minute(async {
        for (denied, told) in [("\"$KV.*.*.*\"", "$KV.verne-jobs."), ("\"verne.queue.>\"", "verne.queue.")] {
            let broker = forbidding(denied);
            let api = broker.connect().await;
            let Err(Unavailable(fault)) = api.reachable().await else { panic!("{denied} is not told") };
            assert!(fault.contains("forbids") && fault.contains(told), "{fault}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn what_is_forbidden_later_is_told_and_passes() {
    within_a_minute(async {
        let mut broker = forbidding("");
        let api = broker.connect().await;
        assert_eq!(api.reachable().await, Ok(()));
        broker.kill();
        broker.configure(&permissions("\"$KV.>\""));
        broker.restart();
        let refused = loop {
            // The connection may not be there again yet.
            let refused = api.submit(job("ada", "a", "pass")).await.map(drop).unwrap_err();
            if matches!(api.reachable().await, Err(Unavailable(fault)) if fault.contains("forbids")) {
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
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
async fn a_process_that_may_make_nothing_is_refused() {
    let broker = forbidding("\"$JS.API.>\"");
    let Some(ConnectError::Refused(fault)) = JetStream::connect(broker.config()).await.err() else {
        panic!("not refused")
    };
    assert!(fault.contains("$JS.API."), "{fault}");
}

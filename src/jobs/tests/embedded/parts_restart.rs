//! What a process that dies leaves of jobs of parts.

use tempfile::TempDir;
use verne_jobs::{Failure, State, Submission};

use crate::restart::{killed, stand};
use crate::stage::job;
use crate::stand::within_a_minute;

#[tokio::test(flavor = "multi_thread")]
async fn a_whole_is_taken_up_again() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(directory.path());
        before.leave(job("ada", "whole", "split a=pass b=hold c=pass")).await;
        before.stage.begun(2).await;
        before.get("a").await;
        let copy = killed(directory.path());

        let after = stand(copy.path());
        after.stage.open("b");
        let end = after.end("whole").await;
        assert_eq!((end.state, end.attempts), (State::Succeeded, 2));
        assert_eq!(after.get("c").await.state, State::Succeeded);
    })
    .await;
}

/// One that waits at the deaths is not to blame for them, but one whose part is.
#[tokio::test(flavor = "multi_thread")]
async fn a_whole_falls_with_the_part_at_which_processes_die() {
    within_a_minute(async {
        let mut directory = TempDir::new().unwrap();
        let first = stand(directory.path());
        first.leave(job("ada", "whole", "split poison=hold")).await;
        first.stage.begun(1).await;
        first.leave(Submission { cost: 1.0, ..job("ada", "waits", "split good=pass=1000") }).await;
        for attempt in 1..=3 {
            let stand = if attempt == 1 { None } else { Some(stand(directory.path())) };
            let stand = stand.as_ref().unwrap_or(&first);
            assert_eq!(stand.stage.begun(1).await, ["poison"]);
            while stand.get("waits").await.state != State::Running || stand.backend.counts().running > 1 {}
            // Answered after all that was to be written.
            assert!(stand.backend.list(verne_jobs::Filter::default()).await.is_ok());
            let copy = killed(directory.path());
            drop(std::mem::replace(&mut directory, copy));
        }
        let last = stand(directory.path());
        let end = last.end("whole").await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::TooManyAttempts)));
        assert_eq!(last.end("waits").await.state, State::Succeeded);
    })
    .await;
}

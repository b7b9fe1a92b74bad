//! Parents and subtasks after the death of a process.

use tempfile::TempDir;
use verne_jobs::{Failure, State, Submission};

use crate::fixture::timed_tests;
use crate::restart::{copy_after_kill, fixture};
use crate::scripted_work::job;

timed_tests!(a_parent_continues_after_a_restart, a_parent_fails_with_the_subtask_that_kills_processes,);

async fn a_parent_continues_after_a_restart() {
    let directory = TempDir::new().unwrap();
    let before = fixture(directory.path());
    before.submit_detached(job("ada", "parent", "split a=pass b=wait c=pass")).await;
    before.work.started(2).await;
    before.get("a").await;
    let copy = copy_after_kill(directory.path());

    let after = fixture(copy.path());
    after.work.release("b");
    let end = after.wait_for_end("parent").await;
    assert_eq!((end.state, end.attempts), (State::Succeeded, 2));
    assert_eq!(after.get("c").await.state, State::Succeeded);
}

/// A parent that only waits at the deaths does not fail; one whose subtask kills the processes does.
async fn a_parent_fails_with_the_subtask_that_kills_processes() {
    let mut directory = TempDir::new().unwrap();
    let first = fixture(directory.path());
    first.submit_detached(job("ada", "parent", "split poison=wait")).await;
    first.work.started(1).await;
    first.submit_detached(Submission { cost: 1.0, ..job("ada", "waits", "split good=pass=1000") }).await;
    for attempt in 1..=3 {
        let fixture = if attempt == 1 { None } else { Some(fixture(directory.path())) };
        let fixture = fixture.as_ref().unwrap_or(&first);
        assert_eq!(fixture.work.started(1).await, ["poison"]);
        while fixture.get("waits").await.state != State::Running || fixture.backend.counts().running > 1 {}
        // Answered after all changes are written.
        assert!(fixture.backend.list(verne_jobs::Filter::default()).await.is_ok());
        let copy = copy_after_kill(directory.path());
        drop(std::mem::replace(&mut directory, copy));
    }
    let last = fixture(directory.path());
    let end = last.wait_for_end("parent").await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::TooManyAttempts)));
    assert_eq!(last.wait_for_end("waits").await.state, State::Succeeded);
}

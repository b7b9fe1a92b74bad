//! Permits of requests, memory of bodies, encodings of meshes.

use std::sync::Arc;

use futures_util::FutureExt;

use super::{Admission, RequestClass};
use crate::limits::error::LimitError;

fn free(admission: &Admission) -> (usize, usize) {
    (admission.requests.left(), admission.slow_requests.left())
}

#[tokio::test]
async fn a_request_returns_its_permit_while_it_waits() {
    let admission = Admission::new(4, 1);
    let permit = admission.admit(RequestClass::Other, None).unwrap();
    assert_eq!(free(&admission), (3, 2));
    let seen = permit.return_during(async { free(&admission) }).await;
    assert_eq!((seen, free(&admission)), (Some((4, 3)), (3, 2)));
    drop(permit);
    assert_eq!(free(&admission), (4, 3));
}

#[tokio::test]
async fn the_number_of_waiting_requests_is_limited() {
    let admission = Admission::new(4, 1);
    let permit = admission.admit(RequestClass::Other, None).unwrap();
    let waiting: Vec<_> = std::iter::from_fn(|| admission.waiting.take(None).ok()).collect();
    assert_eq!(permit.return_during(async {}).await, None);
    assert_eq!(free(&admission), (3, 2), "the request has its permit");
    drop(waiting);
    assert_eq!(permit.return_during(async {}).await, Some(()));
}

#[test]
fn a_service_has_at_least_one_permit_of_each_kind() {
    let admission = Admission::new(0, 1);
    drop(admission.admit(RequestClass::Other, None).unwrap());
    let permit = admission.admit(RequestClass::Fast, None).unwrap();
    assert!(
        admission.admit(RequestClass::Fast, None).is_err()
            && admission.admit(RequestClass::Monitoring, None).is_ok()
    );
    assert!(admission.batches.take(None).is_ok() && Arc::strong_count(&permit) == 1);
}

#[test]
fn bodies_count_received_bytes_and_no_client_takes_all_memory() {
    let admission = Admission::new(8, 1_000_000);
    let mut body = admission.body(Some("a")).unwrap();
    for bytes in [0, 1, 500_000, 1_000_000] {
        body.grow_to(bytes).unwrap();
    }
    let mut second = admission.body(Some("a")).unwrap();
    second.grow_to(1_000_000).unwrap();
    assert!(admission.body(Some("a")).is_err());
    let mut other = admission.body(Some("b")).unwrap();
    other.grow_to(1_000_000).unwrap();
    drop(second);
    assert!(admission.body(Some("a")).is_ok());
}

#[tokio::test]
async fn few_meshes_are_encoded_at_once_and_the_others_wait_in_order() {
    let admission = Admission::new(64, 1);
    let mut permits = Vec::new();
    for _ in 0..super::MESHES {
        permits.push(admission.mesh(Some("a")).await.unwrap());
    }
    let mut waiting: Vec<_> =
        (0..super::BATCHES / 2 - super::MESHES).map(|_| Box::pin(admission.mesh(Some("a")))).collect();
    for permit in &mut waiting {
        assert!(permit.as_mut().now_or_never().is_none());
    }
    assert_eq!(admission.mesh(Some("a")).await.unwrap_err(), LimitError::Overloaded);
    assert!(admission.mesh(Some("b")).now_or_never().is_none(), "other clients have the other half");
    drop(permits.pop());
    assert!(waiting[1].as_mut().now_or_never().is_none());
    assert!(waiting[0].as_mut().now_or_never().is_some());
}

#[test]
fn no_client_takes_all_streams() {
    let admission = Admission::new(8, 1);
    let streams: Vec<_> = std::iter::from_fn(|| admission.streams.take(Some("a")).ok()).collect();
    assert_eq!(streams.len(), super::STREAMS / 2);
    assert!(admission.streams.take(Some("b")).is_ok());
}

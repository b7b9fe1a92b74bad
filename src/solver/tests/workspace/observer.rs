//! Computations call their observer regularly, and stop at any call.

use std::sync::atomic::{AtomicUsize, Ordering};

use verne_solver::Machine;
use verne_solver::workspace::dexterity::{DexterityRequest, dexterity};
use verne_solver::workspace::{Kind, Observer, WorkspaceError, contains, measure, slice, surface};

use crate::requests::request;

/// Asks the computation to stop at the n-th call.
pub(crate) struct CallLimit {
    left: AtomicUsize,
    count: AtomicUsize,
}

impl CallLimit {
    pub(crate) fn new(left: usize) -> Self {
        Self { left: AtomicUsize::new(left), count: AtomicUsize::new(0) }
    }

    pub(crate) fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }
}

impl Observer for CallLimit {
    fn progress(&self, fraction: f64) {
        assert!((0.0..=1.0).contains(&fraction));
    }

    fn cancelled(&self) -> bool {
        self.count.fetch_add(1, Ordering::Relaxed);
        self.left.fetch_sub(1, Ordering::Relaxed) <= 1
    }
}

/// Stops a computation at calls from the first to the last, and returns their number.
pub(crate) fn stops_at_calls(name: &str, run: impl Fn(&dyn Observer) -> Result<(), WorkspaceError>) -> usize {
    let all = CallLimit::new(usize::MAX);
    run(&all).unwrap();
    let all = all.count();
    for left in [1, 2, all / 3, all / 2, all - 1, all] {
        let answer = run(&CallLimit::new(left.max(1)));
        assert_eq!(answer, Err(WorkspaceError::Cancelled), "{name}: call {left} of {all}");
    }
    all
}

#[test]
fn every_call_of_the_observer_can_stop_every_computation() {
    let machine = Machine::verne();
    let question = request(Kind::Part, 50.0, 10.0, 1.0);
    stops_at_calls("surface", |observer| surface(&machine, &question, observer).map(drop));
    stops_at_calls("slice", |observer| slice(&machine, &question, 300.0, &[0.1, 0.2], observer).map(drop));
    stops_at_calls("measure", |observer| measure(&machine, &question, observer).map(drop));
    let points = vec![[0.0, 0.0, 300.0]; 5_000];
    stops_at_calls("contains", |observer| contains(&machine, &question, &points, observer).map(drop));
    let request =
        DexterityRequest { tool_length: 80.0, phi2: 0.3, ..DexterityRequest::new([0.1, 0.1], 150.0) };
    stops_at_calls("dexterity", |observer| dexterity(&machine, &request, observer).map(drop));
}

/// The meshing continues for long after the domain has been traced. The finer the mesh, the more often it calls the
/// observer.
#[test]
fn meshing_calls_the_observer_more_often_for_finer_meshes() {
    struct Meshing(AtomicUsize, AtomicUsize);
    impl Observer for Meshing {
        fn progress(&self, fraction: f64) {
            if fraction >= 0.9 {
                self.0.store(1, Ordering::Relaxed);
            }
        }

        fn cancelled(&self) -> bool {
            self.1.fetch_add(self.0.load(Ordering::Relaxed), Ordering::Relaxed);
            false
        }
    }
    let machine = Machine::verne();
    let calls = [0.2, 0.02].map(|tolerance| {
        let seen = Meshing(AtomicUsize::new(0), AtomicUsize::new(0));
        let mesh = surface(&machine, &request(Kind::Platform, 0.0, 0.0, tolerance), &seen).unwrap();
        // Each triangle's sides and corners are worked on several times, with a call every 4096.
        let calls = seen.1.load(Ordering::Relaxed);
        assert!(calls > mesh.triangles.len() / 1_000, "{calls} {}", mesh.triangles.len());
        calls
    });
    assert!(calls[1] > 4 * calls[0], "{calls:?}");
}

//! Computations call their observer regularly, and stop at any call.

use std::sync::atomic::{AtomicUsize, Ordering};

use verne_solver::Machine;
use verne_solver::workspace::dexterity::{DexterityRequest, dexterity};
use verne_solver::workspace::{Kind, Observer, WorkspaceError, contains, measure, slice, surface};

use crate::machines::request;

/// Asks the computation to stop at the n-th call.
pub(crate) struct Looks {
    left: AtomicUsize,
    count: AtomicUsize,
}

impl Looks {
    pub(crate) fn until(left: usize) -> Self {
        Self { left: AtomicUsize::new(left), count: AtomicUsize::new(0) }
    }

    pub(crate) fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }
}

impl Observer for Looks {
    fn progress(&self, part: f64) {
        assert!((0.0..=1.0).contains(&part));
    }

    fn cancelled(&self) -> bool {
        self.count.fetch_add(1, Ordering::Relaxed);
        self.left.fetch_sub(1, Ordering::Relaxed) <= 1
    }
}

/// Stops a computation at calls from the first to the last, and returns their number.
fn ended(name: &str, run: impl Fn(&dyn Observer) -> Result<(), WorkspaceError>) -> usize {
    let all = Looks::until(usize::MAX);
    run(&all).unwrap();
    let all = all.count();
    for left in [1, 2, all / 3, all / 2, all - 1, all] {
        let answer = run(&Looks::until(left.max(1)));
        assert_eq!(answer, Err(WorkspaceError::Cancelled), "{name}: look {left} of {all}");
    }
    all
}

#[test]
fn every_look_can_end_every_computation() {
    let machine = Machine::verne();
    let question = request(Kind::Part, 50.0, 10.0, 1.0);
    ended("surface", |looks| surface(&machine, &question, looks).map(drop));
    ended("slice", |looks| slice(&machine, &question, 300.0, &[0.1, 0.2], looks).map(drop));
    ended("measure", |looks| measure(&machine, &question, looks).map(drop));
    let points = vec![[0.0, 0.0, 300.0]; 5_000];
    ended("contains", |looks| contains(&machine, &question, &points, looks).map(drop));
    let request = DexterityRequest {
        tool_length: 80.0,
        table_clearance: None,
        tool_radius: 0.0,
        phi2: 0.3,
        phi1: [0.1, 0.1],
        cell: 150.0,
    };
    ended("dexterity", |looks| dexterity(&machine, &request, looks).map(drop));
}

/// The meshing continues for long after the domain has been traced. The finer the mesh, the more often it calls the
/// observer.
#[test]
fn meshing_is_watched() {
    struct Meshing(AtomicUsize, AtomicUsize);
    impl Observer for Meshing {
        fn progress(&self, part: f64) {
            if part >= 0.9 {
                self.0.store(1, Ordering::Relaxed);
            }
        }

        fn cancelled(&self) -> bool {
            self.1.fetch_add(self.0.load(Ordering::Relaxed), Ordering::Relaxed);
            false
        }
    }
    let machine = Machine::verne();
    let looks = [0.2, 0.02].map(|tolerance| {
        let seen = Meshing(AtomicUsize::new(0), AtomicUsize::new(0));
        let mesh = surface(&machine, &request(Kind::Platform, 0.0, 0.0, tolerance), &seen).unwrap();
        // Each triangle's sides and corners are worked on several times, with a look every 4096.
        let looks = seen.1.load(Ordering::Relaxed);
        assert!(looks > mesh.triangles.len() / 1_000, "{looks} {}", mesh.triangles.len());
        looks
    });
    assert!(looks[1] > 4 * looks[0], "{looks:?}");
}

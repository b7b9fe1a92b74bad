//! Windows, tolerances, refusals, cancellation, equal answers.

use verne_solver::Machine;
use verne_solver::atlas::{AtlasError, AtlasRequest, Space, Window, atlas};
use verne_solver::workspace::{Observer, Unobserved};

use crate::comparison::compare_numbers;

struct Cancelled;

impl Observer for Cancelled {
    fn progress(&self, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        true
    }
}

fn request(u: [f64; 2], v: [f64; 2], tolerance: f64) -> AtlasRequest {
    AtlasRequest { space: Space::Joints, window: Window { u, v }, tolerance }
}

#[test]
fn numbers_out_of_range_are_refused() {
    let unit = [0.0, 100.0];
    for (request, refused) in [
        (request([1.0, 0.0], unit, 1.0), "u"),
        (request([f64::NAN, 1.0], unit, 1.0), "u"),
        (request([0.0, f64::INFINITY], unit, 1.0), "u"),
        (request(unit, [5.0, 5.0], 1.0), "v"),
        (request(unit, [0.0, 2e7], 1.0), "v"),
        (request(unit, unit, 0.0), "tolerance"),
        (request(unit, unit, 11.0), "tolerance"),
        (request(unit, unit, f64::NAN), "tolerance"),
    ] {
        let error = atlas(&Machine::verne(), &request, &Unobserved).unwrap_err();
        assert_eq!(error, AtlasError::OutOfDomain { field: refused }, "{request:?}");
    }
}

#[test]
fn an_observer_stops_the_computation() {
    for space in [Space::Platform, Space::Joints] {
        let request = AtlasRequest::new(&Machine::verne(), space, None);
        assert_eq!(atlas(&Machine::verne(), &request, &Cancelled), Err(AtlasError::Cancelled));
    }
}

#[test]
fn equal_requests_have_equal_answers() {
    let request = AtlasRequest::new(&Machine::verne(), Space::Joints, None);
    let answers = [0, 1].map(|_| format!("{:?}", atlas(&Machine::verne(), &request, &Unobserved)));
    assert_eq!(answers[0], answers[1]);
}

#[test]
fn a_part_of_the_plane_has_the_same_numbers() {
    let machine = Machine::verne();
    for space in [Space::Platform, Space::Joints] {
        for window in [
            Window { u: [100.0, 300.0], v: [-900.0, 500.0] },
            Window { u: [-0.5, 0.7], v: [-0.3, 0.4] },
            Window { u: [3_000.0, 3_100.0], v: [0.0, 50.0] },
            Window { u: [-8_000.0, 8_000.0], v: [-8_000.0, 8_000.0] },
        ] {
            let request = AtlasRequest::new(&machine, space, Some(window));
            let found = atlas(&machine, &request, &Unobserved).unwrap();
            let comparison = compare_numbers(&machine, &request, &found, 1_000);
            assert!(comparison.wrong.is_empty(), "{space:?}, {window:?}: {:?}", comparison.wrong);
            assert!(comparison.compared > 900, "{space:?}, {window:?}: {comparison:?}");
        }
    }
}

#[test]
fn a_window_without_curves_is_one_region() {
    let window = Window { u: [3_000.0, 3_100.0], v: [0.0, 50.0] };
    let request = AtlasRequest::new(&Machine::verne(), Space::Platform, Some(window));
    let found = atlas(&Machine::verne(), &request, &Unobserved).unwrap();
    assert!(found.curves.is_empty() && found.points.is_empty() && found.working.is_empty());
    let [region] = &found.regions[..] else { panic!("{:?}", found.regions) };
    assert_eq!(region.solutions, 0);
    assert!((region.face.area - 5_000.0).abs() < 1e-9, "{}", region.face.area);
}

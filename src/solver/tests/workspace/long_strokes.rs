//! Strokes many times as long as the legs: walls turn along their curves and have very many narrow triangles.

use verne_solver::Machine;
use verne_solver::workspace::{
    Kind, Request, Unobserved, WorkspaceError, expected_triangles, surface, surface_within,
};

use crate::machines::{changed, random};
use crate::observer::CallLimit;
use crate::random::Random;
use crate::requests::request;
use crate::surface::open_edges;

fn with_strokes(length: f64) -> Machine {
    changed(|data| data.limits.stroke = [[0.0, length]; 3])
}

/// The time to cut a triangle of the plane is quadratic in its points. There may be thousands of triangles, but not
/// thousands at one vertex.
#[test]
fn no_vertex_has_very_many_triangles() {
    for (stroke, tolerance) in [(750.0, 0.05), (4_000.0, 0.1), (20_000.0, 0.5), (90_000.0, 2.0)] {
        let mesh = surface(&with_strokes(stroke), &request(Kind::Part, 50.0, 0.0, tolerance), &Unobserved);
        let mesh = mesh.unwrap();
        assert_eq!(open_edges(&mesh), 0);
        let mut around = vec![0; mesh.positions.len()];
        for &corner in mesh.triangles.as_flattened() {
            around[corner as usize] += 1;
        }
        let most = around.into_iter().max().unwrap();
        assert!(most < 700, "{stroke} mm: {most} of {}", mesh.triangles.len());
    }
}

/// Any machine with any strokes. The tolerance is a fraction of them, so that there are not too many triangles.
fn any(numbers: &mut Random) -> Option<(Machine, Request)> {
    let mut data = random(numbers)?.data().clone();
    let longest = 200.0 * 450_f64.powf(numbers.fraction());
    data.limits.stroke = [(); 3].map(|()| [0.0, longest * numbers.between(0.5, 1.0)]);
    let kind = match numbers.fraction() {
        n if n < 1.0 / 3.0 => Kind::Platform,
        n if n < 2.0 / 3.0 => Kind::Tool,
        _ => Kind::Part,
    };
    let size = if kind == Kind::Part { longest.max(1_000.0) } else { 1_000.0 };
    let tolerance = size * 10_f64.powf(numbers.between(-4.0, -2.0));
    let question = request(kind, numbers.between(0.0, 300.0), numbers.between(-40.0, 40.0), tolerance);
    Some((Machine::new(data).ok()?, question))
}

#[test]
fn the_estimate_is_close_to_the_number_of_triangles() {
    let mut numbers = Random::new(0x1357_9bdf);
    let mut checked = 0;
    while checked < 80 {
        let Some((machine, question)) = any(&mut numbers) else { continue };
        let expected = expected_triangles(&machine, &question, &Unobserved).unwrap();
        let made = surface(&machine, &question, &Unobserved).unwrap().triangles.len() as f64;
        let close = made / 1.5 - 100.0..=6.0 * made + 100.0;
        assert!(close.contains(&expected), "{expected} of {made}: {:?} {question:?}", machine.data());
        checked += 1;
    }
}

/// The estimate takes the time of a few thousand triangles, whatever its result.
#[test]
fn the_estimate_calls_the_observer_a_bounded_number_of_times() {
    for stroke in [750.0, 4_000.0, 90_000.0] {
        let calls = CallLimit::new(usize::MAX);
        let question = request(Kind::Part, 50.0, 0.0, 0.01);
        let expected = expected_triangles(&with_strokes(stroke), &question, &calls).unwrap();
        // Each cut triangle and each chord is a call.
        assert!(
            expected > 300_000.0 && calls.count() < 20_000,
            "{stroke} mm: {expected}, {} calls",
            calls.count()
        );
    }
    // An empty workspace, whose limits jump.
    let calls = CallLimit::new(usize::MAX);
    expected_triangles(&Machine::verne(), &request(Kind::Part, 50.0, 170.0, 20.0), &calls).unwrap();
    assert!(calls.count() < 120_000, "{} calls", calls.count());
}

#[test]
fn a_surface_of_too_many_triangles_is_refused() {
    let (machine, question) = (Machine::verne(), request(Kind::Part, 50.0, 0.0, 1.0));
    let made = surface(&machine, &question, &Unobserved).unwrap().triangles.len();
    assert_eq!(
        surface_within(&machine, &question, made / 2, &Unobserved),
        Err(WorkspaceError::TooManyTriangles { most: made / 2 })
    );
    let within = surface_within(&machine, &question, 2 * made, &Unobserved).unwrap();
    assert_eq!(within.triangles.len(), made);
}

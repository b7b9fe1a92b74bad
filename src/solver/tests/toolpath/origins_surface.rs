//! The surface of the region of origins against the region itself, and against plans.

use verne_solver::Machine;
use verne_solver::toolpath::OriginRegion;

use crate::origins::{any_origin, is_feasible, origins, region, surveyed};
use crate::placement::contour;
use crate::random::Random;
use crate::support::{Clamped, any_machine, arrive, feed};

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn corners(surface: &OriginRegion) -> impl Iterator<Item = [Point; 3]> {
    surface.triangles.iter().map(|corners| corners.map(|corner| surface.positions[corner as usize]))
}

/// Whether an origin is inside a surface: the line upwards crosses it an odd number of times.
fn is_inside(surface: &OriginRegion, at: Point) -> bool {
    let crosses = |[a, b, c]: &[Point; 3]| {
        let side = |p: &Point, q: &Point| (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]);
        let [u, v, w] = [side(b, c), side(c, a), side(a, b)];
        let is_over = (u > 0.0) == (v > 0.0) && (v > 0.0) == (w > 0.0);
        is_over && (u * a[2] + v * b[2] + w * c[2]) / (u + v + w) > at[2]
    };
    corners(surface).filter(crosses).count() % 2 == 1
}

/// Whether an origin is within a distance of a surface.
fn is_near(surface: &OriginRegion, at: Point, distance: f64) -> bool {
    corners(surface).any(|[a, b, c]| {
        let (ab, ac, to) = (minus(b, a), minus(c, a), minus(at, a));
        let [aa, bb, cc] = [dot(ab, ab), dot(ab, ac), dot(ac, ac)];
        let whole = aa * cc - bb * bb;
        let u = (dot(ab, to) * cc - dot(ac, to) * bb) / whole;
        let v = (dot(ac, to) * aa - dot(ab, to) * bb) / whole;
        let from = |p: Point| dot(minus(at, p), minus(at, p)).sqrt();
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
            return from(std::array::from_fn(|i| a[i] + u * ab[i] + v * ac[i])) <= distance;
        }
        [[a, b], [b, c], [c, a]].into_iter().any(|[p, q]| {
            let along = minus(q, p);
            let part = (dot(minus(at, p), along) / dot(along, along)).clamp(0.0, 1.0);
            from(std::array::from_fn(|i| p[i] + part * along[i])) <= distance
        })
    })
}

/// A random origin at most `around` from a random vertex along each axis.
fn any_near(surface: &OriginRegion, around: f64, random: &mut Random) -> Point {
    let vertex = random.pick(&surface.positions);
    vertex.map(|c| c + random.between(-around, around))
}

fn steps() -> Clamped {
    let axis = [0.0, 0.0, 1.0];
    Clamped(vec![
        arrive([-150.0, 0.0, 0.0], axis),
        feed([150.0, 0.0, 0.0], axis),
        feed([150.0, 80.0, 20.0], [0.0, -0.3, 1.0]),
    ])
}

#[test]
fn origins_on_the_wrong_side_of_the_surface_are_within_its_error() {
    let mut random = Random::new(1905);
    let cases = [
        (Machine::verne(), contour(), 50.0),
        (any_machine(&mut random), contour(), 60.0),
        (Machine::verne(), steps(), 60.0),
    ];
    for (machine, program, cell) in cases {
        let survey = surveyed(&machine, &program, cell);
        let surface = region(&machine, &survey);
        assert!(surface.error < 0.75 * cell, "{}", surface.error);
        let mut wrong = 0;
        for _ in 0..origins(1500) {
            let at = any_near(&surface, 0.2 * cell, &mut random);
            if survey.contains(&machine, at) != is_inside(&surface, at) {
                wrong += 1;
                assert!(is_near(&surface, at, surface.error), "{at:?} {}", surface.error);
            }
        }
        println!("cell {cell}: error {}, {wrong} origins on the wrong side", surface.error);
    }
}

#[test]
fn the_surface_agrees_with_plans_outside_its_error() {
    let (machine, program) = (Machine::verne(), contour());
    let survey = surveyed(&machine, &program, 40.0);
    let surface = region(&machine, &survey);
    let mut random = Random::new(1906);
    let mut counts = [0; 2];
    for _ in 0..origins(400) {
        let origin = any_origin(&survey, &mut random);
        let inside = is_inside(&surface, origin);
        if inside != is_feasible(&machine, &program, origin) {
            assert!(is_near(&surface, origin, surface.error), "{origin:?} {}", surface.error);
        }
        counts[usize::from(inside)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

#[test]
fn every_edge_of_the_surface_belongs_to_two_triangles_in_opposite_directions() {
    let surface = region(&Machine::verne(), &surveyed(&Machine::verne(), &contour(), 60.0));
    let mut edges: Vec<[u32; 2]> =
        surface.triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
    let mut turned: Vec<[u32; 2]> = edges.iter().map(|[a, b]| [*b, *a]).collect();
    edges.sort_unstable();
    turned.sort_unstable();
    assert_eq!(edges, turned);
    assert!(edges.windows(2).all(|pair| pair[0] != pair[1]));
}

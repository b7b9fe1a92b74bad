//! Meshes are closed, oriented, within the tolerance, and the same every time.

use std::collections::HashMap;

use verne_solver::workspace::{
    Kind, Request, Surface, Unobserved, Volume, WorkspaceError, contains, measure, surface,
};
use verne_solver::{Constraint, Element, Machine, Margins, platform_working};

use crate::machines::{changed, others, random};
use crate::random::Random;
use crate::requests::request;

fn made(machine: &Machine, request: &Request) -> Surface {
    surface(machine, request, &Unobserved).unwrap()
}

/// Directed edges without exactly one opposite edge.
pub(crate) fn open_edges(surface: &Surface) -> usize {
    let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
    for [a, b, c] in &surface.triangles {
        for edge in [[*a, *b], [*b, *c], [*c, *a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges.iter().filter(|([a, b], count)| **count != 1 || edges.get(&[*b, *a]) != Some(&1)).count()
}

fn euler(surface: &Surface) -> i64 {
    let [vertices, triangles] =
        [surface.positions.len(), surface.triangles.len()].map(|count| i64::try_from(count).unwrap());
    vertices - triangles * 3 / 2 + triangles
}

fn all_kinds() -> [Request; 4] {
    [
        request(Kind::Platform, 0.0, 0.0, 2.0),
        request(Kind::Tool, 150.0, 0.0, 2.0),
        request(Kind::Part, 50.0, 0.0, 2.0),
        request(Kind::Part, 50.0, 60.0, 2.0),
    ]
}

#[test]
fn surfaces_are_closed_and_face_outwards() {
    let machines = others().into_iter().chain([("verne", Machine::verne())]);
    for (name, machine) in machines {
        for request in all_kinds() {
            let mesh = made(&machine, &request);
            assert_eq!(open_edges(&mesh), 0, "{name} {request:?}");
            assert_eq!(mesh.triangles.len(), mesh.bindings.len());
            let answer = measure(&machine, &request, &Unobserved).unwrap();
            let Volume::Value { value, .. } = answer.volume else { panic!("folded") };
            // Off by less than the tolerance times the sheets' and walls' area.
            let allowed = request.tolerance * (4.0 * answer.area);
            assert!(mesh.volume() > 0.0 && (mesh.volume() - value).abs() < allowed, "{name} {request:?}");
        }
    }
}

#[test]
fn surfaces_of_random_machines_are_closed() {
    let mut numbers = Random::new(88_172_645_463_325_252);
    for _ in 0..60 {
        let Some(machine) = random(&mut numbers) else { continue };
        for request in [request(Kind::Platform, 0.0, 0.0, 10.0), request(Kind::Part, 80.0, 20.0, 10.0)] {
            let mesh = made(&machine, &request);
            assert_eq!(open_edges(&mesh), 0, "{:?} {request:?}", machine.data());
        }
    }
}

#[test]
fn the_reference_surface_has_the_known_bounds() {
    let mesh = made(&Machine::verne(), &request(Kind::Platform, 0.0, 0.0, 1.0));
    assert!(mesh.triangles.len() < 5_000, "{}", mesh.triangles.len());
    assert_eq!(euler(&mesh), 2);
    let [low, high] = mesh.bounds().unwrap();
    let expected = [[-407.0, -540.5, 870.6], [392.0, 540.5, 1_627.0]];
    for (found, expected) in low.iter().chain(&high).zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1.0, "{found} {expected}");
    }
}

/// The error of the volume against the number of triangles: both depend on the square of the edges.
#[test]
fn the_volume_converges_at_second_order() {
    let machine = Machine::verne();
    let question = |tolerance| request(Kind::Platform, 0.0, 0.0, tolerance);
    let Volume::Value { value, .. } = measure(&machine, &question(1.0), &Unobserved).unwrap().volume else {
        panic!("folded")
    };
    let errors = [4.0, 1.0, 0.25].map(|tolerance| {
        let mesh = made(&machine, &question(tolerance));
        (value - mesh.volume()).abs() * mesh.triangles.len() as f64
    });
    assert!(errors[1] < 2.0 * errors[0] && errors[2] < 2.0 * errors[1], "{errors:?}");
}

/// Points of the true boundary, by bisection on solution and margins, are near the mesh, and points
/// of the mesh near the true boundary; in every kind's frame.
#[test]
fn surface_and_true_boundary_are_within_the_tolerance() {
    let kinds = [
        request(Kind::Platform, 0.0, 0.0, 1.0),
        request(Kind::Tool, 150.0, 0.0, 1.0),
        Request { phi2: 0.4, ..request(Kind::Part, 50.0, 20.0, 1.0) },
    ];
    // With the table's axis above all columns: they would fold else.
    let long = changed(|data| {
        data.limits.stroke = [[0.0, 20_000.0], [0.0, 18_000.0], [100.0, 19_000.0]];
        data.table.da = 21_000.0;
    });
    for (name, machine) in others().into_iter().chain([("long strokes", long)]) {
        for question in kinds {
            let mesh = made(&machine, &question);
            let [low, high] = mesh.bounds().unwrap();
            let mut numbers = Random::new(31_337);
            let member = |point| is_member(&machine, &question, point);
            let middle = loop {
                let point = [0, 1, 2].map(|i| numbers.between(low[i], high[i]));
                if member(point) {
                    break point;
                }
            };
            for _ in 0..400 {
                let to = [0, 1, 2].map(|i| numbers.between(low[i] - 50.0, high[i] + 50.0));
                let Some(point) = boundary(&member, middle, to) else { continue };
                let off = distance(&mesh, point);
                assert!(off <= question.tolerance, "{name} {question:?}: {point:?} is off by {off}");
            }
            for triangle in mesh.triangles.iter().step_by(mesh.triangles.len() / 400 + 1) {
                let corners = triangle.map(|corner| mesh.positions[corner as usize]);
                let parts = [numbers.fraction().sqrt(), numbers.fraction()];
                let weights = [1.0 - parts[0], parts[0] * (1.0 - parts[1]), parts[0] * parts[1]];
                let point = [0, 1, 2].map(|i| (0..3).map(|n| weights[n] * corners[n][i]).sum());
                assert!(is_mixed(&member, point, question.tolerance), "{name} {question:?}: {point:?}");
            }
        }
    }
}

fn is_member(machine: &Machine, question: &Request, point: [f64; 3]) -> bool {
    contains(machine, question, &[point], &Unobserved).unwrap()[0].inside
}

/// Whether there are both members and others within a distance of a point.
fn is_mixed(member: &impl Fn([f64; 3]) -> bool, [x, y, z]: [f64; 3], distance: f64) -> bool {
    let near = (0..27).map(|n| {
        let side = |k: i32| f64::from(n / k % 3 - 1);
        let [dx, dy, dz] = [side(1), side(3), side(9)];
        let scale = distance / (dx * dx + dy * dy + dz * dz).sqrt().max(1.0);
        member([x + scale * dx, y + scale * dy, z + scale * dz])
    });
    let found: Vec<bool> = near.collect();
    found.contains(&true) && found.contains(&false)
}

/// A point between inside and outside.
fn boundary(member: &impl Fn([f64; 3]) -> bool, inside: [f64; 3], outside: [f64; 3]) -> Option<[f64; 3]> {
    if member(outside) {
        return None;
    }
    let at = |part: f64| [0, 1, 2].map(|i| inside[i] + part * (outside[i] - inside[i]));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let part = 0.5 * (low + high);
        if member(at(part)) {
            low = part;
        } else {
            high = part;
        }
    }
    Some(at(low))
}

fn distance(mesh: &Surface, point: [f64; 3]) -> f64 {
    let corner = |n: u32| mesh.positions[n as usize];
    let each = mesh.triangles.iter().map(|t| to_triangle(point, t.map(corner)));
    each.fold(f64::INFINITY, f64::min)
}

/// Distance from a triangle: from its plane inside, otherwise from its sides.
fn to_triangle(p: [f64; 3], corners: [[f64; 3]; 3]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    let mut inside = true;
    let mut nearest = f64::INFINITY;
    for i in 0..3 {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        let (ab, ap) = (minus(b, a), minus(p, a));
        inside &= dot(cross(normal, ab), ap) >= 0.0;
        let part = if dot(ab, ab) > 0.0 { (dot(ab, ap) / dot(ab, ab)).clamp(0.0, 1.0) } else { 0.0 };
        let off = [0, 1, 2].map(|i| ap[i] - part * ab[i]);
        nearest = nearest.min(dot(off, off).sqrt());
    }
    let size = dot(normal, normal).sqrt();
    if inside && size > 0.0 { (dot(minus(p, corners[0]), normal) / size).abs() } else { nearest }
}

/// Every vertex lies on the true boundary: a step to one side is inside, to another outside.
#[test]
fn vertices_are_on_the_true_boundary() {
    let machine = Machine::verne();
    let question = request(Kind::Platform, 0.0, 0.0, 1.0);
    let mesh = made(&machine, &question);
    let member = |point| is_member(&machine, &question, point);
    for &[x, y, z] in &mesh.positions {
        let near = |step: f64| {
            (0..27).map(move |n| {
                let side = |k: i32| f64::from(n / k % 3 - 1) * step;
                [x + side(1), y + side(3), z + side(9)]
            })
        };
        assert!(near(0.1).any(member), "{x} {y} {z}");
        assert!(near(0.1).any(|point| !member(point)), "{x} {y} {z}");
    }
}

#[test]
fn a_surface_does_not_depend_on_the_number_of_threads() {
    let machine = Machine::verne();
    let question = request(Kind::Part, 50.0, 10.0, 0.5);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| made(&machine, &question))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
}

#[test]
fn an_empty_workspace_has_an_empty_surface() {
    let machine = changed(|data| data.limits.rotary = Some([-0.1, 0.1]));
    let question = Request { phi2: 1.0, ..request(Kind::Part, 50.0, 0.0, 1.0) };
    assert_eq!(made(&machine, &question), Surface::default());
}

#[test]
fn requests_out_of_domain_are_refused() {
    let machine = Machine::verne();
    for (field, question) in [
        ("tolerance", request(Kind::Platform, 0.0, 0.0, 0.0)),
        ("tolerance", request(Kind::Platform, 0.0, 0.0, f64::NAN)),
        ("tool_length", request(Kind::Tool, f64::INFINITY, 0.0, 1.0)),
        ("phi1", request(Kind::Part, 0.0, f64::NAN, 1.0)),
    ] {
        let answer = surface(&machine, &question, &Unobserved);
        assert_eq!(answer.unwrap_err(), WorkspaceError::OutOfDomain { field });
    }
}

/// Walls of rod interference name the two rods whose distance is twice the radius there. Legs of one length are
/// always equally near, and the first is named.
#[test]
fn walls_of_rod_interference_name_the_two_rods() {
    let machine = changed(|data| data.geometry.rod_radius = 60.0);
    let mesh = made(&machine, &request(Kind::Platform, 0.0, 0.0, 0.5));
    let mut pairs = HashMap::new();
    for (triangle, binding) in mesh.triangles.iter().zip(&mesh.bindings) {
        if binding.constraint != Constraint::RodInterference {
            continue;
        }
        let Element::Rods(one, other) = binding.element else { panic!("{binding:?}") };
        *pairs.entry([one, other]).or_insert(0) += 1;
        let corners = triangle.map(|corner| mesh.positions[corner as usize]);
        let middle = [0, 1, 2].map(|i| (corners[0][i] + corners[1][i] + corners[2][i]) / 3.0);
        let margins = Margins::of(&machine, &platform_working(&machine, middle).unwrap(), None);
        assert!(margins.rod_interference.abs() < 1.0, "{margins:?}");
        // Where two pairs are equally near, the side's triangles have one name.
        let named = margins.nearest_rods == [one, other];
        *pairs.entry([0, u8::from(named)]).or_insert(0) += 1;
    }
    let (right, wrong) = (pairs[&[0, 1]], pairs.get(&[0, 0]).copied().unwrap_or(0));
    assert!(right > 20 && wrong <= right / 50, "{pairs:?}");
}

//! Slices compared with membership and volume.

use verne_solver::Machine;
use verne_solver::workspace::{Kind, Slice, Unobserved, contains, slice};

use crate::machines::changed;
use crate::random::Random;
use crate::requests::request;

fn inside(slice: &Slice, [x, y]: [f64; 2]) -> bool {
    let crossings = |ring: &Vec<[f64; 2]>| {
        (0..ring.len())
            .filter(|&i| {
                let ([ax, ay], [bx, by]) = (ring[i], ring[(i + 1) % ring.len()]);
                (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
            })
            .count()
    };
    let rings = slice.polygons.iter().flat_map(|polygon| polygon.holes.iter().chain([&polygon.outer]));
    rings.map(crossings).sum::<usize>() % 2 == 1
}

/// Points of the cut are members and other points are not, except near the cut's boundary.
#[test]
fn points_of_a_slice_are_members_of_the_workspace() {
    let thin = changed(|data| data.limits.stroke = [[0.0, 150.0], [0.0, 200.0], [0.0, 150.0]]);
    let verne = Machine::verne();
    let cases = [
        (&verne, request(Kind::Platform, 0.0, 0.0, 0.2), 1_200.0),
        (&verne, request(Kind::Platform, 0.0, 0.0, 0.2), 900.0),
        (&verne, request(Kind::Tool, 150.0, 0.0, 0.2), 1_400.0),
        (&verne, request(Kind::Part, 50.0, 0.0, 0.2), 300.0),
        (&verne, request(Kind::Part, 50.0, 40.0, 0.2), 300.0),
        (&thin, request(Kind::Platform, 0.0, 0.0, 0.2), 1_050.0),
    ];
    for (machine, request, height) in cases {
        let cut = slice(machine, &request, height, &[0.1], &Unobserved).unwrap();
        let mut random = Random::new(77);
        let points: Vec<[f64; 3]> = (0..20_000)
            .map(|_| [random.between(-500.0, 500.0), random.between(-800.0, 800.0), height])
            .collect();
        let members = contains(machine, &request, &points, &Unobserved).unwrap();
        let differing = points
            .iter()
            .zip(&members)
            .filter(|(point, member)| inside(&cut, [point[0], point[1]]) != member.inside)
            .count();
        assert!(differing <= 6, "{request:?} {height}: {differing}");
        let fraction = members.iter().filter(|member| member.inside).count() as f64 / 20_000.0;
        assert!((fraction * 1.6e6 - cut.area()).abs() < 0.03 * 1.6e6 * fraction.max(0.05), "{height}");
        assert!(cut.polygons.iter().all(|polygon| polygon.outer.len() >= 3));
    }
}

#[test]
fn points_of_a_contour_have_its_alpha() {
    let machine = Machine::verne();
    let angles = [-0.3, 0.0, 0.25];
    let cut =
        slice(&machine, &request(Kind::Platform, 0.0, 0.0, 0.5), 1_200.0, &angles, &Unobserved).unwrap();
    assert_eq!(cut.contours.len(), 3);
    for contour in &cut.contours {
        assert!(contour.points.len() >= 2);
        for &[x, y] in &contour.points {
            let posture = verne_solver::platform_working(&machine, [x, y, 1_200.0]).unwrap();
            assert!((posture.pose.alpha - contour.alpha).abs() < 1e-9);
        }
    }
}

#[test]
fn a_slice_beside_the_workspace_is_empty() {
    let cut = slice(&Machine::verne(), &request(Kind::Platform, 0.0, 0.0, 1.0), 100.0, &[0.0], &Unobserved);
    assert_eq!(cut.unwrap(), Slice::default());
}

//! Volume, area, bounds and audit of solids whose figures are known.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

#[path = "support/solids.rs"]
mod solids;

use solids::{SolidBuilder, ball, block, empty};
use verne_mesh::Audit;

#[test]
fn a_box_is_measured_exactly() {
    let mesh = block();
    assert_eq!(mesh.volume(), 6000.0);
    assert_eq!(mesh.area(), 2200.0);
    let bounds = mesh.bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), ([-10.0, 5.0, 900.0], [20.0, 25.0, 910.0]));
    assert_eq!(bounds.centre(), [5.0, 15.0, 905.0]);
}

#[test]
fn an_inverted_box_has_a_negative_volume() {
    assert_eq!(SolidBuilder::default().block([0.0; 3], [1.0, 2.0, 3.0], true).mesh().volume(), -6.0);
}

#[test]
fn the_volume_is_exact_far_from_the_origin() {
    let near = SolidBuilder::default().ball([0.0; 3], 1.0, 40).mesh().volume();
    let far = SolidBuilder::default().ball([1e6, -1e6, 1e6], 1.0, 40).mesh().volume();
    // The coordinates themselves are rounded to 1e-10 there.
    assert!((far / near - 1.0).abs() < 1e-10, "{far} against {near}");
}

#[test]
fn volume_and_area_of_a_ball_converge_at_second_order() {
    let ball = |n| SolidBuilder::default().ball([0.0; 3], 1.0, n).mesh();
    let volume = 4.0 / 3.0 * std::f64::consts::PI;
    let (coarse, fine) = (volume - ball(20).volume(), volume - ball(40).volume());
    assert!(fine > 0.0 && (3.9..4.1).contains(&(coarse / fine)), "{coarse} then {fine}");
    let area = 4.0 * std::f64::consts::PI;
    let (coarse, fine) = (area - ball(20).area(), area - ball(40).area());
    assert!(fine > 0.0 && (3.9..4.1).contains(&(coarse / fine)), "{coarse} then {fine}");
}

#[test]
fn valid_solids_have_their_topology_and_no_defects() {
    let sound =
        |euler_characteristic, components| Audit { euler_characteristic, components, ..Audit::default() };
    assert_eq!(block().audit(), sound(2, 1));
    assert_eq!(ball().audit(), sound(2, 1));
    assert_eq!(SolidBuilder::default().ring(10.0, 3.0, 12).mesh().audit(), sound(0, 1));
    let two = SolidBuilder::default().block([0.0; 3], [1.0; 3], false).ball([5.0, 0.0, 0.0], 1.0, 5).mesh();
    assert_eq!(two.audit(), sound(4, 2));
    assert_eq!(empty().audit(), sound(0, 0));
    assert!(two.audit().is_watertight() && empty().audit().is_watertight());
    assert_eq!((empty().volume(), empty().area(), empty().bounds()), (0.0, 0.0, None));
}

#[test]
fn defects_are_counted() {
    let cube = || SolidBuilder::default().block([0.0; 3], [1.0; 3], false);
    let torn = cube().torn().audit();
    assert_eq!((torn.boundary_edges, torn.euler_characteristic, torn.is_watertight()), (3, 1, false));
    let twisted = cube().twisted().audit();
    assert_eq!((twisted.inconsistent_edges, twisted.boundary_edges, twisted.is_watertight()), (3, 0, false));
    let flat = SolidBuilder::default().block([0.0; 3], [1.0, 1.0, 0.0], false).mesh().audit();
    assert_eq!((flat.degenerate_triangles, flat.is_watertight()), (8, true));
}

#[test]
fn fins_and_pinched_vertices_are_counted() {
    let tetrahedron = |[a, b, c, d]: [u32; 4]| [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
    let corner = |x: f64, y: f64, z: f64| [x, y, z];
    let mut positions =
        vec![corner(0.0, 0.0, 0.0), corner(1.0, 0.0, 0.0), corner(0.0, 1.0, 0.0), corner(0.0, 0.0, 1.0)];
    positions.extend([corner(-1.0, 0.0, 0.0), corner(0.0, -1.0, 0.0), corner(0.0, 0.0, -1.0)]);
    let both = |second: [u32; 4], vertices: usize| {
        let triangles = [tetrahedron([0, 1, 2, 3]), tetrahedron(second)].concat();
        verne_mesh::Mesh::new(positions[..vertices].to_vec(), triangles, vec![0; 8], solids::palette())
            .unwrap()
            .audit()
    };
    let pinched = both([0, 4, 5, 6], 7);
    assert_eq!((pinched.pinched_vertices, pinched.components, pinched.is_watertight()), (1, 2, true));
    let finned = both([0, 1, 4, 5], 6);
    assert_eq!((finned.non_manifold_edges, finned.components, finned.is_watertight()), (1, 1, false));
}

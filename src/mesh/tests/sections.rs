//! Cuts of solids by planes.

#[path = "support/solids.rs"]
mod solids;

use solids::{SolidBuilder, block, empty};
use verne_mesh::{Contour, Mesh};

fn areas(mesh: &Mesh, z: f64) -> Vec<f64> {
    mesh.section(z).iter().map(Contour::area).collect()
}

#[test]
fn the_contour_of_a_box_runs_counter_clockwise() {
    let contours = block().section(904.0);
    assert_eq!(contours.len(), 1);
    assert_eq!(contours[0].area(), 600.0);
    for [x, y] in &contours[0].points {
        assert!([-10.0, 20.0].contains(x) || [5.0, 25.0].contains(y));
    }
}

#[test]
fn a_void_gives_a_hole_and_a_second_solid_a_second_contour() {
    let shell = SolidBuilder::default().block([0.0; 3], [10.0; 3], false).block([2.0; 3], [5.0; 3], true);
    let mesh =
        shell.block([20.0; 3], [21.0; 3], false).block([20.0, 0.0, 0.0], [22.0, 1.0, 30.0], false).mesh();
    assert_eq!(areas(&mesh, 3.0), [100.0, -9.0, 2.0]);
    assert_eq!(areas(&mesh, 7.0), [100.0, 2.0]);
    assert_eq!(areas(&mesh, 20.5), [1.0, 2.0]);
}

#[test]
fn a_face_in_the_plane_appears_if_the_inside_is_below_it() {
    assert_eq!(areas(&block(), 910.0), [600.0]);
    assert!(areas(&block(), 900.0).is_empty());
    assert!(areas(&block(), 910.5).is_empty());
    assert!(areas(&empty(), 0.0).is_empty());
}

#[test]
fn vertices_in_the_plane_appear_exactly_and_once() {
    let mesh = SolidBuilder::default().ball([0.0; 3], 10.0, 8).mesh();
    let equator = mesh.section(0.0);
    assert_eq!(equator.len(), 1);
    assert_eq!(equator[0].points.len(), 32);
    for [x, y] in &equator[0].points {
        assert!((x.hypot(*y) - 10.0).abs() < 1e-12);
    }
    assert!(areas(&mesh, 10.0).is_empty(), "the pole only touches");
}

#[test]
fn the_areas_of_slices_sum_to_the_volume_of_a_ring() {
    let mesh = SolidBuilder::default().ring(10.0, 3.0, 24).mesh();
    let contours = mesh.section(0.1);
    assert_eq!(contours.iter().filter(|contour| contour.area() > 0.0).count(), 1);
    assert_eq!(contours.iter().filter(|contour| contour.area() < 0.0).count(), 1);
    let slices = 400;
    let thickness = 6.0 / f64::from(slices);
    let sum: f64 = (0..slices)
        .map(|i| areas(&mesh, -3.0 + (f64::from(i) + 0.5) * thickness).iter().sum::<f64>() * thickness)
        .sum();
    assert!((sum / mesh.volume() - 1.0).abs() < 1e-4, "{sum} is not {}", mesh.volume());
}

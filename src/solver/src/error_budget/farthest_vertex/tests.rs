//! The farthest vertex against all vertices of the box.

use nalgebra::Vector3;

use super::farthest_vertex;
use crate::parameter::PARAMETERS;
use crate::random::Random;

/// The greatest distance of all 2^n vertices.
fn greatest_of_all(segments: &[Vector3<f64>]) -> f64 {
    let (last, others) = segments.split_last().map_or((Vector3::zeros(), segments), |(a, b)| (*a, b));
    // The opposite vertex is as far: the last segment has the sign 1.
    let vertex = |signs: u32| -> Vector3<f64> {
        let each = others.iter().enumerate();
        each.map(|(k, segment)| if signs >> k & 1 == 0 { *segment } else { -segment }).sum()
    };
    (0..1_u32 << others.len()).map(|signs| (last + vertex(signs)).norm()).fold(0.0, f64::max)
}

fn check(some: &[Vector3<f64>]) {
    let mut segments = [Vector3::zeros(); PARAMETERS];
    segments[..some.len()].copy_from_slice(some);
    let signs = farthest_vertex(&segments);
    assert!(
        signs
            .iter()
            .zip(&segments)
            .all(|(sign, segment)| { if segment.norm() == 0.0 { *sign == 0.0 } else { sign.abs() == 1.0 } })
    );
    let found: Vector3<f64> = segments.iter().zip(signs).map(|(segment, sign)| segment * sign).sum();
    let expected = greatest_of_all(some);
    assert!((found.norm() - expected).abs() <= 1e-12 * expected, "{} {expected} {some:?}", found.norm());
}

fn vector(draw: &mut Random) -> Vector3<f64> {
    let scale = draw.magnitude(1e-3, 1e3);
    Vector3::from([0, 1, 2].map(|_| scale * draw.between(-1.0, 1.0)))
}

#[test]
fn no_vertex_of_the_box_is_farther() {
    let mut draw = Random::new(2120);
    for n in 0..14 {
        for _ in 0..10 {
            check(&(0..n).map(|_| vector(&mut draw)).collect::<Vec<_>>());
        }
    }
}

#[test]
fn no_vertex_is_farther_where_segments_are_parallel_or_coplanar() {
    let mut draw = Random::new(2121);
    for _ in 0..200 {
        let base: Vec<Vector3<f64>> = (0..3).map(|_| vector(&mut draw)).collect();
        let rank = 1 + draw.bits() % 3;
        let segment = |draw: &mut Random| -> Vector3<f64> {
            // Whole multiples, so that coplanar segments are so to rounding.
            let times: Vec<f64> = (0..rank).map(|_| draw.between(-2.5, 2.5).round()).collect();
            base.iter().zip(times).map(|(vector, times)| vector * times).sum()
        };
        check(&(0..10).map(|_| segment(&mut draw)).collect::<Vec<_>>());
    }
}

#[test]
fn no_vertex_is_farther_where_segments_lie_along_axes() {
    let mut draw = Random::new(2122);
    for _ in 0..200 {
        let segment = |draw: &mut Random| {
            let mut vector = Vector3::zeros();
            for axis in 0..3 {
                vector[axis] = draw.pick(&[0.0, 0.0, 1.0, -1.0, 0.5]);
            }
            vector
        };
        check(&(0..11).map(|_| segment(&mut draw)).collect::<Vec<_>>());
    }
}

//! Polygons with holes, made from the sides of the domain.

use std::collections::BTreeMap;

use crate::workspace::plane::PlaneMesh;

/// A closed polygon with holes. The last corner of a ring joins the first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygon {
    /// Counter-clockwise.
    pub outer: Vec<[f64; 2]>,
    /// Clockwise.
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// The domain's sides as polygons of the image.
pub(super) fn polygons(plane: &PlaneMesh) -> Vec<Polygon> {
    let mut rings: Vec<Vec<[f64; 2]>> = rings(plane)
        .into_iter()
        .map(|ring| {
            ring.into_iter()
                .map(|vertex| {
                    let [x, y, _] = plane.vertices[vertex as usize].ends[0];
                    [x, y]
                })
                .collect()
        })
        .collect();
    // The domain lies to the left of its sides. The map to the part frame mirrors the plane.
    if rings.iter().map(|ring| ring_area(ring)).sum::<f64>() < 0.0 {
        for ring in &mut rings {
            ring.reverse();
        }
    }
    nested(rings)
}

/// Closed rings of vertices, each beginning at its least number.
fn rings(plane: &PlaneMesh) -> Vec<Vec<u32>> {
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for side in &plane.boundary {
        next.entry(side.ends[0]).or_default().push(side.ends[1]);
    }
    let mut rings = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let (mut ring, mut here) = (Vec::new(), start);
        while let Some(ways) = next.get_mut(&here) {
            ring.push(here);
            let Some(to) = ways.pop() else { break };
            if ways.is_empty() {
                next.remove(&here);
            }
            here = to;
        }
        if ring.len() >= 3 {
            rings.push(ring);
        }
    }
    rings
}

/// Signed area of a ring, mm²: positive if it is counter-clockwise.
pub(super) fn ring_area(ring: &[[f64; 2]]) -> f64 {
    let Some(&[ox, oy]) = ring.first() else { return 0.0 };
    let next = ring.iter().cycle().skip(1);
    let twice: f64 =
        ring.iter().zip(next).map(|([ax, ay], [bx, by])| (ax - ox) * (by - oy) - (ay - oy) * (bx - ox)).sum();
    0.5 * twice
}

/// Assigns each clockwise ring to the smallest counter-clockwise ring around it.
pub(crate) fn nested(rings: Vec<Vec<[f64; 2]>>) -> Vec<Polygon> {
    let (outers, holes): (Vec<_>, Vec<_>) = rings.into_iter().partition(|ring| ring_area(ring) > 0.0);
    let mut polygons: Vec<Polygon> =
        outers.into_iter().map(|outer| Polygon { outer, holes: Vec::new() }).collect();
    for hole in holes {
        let around = (0..polygons.len())
            .filter(|&i| hole.first().is_some_and(|&point| surrounds(&polygons[i].outer, point)))
            .min_by(|&i, &j| ring_area(&polygons[i].outer).total_cmp(&ring_area(&polygons[j].outer)));
        if let Some(i) = around {
            polygons[i].holes.push(hole);
        }
    }
    polygons
}

/// Whether a point is inside a ring, by the sides that a ray from it crosses.
fn surrounds(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crossed = ring
        .iter()
        .zip(next)
        .filter(|([ax, ay], [bx, by])| (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax));
    crossed.count() % 2 == 1
}

//! Cuts of a closed surface with a plane of constant z.

use std::collections::BTreeMap;

use crate::pose::Point;
use crate::workspace::{Polygon, nested};

/// The cut of a closed surface at z = `height` as polygons with holes. It is within the surface's own distance from the
/// region: it consists of cuts through its triangles.
///
/// # Units
///
/// Millimetres.
///
/// # Examples
///
/// ```
/// use verne_solver::toolpath::slice_origins;
///
/// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
/// let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// let cut = slice_origins(&corners, &faces, 1.0);
/// assert_eq!(cut.len(), 1);
/// assert_eq!(cut[0].outer.len(), 3);
/// ```
pub fn slice_origins(positions: &[Point], triangles: &[[u32; 3]], height: f64) -> Vec<Polygon> {
    // A corner in the plane counts as above it, so a side crosses the plane or does not touch it.
    let is_above = |corner: u32| positions[corner as usize][2] >= height;
    let mut next: BTreeMap<(u32, u32), Vec<(u32, u32)>> = BTreeMap::new();
    for triangle in triangles {
        let sides = [0, 1, 2].map(|i| [triangle[i], triangle[(i + 1) % 3]]);
        let crossing = |rises: bool| {
            let side = sides.iter().find(|[a, b]| is_above(*a) != is_above(*b) && is_above(*b) == rises);
            side.map(|[a, b]| (*a.min(b), *a.max(b)))
        };
        // Seen from above with the inside on the left.
        if let (Some(falls), Some(rises)) = (crossing(false), crossing(true)) {
            next.entry(falls).or_default().push(rises);
        }
    }
    let mut rings = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let (mut ring, mut here) = (Vec::new(), start);
        while let Some(ways) = next.get_mut(&here) {
            ring.push(point(positions, here, height));
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
    nested(rings)
}

/// Where a side crosses the plane.
fn point(positions: &[Point], (a, b): (u32, u32), height: f64) -> [f64; 2] {
    let [from, to] = [a, b].map(|corner| positions[corner as usize]);
    let part = (height - from[2]) / (to[2] - from[2]);
    [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
}

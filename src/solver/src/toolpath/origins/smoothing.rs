//! Vertices of the region's surface at equal distances.
//!
//! The cuts through the grid's cells have slivers where the boundary is near a node. Their normals say nothing, and the
//! refinement moves along normals. So each vertex moves towards the middle of its neighbours, and back to the boundary.

use rayon::prelude::*;

use super::boundary_search::{BoundarySearch, moved, unit};
use crate::pose::Point;
use crate::workspace::observer::check_cancelled;
use crate::workspace::vector::{minus, normal};
use crate::workspace::{Observer, WorkspaceError};

/// Number of moves, after which all vertices return to the boundary once more.
const MOVES: usize = 3;
/// Part of the way to the middle of the neighbours.
const PART: f64 = 0.5;

/// Moves the vertices of a closed surface.
pub(super) fn smooth(
    search: &BoundarySearch<'_>,
    positions: &mut [Point],
    triangles: &[[u32; 3]],
    observer: &dyn Observer,
) -> Result<(), WorkspaceError> {
    for number in 0..=MOVES {
        if number < MOVES {
            towards_neighbours(positions, triangles);
        }
        let normals = vertex_normals(positions, triangles);
        positions.par_iter_mut().zip(normals).try_for_each_init(
            || 0,
            |hint, (at, normal)| {
                check_cancelled(observer)?;
                if let Some(outwards) = unit(normal)
                    && let Some(offset) = search.offset(*at, outwards, hint)
                {
                    *at = moved(*at, outwards, offset);
                }
                Ok(())
            },
        )?;
    }
    Ok(())
}

fn towards_neighbours(positions: &mut [Point], triangles: &[[u32; 3]]) {
    let mut sums = vec![([0.0; 3], 0.0); positions.len()];
    for [a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let (sum, count) = &mut sums[*from as usize];
            *sum = moved(*sum, positions[*to as usize], 1.0);
            *count += 1.0;
        }
    }
    for (at, (sum, count)) in positions.iter_mut().zip(sums) {
        // Every edge begins at a vertex once.
        if count > 0.0 {
            *at = moved(*at, minus(sum.map(|c| c / count), *at), PART);
        }
    }
}

/// The sum of the normals of the triangles around each vertex, each as long as twice the triangle's area.
fn vertex_normals(positions: &[Point], triangles: &[[u32; 3]]) -> Vec<Point> {
    let mut normals = vec![[0.0; 3]; positions.len()];
    for corners in triangles {
        let of_triangle = normal(corners.map(|corner| positions[corner as usize]));
        for corner in corners {
            let sum = &mut normals[*corner as usize];
            *sum = moved(*sum, of_triangle, 1.0);
        }
    }
    normals
}

//! Split of a surface that touches itself into manifolds.
//!
//! Components of the workspace may meet in a point or in an edge. There the surface is cut: each component gets its
//! own vertices at the same position.

use super::half_edge::{HalfEdges, ends};
use super::mesh::Surface;
use crate::workspace::observer::StepCounter;
use crate::workspace::request::WorkspaceError;

/// Makes every edge belong to two triangles, which run along it in opposite directions, and every vertex to one ring
/// of triangles. It is an error if the surface is not closed. The time is linear if there is nothing to do.
pub(super) fn split(surface: &mut Surface, steps: &mut StepCounter<'_>) -> Result<(), WorkspaceError> {
    // Each round removes triangles, separates an edge of more than two triangles, or is the last.
    loop {
        let half_edges = HalfEdges::of(surface, steps)?;
        if !half_edges.doubled.is_empty() {
            remove_doubled(surface, &half_edges.doubled, steps)?;
            continue;
        }
        split_vertices(surface, &half_edges, steps)?;
        if !separate_edges(surface, &half_edges) {
            return Ok(());
        }
    }
}

/// A triangle may have several duplicates. Only whole pairs are removed.
fn remove_doubled(
    surface: &mut Surface,
    doubled: &[[usize; 2]],
    steps: &mut StepCounter<'_>,
) -> Result<(), WorkspaceError> {
    let mut retained = steps.filled(&true, surface.triangles.len())?;
    for &[a, b] in doubled {
        if retained[a] && retained[b] {
            (retained[a], retained[b]) = (false, false);
        }
    }
    surface.retain(&retained, steps)
}

/// Gives each ring of triangles around a vertex its own copy of the vertex. The first ring uses the original.
fn split_vertices(
    surface: &mut Surface,
    half_edges: &HalfEdges,
    steps: &mut StepCounter<'_>,
) -> Result<(), WorkspaceError> {
    let mut used = vec![false; surface.positions.len()];
    let mut seen = vec![false; half_edges.twins.len()];
    for first in 0..seen.len() {
        steps.step()?;
        if seen[first] {
            continue;
        }
        let vertex = surface.triangles[first / 3][first % 3];
        let another = std::mem::replace(&mut used[vertex as usize], true);
        let number = if another { copy(surface, vertex) } else { vertex };
        let mut corner = first;
        while !seen[corner] {
            seen[corner] = true;
            surface.triangles[corner / 3][corner % 3] = number;
            corner = half_edges.around(corner);
        }
    }
    Ok(())
}

fn copy(surface: &mut Surface, vertex: u32) -> u32 {
    surface.positions.push(surface.positions[vertex as usize]);
    newest_vertex(surface)
}

/// Separates sheets that touch along an edge and are connected around both its ends. Copies of the ends do not
/// distinguish the pairs of triangles, so all pairs but one get a vertex in between. Returns whether there was such
/// an edge.
fn separate_edges(surface: &mut Surface, half_edges: &HalfEdges) -> bool {
    let mut touched =
        vec![false; if half_edges.crowded_edges.is_empty() { 0 } else { surface.triangles.len() }];
    let mut found = false;
    for edge in &half_edges.crowded_edges {
        let edges: Vec<[u32; 2]> = edge.iter().map(|&half_edge| ends(surface, half_edge)).collect();
        for (i, &half_edge) in edge.iter().enumerate() {
            let pair = [half_edge, half_edges.twins[half_edge as usize]];
            let triangles = pair.map(|half_edge| (half_edge / 3) as usize);
            let same = edges[..i].contains(&edges[i]);
            found |= same;
            // A changed triangle has other sides now; the next round examines it again.
            if same && !triangles.iter().any(|&triangle| touched[triangle]) {
                for triangle in triangles {
                    touched[triangle] = true;
                }
                let [a, b] = edges[i].map(|end| surface.positions[end as usize]);
                surface.positions.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
                let middle = newest_vertex(surface);
                for half_edge in pair {
                    halve(surface, half_edge, middle);
                }
            }
        }
    }
    found
}

fn halve(surface: &mut Surface, half_edge: u32, middle: u32) {
    let (triangle, corner) = ((half_edge / 3) as usize, (half_edge % 3) as usize);
    let mut other = surface.triangles[triangle];
    surface.triangles[triangle][(corner + 1) % 3] = middle;
    other[corner] = middle;
    surface.triangles.push(other);
    surface.bindings.push(surface.bindings[triangle]);
}

/// Number of the vertex added last.
fn newest_vertex(surface: &Surface) -> u32 {
    u32::try_from(surface.positions.len() - 1).unwrap_or(u32::MAX)
}

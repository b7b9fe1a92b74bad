//! Conversion of a surface that touches itself to a manifold.
//!
//! Parts of the workspace may meet in a point or in an edge. There the surface is cut: each part gets its own
//! vertices in the same place.

use super::Surface;
use super::twins::{Twins, ends};
use crate::workspace::observer::Pace;
use crate::workspace::request::WorkspaceError;

/// Makes every edge belong to two triangles, which run along it in opposite directions, and every vertex to one ring
/// of triangles. It is an error if the surface is not closed. The time is linear if there is nothing to do.
pub(super) fn part(surface: &mut Surface, pace: &mut Pace<'_>) -> Result<(), WorkspaceError> {
    // Each round removes triangles, separates an edge of more than two triangles, or is the last.
    loop {
        let twins = Twins::of(surface, pace)?;
        if !twins.doubled.is_empty() {
            take_out(surface, &twins.doubled, pace)?;
            continue;
        }
        part_vertices(surface, &twins, pace)?;
        if !bisect(surface, &twins) {
            return Ok(());
        }
    }
}

/// A triangle may have several duplicates. Only whole pairs are removed.
fn take_out(
    surface: &mut Surface,
    doubled: &[[usize; 2]],
    pace: &mut Pace<'_>,
) -> Result<(), WorkspaceError> {
    let mut kept = pace.filled(&true, surface.triangles.len())?;
    for &[a, b] in doubled {
        if kept[a] && kept[b] {
            (kept[a], kept[b]) = (false, false);
        }
    }
    super::tidy::compact(surface, &kept, pace)
}

/// Gives each ring of triangles around a vertex its own copy of the vertex. The first keeps the original.
fn part_vertices(surface: &mut Surface, twins: &Twins, pace: &mut Pace<'_>) -> Result<(), WorkspaceError> {
    let mut taken = vec![false; surface.positions.len()];
    let mut seen = vec![false; twins.of.len()];
    for first in 0..seen.len() {
        pace.step()?;
        if seen[first] {
            continue;
        }
        let vertex = surface.triangles[first / 3][first % 3];
        let another = std::mem::replace(&mut taken[vertex as usize], true);
        let number = if another { copy(surface, vertex) } else { vertex };
        let mut corner = first;
        while !seen[corner] {
            seen[corner] = true;
            surface.triangles[corner / 3][corner % 3] = number;
            corner = twins.around(corner);
        }
    }
    Ok(())
}

fn copy(surface: &mut Surface, vertex: u32) -> u32 {
    surface.positions.push(surface.positions[vertex as usize]);
    last(surface)
}

/// Separates sheets that touch along an edge and are connected around both its ends. Copies of the ends do not
/// distinguish the pairs of triangles, so all pairs but one get a vertex in between. Returns whether there was such
/// an edge.
fn bisect(surface: &mut Surface, twins: &Twins) -> bool {
    let mut touched = vec![false; if twins.crowds.is_empty() { 0 } else { surface.triangles.len() }];
    let mut found = false;
    for crowd in &twins.crowds {
        let edges: Vec<[u32; 2]> = crowd.iter().map(|&side| ends(surface, side)).collect();
        for (i, &side) in crowd.iter().enumerate() {
            let pair = [side, twins.of[side as usize]];
            let triangles = pair.map(|side| (side / 3) as usize);
            let same = edges[..i].contains(&edges[i]);
            found |= same;
            // A changed triangle has other sides now; the next round examines it again.
            if same && !triangles.iter().any(|&triangle| touched[triangle]) {
                for triangle in triangles {
                    touched[triangle] = true;
                }
                let [a, b] = edges[i].map(|end| surface.positions[end as usize]);
                surface.positions.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
                let middle = last(surface);
                for side in pair {
                    halve(surface, side, middle);
                }
            }
        }
    }
    found
}

fn halve(surface: &mut Surface, side: u32, middle: u32) {
    let (triangle, corner) = ((side / 3) as usize, (side % 3) as usize);
    let mut other = surface.triangles[triangle];
    surface.triangles[triangle][(corner + 1) % 3] = middle;
    other[corner] = middle;
    surface.triangles.push(other);
    surface.bindings.push(surface.bindings[triangle]);
}

/// Number of the vertex added last.
fn last(surface: &Surface) -> u32 {
    u32::try_from(surface.positions.len() - 1).unwrap_or(u32::MAX)
}

//! Conversion of a leaf's pieces to triangles and sides of the plane.

use super::super::super::domain::{BY_TABLE, LIMITS};
use super::super::super::observer::Pace;
use super::super::super::request::WorkspaceError;
use super::super::ears;
use super::super::patch::{Patch, Rim, Set, Triangle};
use super::super::site::{CREASES, FLOOR, Site};
use super::{Leaf, Piece};

impl Leaf<'_> {
    /// Triangles and sides of all pieces.
    pub(super) fn deliver(self, patch: &mut Patch) -> Result<(), WorkspaceError> {
        let mut pace = Pace::new(self.observer);
        let mut outlines = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let mut piece = self.with_divisions(piece);
            let mut numbers: Vec<u32> =
                piece.iter().map(|&site| patch.vertex(self.domain, &self.sites[site])).collect();
            let mut limits = self.limits(&piece);
            without_spikes(&mut piece, &mut numbers, &mut limits);
            for (ends, limit) in sides(&numbers).zip(&limits) {
                patch.rims.extend(limit.map(|limit| Rim { ends, limit }));
            }
            outlines.push((piece, numbers));
        }
        // If all pieces are triangles already, the edges elsewhere do not matter.
        let cuts = outlines.iter().any(|(_, numbers)| numbers.len() > 3);
        let mut edges: Set<[u32; 2]> = Set::default();
        if cuts {
            edges.extend(outlines.iter().flat_map(|(_, numbers)| sides(numbers)));
        }
        for (piece, numbers) in outlines {
            let sliders = self.sliders(&piece);
            let sites: Vec<&Site> = piece.iter().map(|&site| &self.sites[site]).collect();
            let taken = |i: usize, j: usize| {
                let (a, b) = (numbers[i], numbers[j]);
                edges.contains(&[a, b]) || edges.contains(&[b, a])
            };
            for ear in ears::triangulate(&sites, taken, &mut pace)? {
                let corners = ear.map(|i| numbers[i]);
                patch.triangles.push(Triangle { corners, sliders });
                if cuts {
                    edges.extend(sides(&corners));
                }
            }
        }
        Ok(())
    }

    /// The limit on which each side of a piece lies, if on any.
    fn limits(&self, piece: &[usize]) -> Vec<Option<u8>> {
        let next = piece.iter().cycle().skip(1);
        piece
            .iter()
            .zip(next)
            .map(|(&a, &b)| {
                let common = self.sites[a].on() & self.sites[b].on() & ((1 << LIMITS) - 1);
                (common != 0).then(|| u8::try_from(common.trailing_zeros()).unwrap_or(u8::MAX))
            })
            .collect()
    }

    /// The sliders that bind the sheets on a piece, or the table.
    fn sliders(&self, piece: &[usize]) -> [u8; 2] {
        [(CREASES, FLOOR), (CREASES + 2, FLOOR + 1)].map(|(first, table)| {
            if self.side(table, piece) > 0.0 {
                BY_TABLE
            } else if self.side(first, piece) > 0.0 {
                0
            } else if self.side(first + 1, piece) > 0.0 {
                1
            } else {
                2
            }
        })
    }
}

/// The sides of a ring of vertices.
fn sides(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&a, &b)| [a, b])
}

/// Removes points that coincide with their neighbours, and sides that go forth and back. The remaining sides keep
/// their limits, whichever of the coinciding points stays.
fn without_spikes(piece: &mut Piece, numbers: &mut Vec<u32>, limits: &mut Vec<Option<u8>>) {
    let mut i = 0;
    while i < numbers.len() && numbers.len() > 2 {
        let count = numbers.len();
        let (before, after) = (numbers[(i + count - 1) % count], numbers[(i + 1) % count]);
        if numbers[i] == after || before == after {
            piece.remove(i);
            numbers.remove(i);
            limits.remove(i);
            i = 0;
        } else {
            i += 1;
        }
    }
    if numbers.len() < 3 {
        piece.clear();
        numbers.clear();
        limits.clear();
    }
}

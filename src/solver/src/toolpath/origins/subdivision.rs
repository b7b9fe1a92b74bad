//! Division of triangles at new vertices of their edges.

use crate::pose::Point;
use crate::workspace::vector::distance;

/// Ends of an edge, the lower vertex number first.
pub(super) type Ends = [u32; 2];

/// The edges of a triangle, from each corner to the next one.
pub(super) fn edges([a, b, c]: [u32; 3]) -> [Ends; 3] {
    [[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to)])
}

/// The triangles into which new vertices of its edges divide a triangle; none if it has none. `new` are the vertices of
/// the edges from each corner to the next one.
pub(super) fn divided(positions: &[Point], corners: [u32; 3], new: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    // Turned so that the first edges have the new vertices.
    let first = match new {
        [None, Some(_), _] => 1,
        [_, None, Some(_)] => 2,
        _ => 0,
    };
    let turned = [0, 1, 2].map(|i| (first + i) % 3);
    let [a, b, c] = turned.map(|i| corners[i]);
    let length = |from: u32, to: u32| distance(positions[from as usize], positions[to as usize]);
    match turned.map(|i| new[i]) {
        [Some(p), Some(q), Some(r)] => vec![[a, p, r], [p, b, q], [r, q, c], [p, q, r]],
        [Some(p), Some(q), None] if length(a, q) < length(p, c) => vec![[p, b, q], [a, p, q], [a, q, c]],
        [Some(p), Some(q), None] => vec![[p, b, q], [a, p, c], [p, q, c]],
        [Some(p), None, _] => vec![[a, p, c], [p, b, c]],
        [None, ..] => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::divided;

    /// The directed edges of the parts are those of the triangle's outline with the new vertices; inner edges occur in
    /// both directions.
    #[test]
    fn parts_have_the_outline_of_the_triangle() {
        let positions = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [0.0, 3.0, 0.0],
            [2.0, 0.0, 1.0],
            [2.0, 1.5, 1.0],
            [0.0, 1.5, 1.0],
        ];
        for choice in 0..8_u32 {
            let has = |edge: u32| choice >> edge & 1 == 1;
            let new = [0, 1, 2].map(|edge| has(edge).then_some(3 + edge));
            let parts = divided(&positions, [0, 1, 2], new);
            assert_eq!(parts.len(), [0, 2, 2, 3, 2, 3, 3, 4][choice as usize]);
            if parts.is_empty() {
                continue;
            }
            let mut edges: Vec<[u32; 2]> = Vec::new();
            for [a, b, c] in parts {
                for edge in [[a, b], [b, c], [c, a]] {
                    match edges.iter().position(|known| *known == [edge[1], edge[0]]) {
                        Some(inner) => drop(edges.remove(inner)),
                        None => edges.push(edge),
                    }
                }
            }
            let mut outline = Vec::new();
            for edge in 0..3 {
                outline.push(edge);
                outline.extend(has(edge).then_some(3 + edge));
            }
            let next = outline.iter().cycle().skip(1);
            let mut expected: Vec<_> = outline.iter().zip(next).map(|(a, b)| [*a, *b]).collect();
            edges.sort_unstable();
            expected.sort_unstable();
            assert_eq!(edges, expected, "{choice}");
        }
    }
}

//! Least distance between the axes of two rods.

use crate::machine::Geometry;
use crate::rods::{FAMILY, RODS, Rods};

/// Pairs of rods as indices of the six. Rods 22 and 32 stand to each other as 21 and 31 do.
const PAIRS: [(usize, usize); 14] = [
    (0, 1),
    (2, 3),
    (4, 5),
    (0, 2),
    (0, 3),
    (0, 4),
    (0, 5),
    (1, 2),
    (1, 3),
    (1, 4),
    (1, 5),
    (2, 4),
    (2, 5),
    (3, 4),
];
/// Of two rods whose directions differ by less than the square root of this, the parallel formula
/// serves: the distance does not depend on where along them it is measured.
const PARALLEL: f64 = 1e-14;

/// The least distance between two rods' axes as segments, mm, and the two rods' numbers.
#[inline]
pub(crate) fn nearest(g: &Geometry, rods: &Rods, x: [f64; 2], y: f64) -> (f64, [u8; 2]) {
    let ends = rods.slider_ends(g, x, y);
    let dots = Dots::new(rods);
    let squares = PAIRS.map(|(i, j)| square_distance(&ends, rods, &dots, i, j));
    let mut least = 0;
    for (i, square) in squares.iter().enumerate() {
        if *square < squares[least] {
            least = i;
        }
    }
    let (i, j) = PAIRS[least];
    (squares[least].sqrt(), [RODS[i], RODS[j]])
}

/// Products of the rod vectors, which pairs of the same families share.
struct Dots {
    product: [[f64; 4]; 4],
    inverse_length: [f64; 4],
    /// 1 / (|a|²|b|² - (a·b)²), zero for parallel rods.
    inverse_gram: [[f64; 4]; 4],
}

impl Dots {
    #[inline]
    fn new(rods: &Rods) -> Self {
        let mut product = [[0.0; 4]; 4];
        let mut inverse_gram = [[0.0; 4]; 4];
        for i in 0..4 {
            product[i][i] = dot(rods.vectors[i], rods.vectors[i]);
        }
        let inverse_length = std::array::from_fn(|i| 1.0 / product[i][i]);
        for i in 0..4 {
            for j in i + 1..4 {
                let across = dot(rods.vectors[i], rods.vectors[j]);
                let full = product[i][i] * product[j][j];
                let gram = full - across * across;
                product[i][j] = across;
                inverse_gram[i][j] = if gram > PARALLEL * full { 1.0 / gram } else { 0.0 };
            }
        }
        Self { product, inverse_length, inverse_gram }
    }
}

/// Squared distance of two segments: the nearest points of the lines, then each clamped to its
/// segment in turn (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9).
#[inline]
fn square_distance(ends: &[[f64; 3]; 6], rods: &Rods, dots: &Dots, i: usize, j: usize) -> f64 {
    let (fi, fj) = (FAMILY[i], FAMILY[j]);
    let (a, b) = (rods.vectors[fi], rods.vectors[fj]);
    let offset: [f64; 3] = std::array::from_fn(|axis| ends[i][axis] - ends[j][axis]);
    let across = dots.product[fi][fj];
    let (along_a, along_b) = (dot(a, offset), dot(b, offset));
    let length_b = dots.product[fj][fj];
    let s = ((across * along_b - along_a * length_b) * dots.inverse_gram[fi][fj]).clamp(0.0, 1.0);
    let t = ((across * s + along_b) * dots.inverse_length[fj]).clamp(0.0, 1.0);
    let s = ((across * t - along_a) * dots.inverse_length[fi]).clamp(0.0, 1.0);
    let gap: [f64; 3] = std::array::from_fn(|axis| offset[axis] + a[axis] * s - b[axis] * t);
    dot(gap, gap)
}

#[inline]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

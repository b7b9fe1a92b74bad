//! The lattice of squares over the plane domain.

use crate::workspace::cover::Rectangle;

/// A lattice of rectangles as nearly square as whole numbers allow.
pub(super) struct Lattice {
    /// Coordinates of its lines, along x and y.
    lines: [Vec<f64>; 2],
}

impl Lattice {
    pub(super) fn new([low, high]: Rectangle, along: u32) -> Self {
        let sizes = [high[0] - low[0], high[1] - low[1]];
        let size = sizes[0].max(sizes[1]) / f64::from(along);
        let lines = [0, 1].map(|axis| {
            let count = (1..along).find(|&n| f64::from(n) * size >= 0.9 * sizes[axis]).unwrap_or(along);
            (0..=count).map(|n| low[axis] + sizes[axis] * (f64::from(n) / f64::from(count))).collect()
        });
        Self { lines }
    }

    pub(super) fn count(&self) -> usize {
        (self.lines[0].len() - 1) * (self.lines[1].len() - 1)
    }

    /// Corners of a rectangle, counter-clockwise.
    pub(super) fn corners(&self, number: usize) -> [[f64; 2]; 4] {
        let across = self.lines[0].len() - 1;
        let (i, j) = (number % across, number / across);
        let ([x0, x1], [y0, y1]) =
            ([self.lines[0][i], self.lines[0][i + 1]], [self.lines[1][j], self.lines[1][j + 1]]);
        [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    }

    /// Whether a point lies on the lattice's lines, where it may belong to two squares.
    pub(super) fn shared(&self, [x, y]: [f64; 2]) -> bool {
        self.lines[0].binary_search_by(|line| line.total_cmp(&x)).is_ok()
            || self.lines[1].binary_search_by(|line| line.total_cmp(&y)).is_ok()
    }
}

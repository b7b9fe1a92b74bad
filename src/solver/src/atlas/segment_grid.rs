//! Pairs of segments that may meet.

/// Segments in the squares of a grid.
pub(super) struct SegmentGrid<'a> {
    segments: &'a [[[f64; 2]; 2]],
    low: [f64; 2],
    step: f64,
    columns: usize,
    rows: usize,
    squares: Vec<Vec<u32>>,
}

/// Most squares along a side.
const MOST: f64 = 512.0;

impl<'a> SegmentGrid<'a> {
    pub(super) fn new(segments: &'a [[[f64; 2]; 2]]) -> Self {
        let ends = || segments.iter().flatten();
        let least = |i: usize| ends().map(|end| end[i]).fold(f64::INFINITY, f64::min);
        let most = |i: usize| ends().map(|end| end[i]).fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
        let side = (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
        #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
        let wanted = (segments.len() as f64).sqrt().clamp(1.0, MOST);
        let step = side / wanted;
        let count = |i: usize| if segments.is_empty() { 1 } else { square_of(high[i], low[i], step) + 1 };
        let (columns, rows) = (count(0), count(1));
        let mut grid = Self { segments, low, step, columns, rows, squares: vec![Vec::new(); columns * rows] };
        for (number, segment) in (0_u32..).zip(segments) {
            let [[from, to], [bottom, top]] = grid.range(segment);
            for row in bottom..=top {
                for column in from..=to {
                    grid.squares[row * columns + column].push(number);
                }
            }
        }
        grid
    }

    /// Columns and rows of a segment's bounding box.
    fn range(&self, segment: &[[f64; 2]; 2]) -> [[usize; 2]; 2] {
        [0, 1].map(|i| {
            let most = if i == 0 { self.columns } else { self.rows } - 1;
            let [a, b] = [segment[0][i], segment[1][i]];
            [a.min(b), a.max(b)].map(|at| square_of(at, self.low[i], self.step).min(most))
        })
    }

    /// Calls `meet` once with each pair of segments whose bounding boxes meet.
    pub(super) fn for_each_pair(&self, mut meet: impl FnMut(usize, usize)) {
        for (number, square) in self.squares.iter().enumerate() {
            let here = [number % self.columns, number / self.columns];
            for (k, &i) in square.iter().enumerate() {
                for &j in &square[k + 1..] {
                    let (i, j) = (i as usize, j as usize);
                    let [a, b] = [self.range(&self.segments[i]), self.range(&self.segments[j])];
                    // The first square that both have.
                    let first = [0, 1].map(|axis| a[axis][0].max(b[axis][0]));
                    if first == here && boxes_meet(&self.segments[i], &self.segments[j]) {
                        meet(i, j);
                    }
                }
            }
        }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred squares")]
fn square_of(at: f64, low: f64, step: f64) -> usize {
    ((at - low) / step).max(0.0) as usize
}

fn boxes_meet([a, b]: &[[f64; 2]; 2], [c, d]: &[[f64; 2]; 2]) -> bool {
    (0..2).all(|i| a[i].max(b[i]) >= c[i].min(d[i]) && c[i].max(d[i]) >= a[i].min(b[i]))
}

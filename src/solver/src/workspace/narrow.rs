//! Where in the plane the domain is.

use super::domain::{Domain, LIMITS};

/// Squares along the rectangle that the legs reach.
const COARSE: u32 = 24;

/// The part of the rectangle outside which some limit is clearly not kept; `None` if nothing is
/// left.
pub(super) fn narrowed(domain: &Domain<'_>) -> Option<[[f64; 2]; 2]> {
    let [low, high] = domain.rectangle();
    let lines = [0, 1].map(|axis| -> Vec<f64> {
        let step = (high[axis] - low[axis]) / f64::from(COARSE);
        (0..=COARSE).map(|n| low[axis] + f64::from(n) * step).collect()
    });
    let rows: Vec<Vec<_>> = lines[1]
        .iter()
        .map(|&y| lines[0].iter().map(|&x| domain.values(&domain.column([x, y]))).collect())
        .collect();
    let mut found: Option<[[f64; 2]; 2]> = None;
    for (j, pair) in rows.windows(2).enumerate() {
        for i in 0..lines[0].len() - 1 {
            let corners = [&pair[0][i], &pair[0][i + 1], &pair[1][i], &pair[1][i + 1]];
            let outside = (0..LIMITS).any(|limit| corners.iter().all(|values| values[limit] < 0.0));
            if !outside {
                // A neighbour of such a square may hold a piece of the domain as well.
                let (x, y) = ([i.saturating_sub(1), i + 2], [j.saturating_sub(1), j + 2]);
                let at = |axis: usize, n: usize| lines[axis][n.min(lines[axis].len() - 1)];
                let [a, b] = found.unwrap_or([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]);
                found = Some([
                    [a[0].min(at(0, x[0])), a[1].min(at(1, y[0]))],
                    [b[0].max(at(0, x[1])), b[1].max(at(1, y[1]))],
                ]);
            }
        }
    }
    found
}

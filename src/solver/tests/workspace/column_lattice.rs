//! Columns over the points of a lattice that is aligned with nothing, computed by the inverse solution and the
//! margins alone.

use verne_solver::{Machine, Margins, platform_working};

/// The z at which a column is examined. Any z will do, except for the strokes.
const Z: f64 = 1_000.0;

/// `z_lo` and `z_hi` at (x, y), if the column exists.
pub(crate) fn column(machine: &Machine, x: f64, y: f64) -> Option<[f64; 2]> {
    let posture = platform_working(machine, [x, y, Z]).ok()?;
    let mut margins = Margins::of(machine, &posture, None);
    margins.stroke = [[1.0; 2]; 3];
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (stroke, rho) in machine.data().limits.stroke.iter().zip(posture.rho) {
        low = low.max(stroke[0] + Z - rho);
        high = high.min(stroke[1] + Z - rho);
    }
    (margins.feasible() && low <= high).then_some([low, high])
}

/// Area and platform volume by n² columns over a rectangle.
pub(crate) fn area_and_volume(machine: &Machine, [low, high]: [[f64; 2]; 2], n: u32) -> [f64; 2] {
    let (width, height) = ((high[0] - low[0]) / f64::from(n), (high[1] - low[1]) / f64::from(n));
    let mut sums = [0.0; 2];
    for i in 0..n {
        for j in 0..n {
            // Irrational offsets: boundaries along x or y must not meet a row of points.
            let (u, v) = (f64::from(j) * 0.754_877_666_246_692_7, f64::from(i) * 0.618_033_988_749_894_9);
            let x = low[0] + width * (f64::from(i) + u.fract());
            let y = low[1] + height * (f64::from(j) + v.fract());
            if let Some([bottom, top]) = column(machine, x, y) {
                sums[0] += 1.0;
                sums[1] += top - bottom;
            }
        }
    }
    sums.map(|sum| sum * width * height)
}

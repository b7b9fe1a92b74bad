//! Rectangles of the plane.

/// Least and greatest x and y.
pub(in crate::workspace) type Rectangle = [[f64; 2]; 2];

/// The halves across the longer side.
pub(super) fn halves([low, high]: Rectangle) -> [Rectangle; 2] {
    let axis = usize::from(high[1] - low[1] > high[0] - low[0]);
    let middle = 0.5 * (low[axis] + high[axis]);
    let (mut first, mut second) = ([low, high], [low, high]);
    first[1][axis] = middle;
    second[0][axis] = middle;
    [first, second]
}

pub(super) fn longest([low, high]: &Rectangle) -> f64 {
    (high[0] - low[0]).max(high[1] - low[1])
}

pub(super) fn area([low, high]: &Rectangle) -> f64 {
    (high[0] - low[0]) * (high[1] - low[1])
}

/// Whether a segment meets a rectangle.
pub(super) fn meets([low, high]: &Rectangle, [a, b]: [[f64; 2]; 2]) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let step = b[axis] - a[axis];
        if step == 0.0 {
            if a[axis] < low[axis] || a[axis] > high[axis] {
                return false;
            }
        } else {
            let (s, t) = ((low[axis] - a[axis]) / step, (high[axis] - a[axis]) / step);
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        }
    }
    from <= to
}

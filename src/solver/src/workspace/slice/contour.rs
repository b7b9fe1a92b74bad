//! Lines of constant alpha: for the platform the ellipses of Eq (16).

use std::f64::consts::PI;

use crate::workspace::column::Column;
use crate::workspace::domain::Domain;
use crate::workspace::feasible_intervals::Curve;

/// Segments of half an ellipse on which the limits are examined.
const SEGMENTS: u32 = 24;
/// Halvings of a line.
const DEPTH: u32 = 16;
/// Fraction of the tolerance by which a chord may be off.
const CLOSE: f64 = 0.5;
/// Difference of angles, rad, from which the working mode at a point of the ellipse has another angle.
const OTHER: f64 = 1e-6;

/// A line on which alpha is constant, within a slice.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// The value of alpha, rad.
    pub alpha: f64,
    /// The line's points, mm.
    pub points: Vec<[f64; 2]>,
}

/// The lines of one angle.
///
/// Eliminating w1 from (A): X1² + y² (1 + u²/v²) = L1² - C + k cos a, an ellipse in (X1, y); the
/// working mode is on the half where y and sin a have different signs.
pub(super) fn contours_at(domain: &Domain<'_>, alpha: f64, tolerance: f64) -> Vec<Contour> {
    let (g, d) = (domain.machine.geometry(), &domain.machine.mechanism);
    let (s, c) = alpha.sin_cos();
    let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
    let square = g.L1 * g.L1 - d.c + d.k * c;
    if !(square > 0.0 && u > 0.0) {
        return Vec::new();
    }
    let half = square.sqrt();
    let flat = half * v / u.hypot(v);
    let at = |t: f64| [half * t.cos() - d.e1, -flat * t.sin()];
    let ellipse = Curve { domain, at };
    ellipse
        .intervals([0.0, PI], SEGMENTS)
        .into_iter()
        .filter_map(|[low, high]| {
            let middle = domain.column(at(0.5 * (low.t + high.t)));
            let has_angle = (middle.alpha() - alpha).abs() < OTHER;
            has_angle.then(|| {
                let mut points = vec![image(domain, &low.column)];
                let drawn = |t: f64| image(domain, &domain.column(at(t)));
                draw([low.t, high.t], CLOSE * tolerance, DEPTH, &drawn, &mut points);
                points.push(image(domain, &high.column));
                Contour { alpha, points }
            })
        })
        .collect()
}

fn image(domain: &Domain<'_>, column: &Column) -> [f64; 2] {
    let [z, _] = domain.ends(column);
    let [x, y, _] = domain.image.point(column, z);
    [x, y]
}

/// Adds the points that are drawn between two points of a line.
fn draw(
    [from, to]: [f64; 2],
    allowed: f64,
    depth: u32,
    drawn: &impl Fn(f64) -> [f64; 2],
    points: &mut Vec<[f64; 2]>,
) {
    let (a, b, middle) = (drawn(from), drawn(to), 0.5 * (from + to));
    let near = |fraction: f64| {
        let p = drawn(from + fraction * (to - from));
        let chord = (b[0] - a[0]).hypot(b[1] - a[1]);
        let area = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        area.abs() <= allowed * chord
    };
    if depth == 0 || [0.25, 0.5, 0.75].into_iter().all(near) {
        return;
    }
    draw([from, middle], allowed, depth - 1, drawn, points);
    points.push(drawn(middle));
    draw([middle, to], allowed, depth - 1, drawn, points);
}

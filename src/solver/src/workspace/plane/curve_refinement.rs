//! Refinement of the curves inside a triangle: chords that are off by less than the tolerance.

use super::sample::{Sample, value};
use super::triangle_samples::TriangleSamples;
use crate::pose::Point;
use crate::workspace::domain::Domain;
use crate::workspace::observer::check_cancelled;
use crate::workspace::request::WorkspaceError;
use crate::workspace::vector::{cross, dot, length, minus};

/// Fraction of the tolerance by which a chord may be off its curve, half-way or at a quarter.
const CLOSE: f64 = 0.4;
/// Halvings of a chord.
const DEPTH: u32 = 16;
/// Steps of the search for the curve beside a chord.
const STEPS: usize = 12;
/// Precision of that search and its greatest distance, in units of the chord.
const PRECISE: f64 = 1e-10;
const FAR: f64 = 0.6;

/// Refines the chord between two samples of a curve: the samples between them, in order.
pub(super) fn between(
    triangle: &mut TriangleSamples<'_>,
    curve: usize,
    from: usize,
    to: usize,
) -> Result<Vec<usize>, WorkspaceError> {
    let mut points = Vec::new();
    if triangle.samples[from].border & triangle.samples[to].border == 0 {
        halve(triangle, curve, [from, to], DEPTH, &mut points)?;
    }
    Ok(points)
}

fn halve(
    triangle: &mut TriangleSamples<'_>,
    curve: usize,
    [from, to]: [usize; 2],
    depth: u32,
    points: &mut Vec<usize>,
) -> Result<(), WorkspaceError> {
    check_cancelled(triangle.observer)?;
    if depth == 0 || is_close(triangle, curve, &triangle.samples[from], &triangle.samples[to]) {
        return Ok(());
    }
    let ends = [triangle.samples[from].at(), triangle.samples[to].at()];
    let at = on_curve(triangle.domain, curve, ends, 0.5);
    if !triangle.contains(at) || at == ends[0] || at == ends[1] {
        return Ok(());
    }
    let mut sample = Sample::new(triangle.domain, at);
    sample.values[curve] = 0.0;
    let middle = triangle.add(sample);
    halve(triangle, curve, [from, middle], depth - 1, points)?;
    points.push(middle);
    halve(triangle, curve, [middle, to], depth - 1, points)
}

/// Whether a chord is close enough to its curve on both sheets, and the ruled wall over the curve to its two
/// triangles.
fn is_close(triangle: &TriangleSamples<'_>, curve: usize, a: &Sample, b: &Sample) -> bool {
    let allowed = CLOSE * triangle.tolerance;
    let (first, last) = (a.ends(triangle.domain), b.ends(triangle.domain));
    let twist = [0, 1, 2].map(|i| 0.25 * (first[1][i] - first[0][i] - last[1][i] + last[0][i]));
    let normal = cross(minus(last[0], first[0]), minus(first[1], first[0]));
    let area = length(normal);
    if area > 0.0 && dot(twist, normal).abs() > allowed * area {
        return false;
    }
    [0.5, 0.25, 0.75].into_iter().all(|fraction| {
        let at = on_curve(triangle.domain, curve, [a.at(), b.at()], fraction);
        let ends = Sample::ends_on(triangle.domain, at, curve);
        (0..2).all(|sheet| distance_from_segment(ends[sheet], first[sheet], last[sheet]) <= allowed)
    })
}

/// The approximate number of chords of a wall of this height along which the columns turn by this angle, rad. Each
/// may be off by its fraction of the tolerance.
pub(super) fn chords(turn: f64, height: f64, tolerance: f64) -> f64 {
    0.25 * height * turn / (CLOSE * tolerance)
}

/// The point of a curve near a position on a chord: on the perpendicular to the chord, or the chord's own point if
/// the curve is not near.
pub(super) fn on_curve(domain: &Domain<'_>, curve: usize, [a, b]: [[f64; 2]; 2], fraction: f64) -> [f64; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let on = |off: f64| [a[0] + fraction * dx - off * dy, a[1] + fraction * dy + off * dx];
    let f = |off: f64| value(domain, curve, &domain.column(on(off)));
    let (mut before, mut fb) = (0.0, f(0.0));
    if fb == 0.0 {
        return on(0.0);
    }
    let mut here = 1e-3;
    let mut fh = f(here);
    for _ in 0..STEPS {
        if fh == fb {
            break;
        }
        let next = here - fh * (here - before) / (fh - fb);
        if next.is_nan() || next.abs() > FAR {
            break;
        }
        let step = (next - here).abs();
        (before, fb) = (here, fh);
        here = next;
        if step <= PRECISE {
            return on(here);
        }
        fh = f(here);
        if fh == 0.0 {
            return on(here);
        }
    }
    on(0.0)
}

fn distance_from_segment(p: Point, a: Point, b: Point) -> f64 {
    let (ab, ap) = (minus(b, a), minus(p, a));
    let square = dot(ab, ab);
    let fraction = if square > 0.0 { (dot(ab, ap) / square).clamp(0.0, 1.0) } else { 0.0 };
    length([0, 1, 2].map(|i| ap[i] - fraction * ab[i]))
}

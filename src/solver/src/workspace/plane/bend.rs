//! Curves inside a triangle, drawn to tolerance.

use super::super::domain::Domain;
use super::super::observer::go_on;
use super::super::request::WorkspaceError;
use super::leaf::Leaf;
use super::site::{Site, value};
use crate::pose::Point;

/// Fraction of the tolerance by which a chord may be off its curve, half-way or at a quarter.
const CLOSE: f64 = 0.4;
/// Halvings of a chord.
const DEPTH: u32 = 16;
/// Steps of the search for the curve beside a chord.
const STEPS: usize = 12;
/// Precision of that search and its greatest distance, in units of the chord.
const PRECISE: f64 = 1e-10;
const FAR: f64 = 0.6;

/// Points to draw between two sites of a curve, in order.
pub(super) fn between(
    leaf: &mut Leaf<'_>,
    curve: usize,
    from: usize,
    to: usize,
) -> Result<Vec<usize>, WorkspaceError> {
    let mut points = Vec::new();
    if leaf.sites[from].border & leaf.sites[to].border == 0 {
        halve(leaf, curve, [from, to], DEPTH, &mut points)?;
    }
    Ok(points)
}

fn halve(
    leaf: &mut Leaf<'_>,
    curve: usize,
    [from, to]: [usize; 2],
    depth: u32,
    points: &mut Vec<usize>,
) -> Result<(), WorkspaceError> {
    go_on(leaf.observer)?;
    if depth == 0 || close(leaf, curve, &leaf.sites[from], &leaf.sites[to]) {
        return Ok(());
    }
    let ends = [leaf.sites[from].at(), leaf.sites[to].at()];
    let at = drawn(leaf.domain, curve, ends, 0.5);
    if !inside(leaf, at) || at == ends[0] || at == ends[1] {
        return Ok(());
    }
    let mut site = Site::new(leaf.domain, at);
    site.values[curve] = 0.0;
    leaf.sites.push(site);
    let middle = leaf.sites.len() - 1;
    halve(leaf, curve, [from, middle], depth - 1, points)?;
    points.push(middle);
    halve(leaf, curve, [middle, to], depth - 1, points)
}

/// Whether a chord is close enough to its curve on both sheets, and the ruled wall over the curve to its two
/// triangles.
fn close(leaf: &Leaf<'_>, curve: usize, a: &Site, b: &Site) -> bool {
    let allowed = CLOSE * leaf.tolerance;
    let (first, last) = (a.ends(leaf.domain), b.ends(leaf.domain));
    let twist = [0, 1, 2].map(|i| 0.25 * (first[1][i] - first[0][i] - last[1][i] + last[0][i]));
    let along = [0, 1, 2].map(|i| last[0][i] - first[0][i]);
    let up = [0, 1, 2].map(|i| first[1][i] - first[0][i]);
    let normal = cross(along, up);
    let area = dot(normal, normal).sqrt();
    if area > 0.0 && dot(twist, normal).abs() > allowed * area {
        return false;
    }
    [0.5, 0.25, 0.75].into_iter().all(|part| {
        let at = drawn(leaf.domain, curve, [a.at(), b.at()], part);
        let ends = Site::ends_on(leaf.domain, at, curve);
        (0..2).all(|sheet| distance(ends[sheet], first[sheet], last[sheet]) <= allowed)
    })
}

/// The approximate number of chords for a wall of this height along which the columns turn by this angle, rad. Each
/// may be off by its fraction of the tolerance.
pub(super) fn chords(turn: f64, height: f64, tolerance: f64) -> f64 {
    0.25 * height * turn / (CLOSE * tolerance)
}

/// The point of a curve near a position on a chord: on the perpendicular to the chord, or the chord's own point if
/// the curve is not near.
pub(super) fn drawn(domain: &Domain<'_>, curve: usize, [a, b]: [[f64; 2]; 2], part: f64) -> [f64; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let on = |off: f64| [a[0] + part * dx - off * dy, a[1] + part * dy + off * dx];
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

/// Whether a point is inside the leaf's triangle.
fn inside(leaf: &Leaf<'_>, [x, y]: [f64; 2]) -> bool {
    (0..3).all(|i| {
        let ([ax, ay], [bx, by]) = (leaf.sites[i].at(), leaf.sites[(i + 1) % 3].at());
        let (dx, dy) = (bx - ax, by - ay);
        dx * (y - ay) - dy * (x - ax) > 1e-9 * (dx * dx + dy * dy)
    })
}

/// Distance of a point from a segment.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (ab, ap) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| p[i] - a[i]));
    let square = dot(ab, ab);
    let part = if square > 0.0 { (dot(ab, ap) / square).clamp(0.0, 1.0) } else { 0.0 };
    let off = [0, 1, 2].map(|i| ap[i] - part * ab[i]);
    dot(off, off).sqrt()
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

//! Where the polynomial comes too close to zero to be trusted: its sheets decide.

use arrayvec::ArrayVec;

use super::sheet::{on_sheet, polish};
use super::{Closure, Root};

/// Half-width of the window around a touch in which the sheets are looked at: much wider than the
/// distance of two roots that the polynomial cannot tell apart, much narrower than the grid.
const WINDOW: f64 = 1e-3;
/// Step of the second difference of a sheet.
const DIFFERENCE: f64 = 1e-5;
/// Two roots closer than this cannot be told apart: the square root of the rounding.
const RESOLUTION: f64 = 4e-8;

/// The roots at a touch: one on each of two sheets, or two, one merged or none on one of them.
#[cold]
pub(super) fn roots<const M: usize, C: Closure<M>>(
    closure: &C,
    bracket: [f64; 2],
    at: f64,
) -> ArrayVec<Root, 4> {
    let window = [bracket[0].max(at - WINDOW), bracket[1].min(at + WINDOW)];
    let mut roots = ArrayVec::new();
    for sheet in 0..2 {
        let ends = window.map(|a| on_sheet(closure, sheet, a));
        let [Some(low), Some(high)] = ends else {
            roots.extend(at_fold(closure, sheet, window, at));
            continue;
        };
        if (low.value < 0.0) != (high.value < 0.0) {
            roots.extend(bracketed(closure, sheet, window));
        } else {
            roots.extend(tangent(closure, sheet, window, at));
        }
    }
    roots
}

/// The root of a sheet that changes sign over the window.
fn bracketed<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    [mut low, mut high]: [f64; 2],
) -> Option<Root> {
    let rising = on_sheet(closure, sheet, low)?.value < 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (on_sheet(closure, sheet, middle)?.value < 0.0) == rising { low = middle } else { high = middle }
    }
    let a = 0.5 * (low + high);
    let root = root_at(closure, sheet, a, false)?;
    Some(polish(closure, root).filter(|polished| close(polished, &root)).unwrap_or(root))
}

/// A sheet of one sign at both ends: it crosses twice, touches, or passes by.
fn tangent<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    window: [f64; 2],
    at: f64,
) -> ArrayVec<Root, 2> {
    let mut roots = ArrayVec::new();
    let Some((extremum, value, curvature)) = sheet_extremum(closure, sheet, window, at) else { return roots };
    // The parabola value + curvature/2 δ² has its roots at ± reach, or misses by as much.
    let square = -2.0 * value / curvature;
    let reach = square.abs().sqrt();
    if square > 0.0 && reach > RESOLUTION {
        let found = [-reach, reach].map(|offset| {
            let start = root_at(closure, sheet, extremum + offset, false)?;
            Some(polish(closure, start).filter(|polished| close(polished, &start)).unwrap_or(start))
        });
        roots.extend(found.into_iter().flatten());
    } else if reach <= RESOLUTION {
        roots.extend(root_at(closure, sheet, extremum, true));
    }
    roots
}

/// The extremum of a sheet in the window, with the sheet's value and curvature there; `None` if
/// there is none.
fn sheet_extremum<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    [low, high]: [f64; 2],
    at: f64,
) -> Option<(f64, f64, f64)> {
    let mut a = at;
    for _ in 0..20 {
        let [before, after] = [a - DIFFERENCE, a + DIFFERENCE].map(|a| on_sheet(closure, sheet, a));
        let here = on_sheet(closure, sheet, a)?;
        let curvature = (after?.slope - before?.slope) / (2.0 * DIFFERENCE);
        let next = a - here.slope / curvature;
        if !(next >= low && next <= high) {
            return None;
        }
        if (next - a).abs() <= 1e-11 {
            return Some((next, on_sheet(closure, sheet, next)?.value, curvature));
        }
        a = next;
    }
    None
}

/// Where the sheets themselves end in the window (w₊ = w₋), the angle does not parametrise the
/// solutions; Newton's method in (a, w) does.
fn at_fold<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    window: [f64; 2],
    at: f64,
) -> Option<Root> {
    let starts = [at, window[0], window[1], 0.5 * (at + window[0]), 0.5 * (at + window[1])];
    starts.into_iter().filter_map(|a| root_at(closure, sheet, a, false)).find_map(|start| {
        let root = polish(closure, start)?;
        ((root.a - at).abs() <= 2.0 * WINDOW).then_some(root)
    })
}

fn root_at<const M: usize, C: Closure<M>>(closure: &C, sheet: usize, a: f64, merged: bool) -> Option<Root> {
    let (s, c) = a.sin_cos();
    let w = closure.sheets(c, s)?[sheet];
    Some(Root { a, c, s, w, merged })
}

/// Polishing moves a root by far less than the window, or it went astray.
fn close(polished: &Root, start: &Root) -> bool {
    (polished.a - start.a).abs() <= 0.1 * WINDOW
}

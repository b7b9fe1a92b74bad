//! Where the polynomial comes too close to zero to be trusted: its sheets decide.

use arrayvec::ArrayVec;

use super::sheet::{OnSheet, on_sheet, polish};
use super::{Closure, Root, Roots, add};
use crate::angle::sin_cos;

/// Even intervals of the arc in which the sheets are looked at.
const EVEN: u8 = 16;
/// Distances from the touch at which they are looked at besides.
const CLOSE: [f64; 6] = [1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6];
/// Bisections of an interval: as many as a double has bits.
const BISECTIONS: u8 = 60;

/// Adds the roots at a touch: one on each of two sheets, or two, one merged or none on one of
/// them. The sheets are smooth where the polynomial is all rounding, so looking at them in a few
/// dozen intervals, closer around the touch, misses nothing that double precision can show.
#[cold]
pub(super) fn add_roots<const M: usize, C: Closure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    at: f64,
    found: &mut Roots,
) {
    let even = (0..=EVEN).map(|i| low + (high - low) * f64::from(i) / f64::from(EVEN));
    let close = CLOSE.into_iter().flat_map(|offset| [at - offset, at + offset]);
    let mut angles: ArrayVec<f64, 32> = even.chain(close).filter(|a| (low..=high).contains(a)).collect();
    angles.sort_unstable_by(f64::total_cmp);
    for interval in angles.windows(2) {
        let window = [interval[0], interval[1]];
        for sheet in 0..2 {
            on_interval(closure, sheet, window, found);
        }
    }
}

/// Adds the roots of one sheet on one interval.
fn on_interval<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    window: [f64; 2],
    found: &mut Roots,
) {
    let ends = window.map(|a| on_sheet(closure, sheet, a));
    let mut keep = |root| add(found, root);
    match ends {
        [None, None] => {}
        [Some(low), Some(high)] if (low.value < 0.0) == (high.value < 0.0) => {
            // A sheet that bends towards zero: only then can it reach it in between.
            if low.value * low.slope < 0.0 && high.value * high.slope > 0.0 {
                tangent(closure, sheet, window).into_iter().for_each(&mut keep);
            }
        }
        [Some(_), Some(_)] => bracketed(closure, sheet, window).into_iter().for_each(&mut keep),
        _ => at_fold(closure, sheet, window).into_iter().for_each(&mut keep),
    }
}

/// The root of a sheet that changes sign over the window.
fn bracketed<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    [mut low, mut high]: [f64; 2],
) -> Option<Root> {
    let reach = high - low;
    let rising = on_sheet(closure, sheet, low)?.value < 0.0;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if (on_sheet(closure, sheet, middle)?.value < 0.0) == rising { low = middle } else { high = middle }
    }
    let a = 0.5 * (low + high);
    let root = root_at(closure, sheet, a, false)?;
    let inside = |polished: &Root| (polished.a - a).abs() <= reach;
    Some(polish(closure, root).filter(inside).unwrap_or(root))
}

/// A sheet of one sign at both ends that bends towards zero in between: it crosses twice, touches,
/// or turns back.
fn tangent<const M: usize, C: Closure<M>>(closure: &C, sheet: usize, window: [f64; 2]) -> ArrayVec<Root, 2> {
    let mut roots = ArrayVec::new();
    let Some((extremum, at)) = sheet_extremum(closure, sheet, window) else { return roots };
    let crossed = on_sheet(closure, sheet, window[0]).is_some_and(|end| end.value * at.value < 0.0);
    if at.value.abs() <= at.noise {
        roots.extend(root_at(closure, sheet, extremum, true));
    } else if crossed {
        roots.extend(bracketed(closure, sheet, [window[0], extremum]));
        roots.extend(bracketed(closure, sheet, [extremum, window[1]]));
    }
    roots
}

/// The extremum of a sheet in a window over which its slope changes sign, with the sheet there.
fn sheet_extremum<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    [mut low, mut high]: [f64; 2],
) -> Option<(f64, OnSheet)> {
    let first = on_sheet(closure, sheet, low)?.slope;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if (on_sheet(closure, sheet, middle)?.slope < 0.0) == (first < 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let extremum = 0.5 * (low + high);
    Some((extremum, on_sheet(closure, sheet, extremum)?))
}

/// Where the sheets themselves end in the window (w₊ = w₋), the angle does not parametrise the
/// solutions; Newton's method in (a, w) does.
fn at_fold<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    [low, high]: [f64; 2],
) -> ArrayVec<Root, 5> {
    let starts = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| low + part * (high - low));
    let near = |root: &Root| root.a >= low - (high - low) && root.a <= high + (high - low);
    let roots = starts.into_iter().filter_map(|a| polish(closure, root_at(closure, sheet, a, false)?));
    roots.filter(near).collect()
}

fn root_at<const M: usize, C: Closure<M>>(closure: &C, sheet: usize, a: f64, merged: bool) -> Option<Root> {
    let (s, c) = sin_cos(a);
    let w = closure.sheets(c, s)?[sheet];
    Some(Root { a, c, s, w, merged })
}

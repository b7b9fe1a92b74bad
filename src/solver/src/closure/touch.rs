//! Roots where the polynomial is too close to zero to be trusted: its sheets decide.

use arrayvec::ArrayVec;

use super::sheet::{OnSheet, on_sheet, polish};
use super::window::{Stretch, Window};
use super::{Closure, Root, Roots, add};

/// Bisections of an interval: as many as a double has bits.
const BISECTIONS: u8 = 60;

/// Adds the roots at a touch: one on each of two sheets, or two, one merged or none on one of them. The sheets are
/// smooth where the polynomial is only rounding error. A few dozen intervals, denser around the touch and where the
/// sheets meet, show every root that double precision can resolve.
#[cold]
pub(super) fn add_roots<const M: usize, C: Closure<M>>(
    closure: &C,
    ends: [f64; 2],
    at: f64,
    found: &mut Roots,
) {
    let window = Window::new(ends, at);
    for stretch in &window.stretches(closure) {
        for sheet in 0..2 {
            on_stretch(&Sheet { closure, window, number: sheet }, stretch, found);
        }
        for end in 0..2 {
            if stretch.folds[end] {
                let offset = stretch.offsets[end * (stretch.offsets.len() - 1)];
                at_fold(closure, &window, offset, found);
            }
        }
    }
}

/// Adds the root where the sheets meet: rounding leaves a gap between them, across which the
/// linear equation may change its sign.
fn at_fold<const M: usize, C: Closure<M>>(closure: &C, window: &Window, offset: f64, found: &mut Roots) {
    let sheets = [0, 1].map(|sheet| Sheet { closure, window: *window, number: sheet });
    let [Some(above), Some(below)] = sheets.each_ref().map(|sheet| sheet.value(offset)) else { return };
    if (above < 0.0) != (below < 0.0)
        && let [Some(high), Some(low)] = sheets.each_ref().map(|sheet| sheet.root(offset, false))
    {
        let middle = Root { w: 0.5 * (high.w + low.w), ..high };
        let gap = (high.w - low.w).abs();
        let near = |root: &Root| (root.w - middle.w).abs() <= gap;
        add(found, polish(closure, middle).filter(near).unwrap_or(middle));
    }
}

/// One sheet of a closure in a window.
struct Sheet<'a, C> {
    closure: &'a C,
    window: Window,
    number: usize,
}

/// Adds the roots of one sheet on one stretch.
fn on_stretch<const M: usize, C: Closure<M>>(sheet: &Sheet<'_, C>, stretch: &Stretch, found: &mut Roots) {
    let last = stretch.offsets.len() - 1;
    let mut keep = |root| add(found, root);
    for (i, pair) in stretch.offsets.windows(2).enumerate() {
        let ends = [pair[0], pair[1]];
        let [Some(low), Some(high)] = ends.map(|offset| sheet.value(offset)) else { continue };
        if (low < 0.0) != (high < 0.0) {
            sheet.bracketed(ends).into_iter().for_each(&mut keep);
        } else if !(i == 0 && stretch.folds[0] || i + 1 == last && stretch.folds[1]) {
            sheet.tangent(ends).into_iter().for_each(&mut keep);
        }
    }
}

impl<C> Sheet<'_, C> {
    fn at<const M: usize>(&self, offset: f64) -> Option<OnSheet>
    where
        C: Closure<M>,
    {
        on_sheet(self.closure, self.number, self.window.direction(offset))
    }

    /// The linear equation's value.
    fn value<const M: usize>(&self, offset: f64) -> Option<f64>
    where
        C: Closure<M>,
    {
        let [c, s] = self.window.direction(offset);
        let w = self.closure.sheets(c, s)?[self.number];
        Some(self.closure.equations(c, s, w).f[0])
    }

    fn root<const M: usize>(&self, offset: f64, merged: bool) -> Option<Root>
    where
        C: Closure<M>,
    {
        let [c, s] = self.window.direction(offset);
        let w = self.closure.sheets(c, s)?[self.number];
        Some(self.window.root(offset, w, merged))
    }

    /// The root of a sheet that changes sign over an interval.
    fn bracketed<const M: usize>(&self, [mut low, mut high]: [f64; 2]) -> Option<Root>
    where
        C: Closure<M>,
    {
        let reach = high - low;
        let rising = self.value(low)? < 0.0;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if (self.value(middle)? < 0.0) == rising { low = middle } else { high = middle }
        }
        let root = self.root(0.5 * (low + high), false)?;
        let inside = |polished: &Root| (polished.a - root.a).abs() <= reach;
        Some(polish(self.closure, root).filter(inside).unwrap_or(root))
    }

    /// A sheet of one sign at both ends that bends towards zero in between: it crosses twice,
    /// touches, or turns back.
    fn tangent<const M: usize>(&self, [from, to]: [f64; 2]) -> ArrayVec<Root, 2>
    where
        C: Closure<M>,
    {
        let mut roots = ArrayVec::new();
        let (Some(low), Some(high)) = (self.at(from), self.at(to)) else { return roots };
        // A sheet that bends towards zero: only then can it reach it in between.
        if low.value * low.slope >= 0.0 || high.value * high.slope <= 0.0 {
            return roots;
        }
        let Some((extremum, at)) = self.extremum([from, to], low.slope) else { return roots };
        if at.value.abs() <= at.noise {
            roots.extend(self.root(extremum, true));
        } else if low.value * at.value < 0.0 {
            roots.extend(self.bracketed([from, extremum]));
            roots.extend(self.bracketed([extremum, to]));
        }
        roots
    }

    /// The extremum on an interval over which the slope changes sign.
    fn extremum<const M: usize>(&self, [mut low, mut high]: [f64; 2], first: f64) -> Option<(f64, OnSheet)>
    where
        C: Closure<M>,
    {
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if (self.at(middle)?.slope < 0.0) == (first < 0.0) { low = middle } else { high = middle }
        }
        let extremum = 0.5 * (low + high);
        Some((extremum, self.at(extremum)?))
    }
}

//! The outer integral: panels between the lines at which the structure changes.

use super::line::{Extremes, Line, Structure};
use crate::workspace::cover::{Cover, Purpose, State};
use crate::workspace::domain::Domain;
use crate::workspace::observer::{Observer, check_cancelled, count};
use crate::workspace::quadrature::{Integral, rule};
use crate::workspace::request::WorkspaceError;

/// Number of lines that are examined first, besides those at events.
const LINES: u32 = 40;
/// Greatest number of intervals of x with events that are kept separate.
const EVENTS: usize = 400;
/// Width within which a change of structure is located, as a fraction of the domain's.
const RESOLUTION: f64 = 2e-9;
/// Aim of the relative error of each integral.
const ACCURACY: f64 = 1e-7;
/// Halvings of a panel.
const DEPTH: u32 = 14;
/// Greatest number of lines that are examined to locate changes, and again to refine panels. Close to rounding there
/// is always a difference, and more lines do not help.
const MOST: u32 = 8_000;
/// Factor by which the stated errors exceed the estimates.
const SAFETY: f64 = 4.0;

/// Area and signed volume.
pub(super) fn integrate(
    domain: &Domain<'_>,
    observer: &dyn Observer,
) -> Result<(Integral<2>, Extremes), WorkspaceError> {
    let cover = Cover::of(domain, Purpose::Integration, observer)?;
    let Some([[x0, _], [x1, _]]) = cover.bounds() else {
        return Ok((Integral::ZERO, Extremes::default()));
    };
    let mut outer =
        OuterIntegral { domain, cover: &cover, observer, left: MOST, extremes: Extremes::default() };
    let (ends, rough) = outer.changes([x0, x1])?;
    let mut total = Integral::ZERO;
    outer.left = MOST;
    let scale = Scale { rough, allowed: rough.map(|r| r * ACCURACY) };
    for panel in ends.windows(2) {
        observer.progress(0.5 + 0.5 * (panel[0] - x0) / (x1 - x0));
        total.add(&outer.panel([panel[0], panel[1]], &scale, None, [0.0, 1.0], DEPTH)?);
    }
    // Between a change and its computed place a line may be twice as long as the mean one.
    let misplaced = 2.0 * RESOLUTION * count(ends.len());
    let undecided = undecided(&cover);
    for axis in 0..2 {
        total.error[axis] = SAFETY * total.error[axis] + misplaced * rough[axis] + undecided[axis];
    }
    Ok((total, outer.extremes))
}

/// Area, and a bound of the volume, of the boxes in which lines may miss a region of the domain.
fn undecided(cover: &Cover) -> [f64; 2] {
    events(cover).fold([0.0; 2], |[area, volume], ([x, y], weight)| {
        let size = (x[1] - x[0]) * (y[1] - y[0]);
        [area + size, volume + size * weight]
    })
}

/// The ranges of x and y of the boxes in which a line's structure may change, and a bound of a
/// column's volume over its area.
fn events(cover: &Cover) -> impl Iterator<Item = ([[f64; 2]; 2], f64)> {
    cover.boxes().filter(|found| matches!(found.state, State::Crossed { event: true, .. })).map(|found| {
        let [low, high] = found.rectangle;
        ([[low[0], high[0]], [low[1], high[1]]], found.weight)
    })
}

struct OuterIntegral<'a> {
    domain: &'a Domain<'a>,
    cover: &'a Cover,
    observer: &'a dyn Observer,
    /// Number of lines that may still be examined.
    left: u32,
    extremes: Extremes,
}

impl OuterIntegral<'_> {
    fn line(&self, x: f64) -> Result<Line<'_>, WorkspaceError> {
        check_cancelled(self.observer)?;
        Ok(Line::new(self.domain, self.cover, x))
    }

    /// The x of the lines that are examined first: evenly spaced ones, and around every event.
    fn first_lines(&self, [x0, x1]: [f64; 2]) -> Vec<f64> {
        let step = (x1 - x0) / f64::from(LINES);
        let mut lines: Vec<f64> = (1..LINES).map(|number| x0 + step * f64::from(number)).collect();
        let mut events: Vec<[f64; 2]> = events(self.cover).map(|([x, _], _)| x).collect();
        events.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // Many events are not kept separate where they are close.
        let least = if events.len() > EVENTS { (x1 - x0) / f64::from(LINES) / 10.0 } else { 0.0 };
        let mut last: Option<[f64; 2]> = None;
        for event in events {
            match &mut last {
                Some(last) if event[0] <= last[1] + least => last[1] = last[1].max(event[1]),
                _ => {
                    lines.extend(last.iter().flatten());
                    last = Some(event);
                }
            }
        }
        lines.extend(last.iter().flatten());
        lines.extend([x0, x1]);
        lines.sort_by(f64::total_cmp);
        lines.dedup();
        lines
    }

    /// The x between which the structure stays the same, and rough values of the integrals.
    fn changes(&mut self, [x0, x1]: [f64; 2]) -> Result<(Vec<f64>, [f64; 2]), WorkspaceError> {
        let (mut found, mut rough) = (vec![x0], [0.0; 2]);
        let mut last: Option<(f64, Structure, [f64; 2])> = None;
        for x in self.first_lines([x0, x1]) {
            self.observer.progress(0.5 * (x - x0) / (x1 - x0));
            let line = self.line(x)?;
            let structure = line.structure();
            let value = line.integrals(&[f64::INFINITY; 2], &mut Extremes::default()).value;
            if let Some((before, old, lengths)) = last {
                for axis in 0..2 {
                    rough[axis] += 0.5 * (x - before) * (value[axis].abs() + lengths[axis].abs());
                }
                self.change([before, x], [&old, &structure], RESOLUTION * (x1 - x0), &mut found)?;
            }
            last = Some((x, structure, value));
        }
        found.push(x1);
        // Changes that are closer than the resolution are one.
        found.dedup_by(|b, a| *b - *a <= 2.0 * RESOLUTION * (x1 - x0));
        Ok((found, rough))
    }

    /// Locates the changes of structure between two lines by bisection.
    fn change(
        &mut self,
        [a, b]: [f64; 2],
        [old, new]: [&Structure; 2],
        least: f64,
        found: &mut Vec<f64>,
    ) -> Result<(), WorkspaceError> {
        if old == new {
            return Ok(());
        }
        let middle = 0.5 * (a + b);
        if b - a <= least {
            found.push(middle);
            return Ok(());
        }
        if self.left == 0 {
            // The interval between becomes a panel.
            found.extend([a, b]);
            return Ok(());
        }
        self.left -= 1;
        let between = self.line(middle)?.structure();
        self.change([a, middle], [old, &between], least, found)?;
        self.change([middle, b], [&between, new], least, found)
    }

    /// Integrates a panel. It is accepted if its two halves confirm it: a feature between all lines of one rule, or
    /// beside its last one, shows in the other.
    fn panel(
        &mut self,
        panel: [f64; 2],
        scale: &Scale,
        whole: Option<Integral<2>>,
        [from, to]: [f64; 2],
        depth: u32,
    ) -> Result<Integral<2>, WorkspaceError> {
        let whole = match whole {
            Some(whole) => whole,
            None => self.rule(panel, [from, to], scale)?,
        };
        let middle = 0.5 * (from + to);
        let halves = [[from, middle], [middle, to]];
        let [first, second] = [self.rule(panel, halves[0], scale)?, self.rule(panel, halves[1], scale)?];
        let mut total = first;
        total.add(&second);
        for axis in 0..2 {
            total.error[axis] = total.error[axis].max((total.value[axis] - whole.value[axis]).abs());
        }
        if depth == 0 || self.left == 0 || total.within(&scale.allowed.map(|allowed| allowed * (to - from))) {
            return Ok(total);
        }
        let mut total = self.panel(panel, scale, Some(first), halves[0], depth - 1)?;
        total.add(&self.panel(panel, scale, Some(second), halves[1], depth - 1)?);
        Ok(total)
    }

    /// Integrates a range of a panel, in the parameter t of the substitution, without halving it.
    fn rule(
        &mut self,
        panel: [f64; 2],
        range: [f64; 2],
        scale: &Scale,
    ) -> Result<Integral<2>, WorkspaceError> {
        let width = panel[1] - panel[0];
        let mut extremes = self.extremes;
        let mut lines = 0;
        let whole = rule(range, |t| {
            lines += 1;
            let x = panel[0] + width * t * t * (3.0 - 2.0 * t);
            let weight = width * 6.0 * t * (1.0 - t);
            let line = self.line(x)?.integrals(&scale.rough.map(|r| r / width), &mut extremes);
            Ok(line.times(weight))
        })?;
        self.extremes = extremes;
        self.left = self.left.saturating_sub(lines);
        Ok(whole)
    }
}

/// Rough values of the integrals, and the errors that a panel's may have.
struct Scale {
    rough: [f64; 2],
    allowed: [f64; 2],
}
